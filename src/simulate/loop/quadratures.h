#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "simulate/loop/audit.h"
#include "simulate/loop/observed_step.h"
#include "subimpact/simulate/options.h"

namespace subimpact {

/// Integral of the force of a contact over time, from the indentation alone: independent of the
/// striker's velocity, whose change it must equal (docs/theory.md, "Accounts").
class ForceQuadrature {
 public:
  /// `tolerance` of a step's integral, N s.
  explicit ForceQuadrature(double tolerance, std::size_t contact = 0)
      : tolerance_(tolerance), contact_(contact) {}

  /// Call where the force or one of its derivatives may jump: at events.
  void forget_neighbour() { previous_.reset(); }

  /// Integral over a step, N s.
  double over(const ObservedStep& step, const StruckBeam& beam);
  /// The largest indentation (m) that over() has evaluated within the step, without its ends.
  double largest_indentation() const { return largest_indentation_; }
  /// The integral from the start of a step to a time t in it, where the state is y, without
  /// correction or halving, for steps in pieces.
  double roughly_up_to(double t, const State& y, const ObservedStep& step,
                       const StruckBeam& beam) const {
    return between<2>(node(step.t0(), step.y0(), beam), node(t, y, beam), beam);
  }
  /// The same to the accuracy of over().
  double up_to(double t, const State& y, const ObservedStep& step, const StruckBeam& beam);

 private:
  struct Node {
    double time, indentation, rate;
  };
  Node node(double time, const State& y, const StruckBeam& beam) const {
    return {time, beam.indentation(y, contact_), beam.indentation_rate(y, contact_)};
  }
  std::pair<Node, Node> ends_of(const ObservedStep& step, const StruckBeam& beam) const {
    if (contact_ > 0) return {node(step.t0(), step.y0(), beam), node(step.t1(), step.y1(), beam)};
    const IndentationStep& ends = step.indentation();
    return {{ends.t0, ends.lambda0, ends.rate0}, {ends.t1, ends.lambda1, ends.rate1}};
  }
  template <std::size_t n_points = 3>
  double between(const Node& a, const Node& b, const StruckBeam& beam) const;
  double halved(const Node& a, const Node& b, double whole, const ObservedStep& step,
                const StruckBeam& beam, int depth);

  struct Step {
    Node start;
    double length, integral;
    double constant;  // of its error, constant length^5; 0 where no step before it tells
  };
  double tolerance_;
  std::size_t contact_;
  std::optional<Step> previous_;
  double largest_indentation_ = 0.0;
  State state_;
};

/// Energy that velocity-dependent forces dissipate, what changing loads leave of their potential,
/// and impulses of supports that lift, integrated along the trajectory: independently of the
/// energies and momenta, whose balances they close (docs/theory.md, "Accounts").
class LossQuadrature {
 public:
  LossQuadrature(const Audit& audit, EventHandling events);

  /// Losses from the start of the step to a time t in it or at its end, where the state is y.
  Losses over(const ObservedStep& step, double t, const State& y, StruckBeam& beam);
  /// What over() has found of each support, N s.
  std::span<const double> support_impulses() const { return impulses_; }
  /// As ForceQuadrature::forget_neighbour().
  void forget_neighbours() {
    for (ForceQuadrature& force : forces_) force.forget_neighbour();
  }

 private:
  struct Node {
    double time;
    State y;
    std::vector<double> acceleration;
    // (df/dt) times positions, velocities and accelerations: that between nodes follows from them.
    std::array<double, 3> power_of_change;
  };
  static void read_acceleration(Node& node, StruckBeam& beam);
  Losses halved(const Node& a, const Node& b, const ObservedStep& step, StruckBeam& beam,
                int depth);
  // Losses between two nodes, by quintics or by cubics.
  Losses between(const Node& a, const Node& b, bool quintic, StruckBeam& beam);

  double tolerance_;
  EventHandling events_;
  std::vector<ForceQuadrature> forces_;  // of supports
  std::vector<double> impulses_;
  bool beam_by_quadrature_ = false;
  State state_;  // between nodes
  std::vector<double> squares_;
};

}  // namespace subimpact
