#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <vector>

#include "nodes.h"
#include "scene.h"
#include "striker.h"

namespace continuum {

// The largest errors of the balances, over the initial energy and momentum.
struct Balance {
  double energy = 0.0, momentum = 0.0;
};

// The largest displacement, against the chord of the beam's ends, of the beam at rest: the double
// integral of the permanent curvature; positive along the strike. A symmetric beam is given by one
// half.
inline double permanent_set(const Vector& curvature, const Vector& length, bool is_symmetric) {
  Vector w{0.0};
  double slope = 0.0, whole = 0.0, largest = 0.0, x = 0.0;
  for (std::size_t i = 0; i < length.size(); ++i) {
    w.push_back(w.back() + length[i] * (slope + 0.5 * length[i] * curvature[i]));
    slope += length[i] * curvature[i];
    whole += length[i];
  }
  for (std::size_t i = 0; i < w.size(); ++i) {
    const double chord = is_symmetric ? w.back() : w.back() * x / whole;
    if (std::abs(w[i] - chord) > std::abs(largest)) largest = w[i] - chord;
    if (i < length.size()) x += length[i];
  }
  return largest;
}

// Steps of one scene. Body: nodes, surface, dt, add_internal_forces(), internal_energy(), middle()
// (displacement of the mid-plane at the struck section), curvatures() (permanent, by elements along
// the beam) and lengths() of these, dent() and shape(n) (of the mode of free vibration, at a node).
template <typename Body>
class Run {
 public:
  Run(const Scene& s, Body& body) : s_(s), body_(body), striker_(s, body.parts()) {
    std::filesystem::create_directories(s.out);
    history_.open(s.out + (s.mode > 0 ? "/ring.csv" : "/history.csv"));
    history_ << (s.mode > 0
                     ? "t_us,amplitude_um\n"
                     : "t_us,force_N,gap_um,striker_m_s,striker_um,middle_um,energy_error\n");
    if (s.mode > 0)
      for (std::size_t n = 0; n < body.nodes.mass.size(); ++n)
        body.nodes.v[1][n] = 0.1 * body.shape(n);
    initial_ = 0.5 * s.mass * s.speed * s.speed;
    if (s.mode > 0) initial_ = body.parts() * body.nodes.kinetic_energy(0.0);
  }

  // Returns the exit status of the program: 3 if the energy is lost.
  int go() {
    const double dt = body_.dt;
    double next = 0.0;
    int step = 0;
    for (double t = 0.0; t <= s_.end; t = ++step * dt) {
      for (Vector& f : body_.nodes.f) std::fill(f.begin(), f.end(), 0.0);
      body_.add_internal_forces();
      if (s_.mode == 0) striker_.press(body_.surface, body_.nodes);
      if (t >= next) {
        sample(t);
        next += s_.interval;
      }
      body_.nodes.advance(dt);
      if (s_.mode == 0) striker_.advance(t, dt);
      if (step % 20000 == 0 && s_.mode == 0) striker_.write_contacts(s_.out);
      if (!(balance_.energy <= 0.05)) {
        std::fprintf(stderr,
                     "stopped at %.2f us: the energy is wrong by more than 5 %%; elements may have "
                     "folded over: give longer ones or a shorter step (--element, --courant)\n",
                     1e6 * t);
        finish();
        return 3;
      }
    }
    finish();
    return 0;
  }

 private:
  void sample(double t) {
    const Nodes& nodes = body_.nodes;
    const double energy =
        body_.parts() * (nodes.kinetic_energy(body_.dt) + body_.internal_energy()) +
        (s_.mode > 0 ? 0.0 : striker_.kinetic_energy(body_.dt) + striker_.penalty_energy());
    const double error = energy / initial_ - 1.0;
    if (!(std::abs(error) <= balance_.energy)) balance_.energy = std::abs(error);  // NaN, too
    char line[200];
    if (s_.mode > 0) {
      double sum = 0.0, norm = 0.0;
      for (std::size_t n = 0; n < nodes.mass.size(); ++n) {
        sum += nodes.mass[n] * body_.shape(n) * nodes.u[1][n];
        norm += nodes.mass[n] * body_.shape(n) * body_.shape(n);
      }
      std::snprintf(line, sizeof line, "%.4f,%.6g\n", 1e6 * t, 1e6 * sum / norm);
    } else {
      const double momentum = body_.parts() * nodes.momentum() + striker_.mass() * striker_.speed();
      if (!s_.clamped)
        balance_.momentum =
            std::max(balance_.momentum, std::abs(momentum / (s_.mass * s_.speed) - 1.0));
      std::snprintf(line, sizeof line, "%.2f,%.5g,%.4f,%.6f,%.3f,%.3f,%.2e\n", 1e6 * t,
                    striker_.mean_force(t), 1e6 * striker_.gap(), striker_.speed(),
                    1e6 * striker_.u(), 1e6 * body_.middle(), error);
    }
    history_ << line;
    if (++samples_ % 200 == 0) history_.flush();
  }

  void finish() {
    std::ofstream file(s_.out + "/summary.csv");
    const auto say = [&](const char* name, double value) {
      char line[100];
      std::snprintf(line, sizeof line, "%s,%.7g\n", name, value);
      file << line;
      std::fputs(line, stdout);
    };
    say("elements", body_.n_elements());
    say("step_us", 1e6 * body_.dt);
    say("energy_error", balance_.energy);
    if (s_.mode > 0) return;
    say("momentum_error", balance_.momentum);
    say("striker_m_s", striker_.speed());
    say("impulse_Ns", striker_.impulse());
    say("largest_force_N", striker_.largest_force());
    say("penetration_um_to_4_kN", 1e6 * striker_.penetration_at_4_kN());
    say("permanent_set_mm",
        1e3 * permanent_set(body_.curvatures(), body_.lengths(), s_.is_symmetric()));
    say("dent_mm", 1e3 * body_.dent());
    striker_.write_contacts(s_.out);
  }

  const Scene& s_;
  Body& body_;
  Striker striker_;
  std::ofstream history_;
  double initial_ = 0.0;
  Balance balance_;
  long samples_ = 0;
};

}  // namespace continuum
