#pragma once

#include <span>
#include <vector>

#include "model/plastic_response.h"
#include "model/sub_cell_sections.h"

namespace subimpact {

/// The equations of the nodes next to cells that flow (MixedSections): their moments m (in M_y)
/// obey
///
///     m_i = m_i without flow + sum_j (response to p_j) p_j(m) + (response to b_j) b_j(m),
///
/// or m = 1.5 with the rotation of the node's ideal hinge as the unknown while that turns, which it
/// does in the direction of its moment only. Solved by Newton's method.
class FlowEquations {
 public:
  /// `yield_curvature` in 1/m.
  FlowEquations(const MixedMesh& mesh, SubCellSections& cells, double yield_curvature);

  /// Moments as elastic curvatures, 1/m, at all sections of the mesh: without flow since the last
  /// commit, at the last commit and at the one before, from which the search starts.
  struct Moments {
    std::span<const double> without_flow, before, earlier;
  };
  /// `active`: the cells in which sections may flow. `coupled`: whether displacements move with the
  /// plastic curvature, or are given. False if no solution is found.
  bool solve(const std::vector<std::size_t>& active, bool coupled, const Moments& moments);
  /// Adds `factor` times what has flowed: to the elastic curvatures, and to the unknowns.
  void add_to_moments(double factor, std::span<double> elastic_curvatures);
  void add_to_unknowns(double* unknowns);
  /// The elastic curvatures of the solution: equal to those that add_to_moments() gives within the
  /// tolerance of the equations, which is too coarse for the law near the full plastic moment.
  void read_moments(std::span<double> elastic_curvatures) const;
  /// p of what has flowed, rad, at all sections.
  void add_to_p(std::span<double> p) const;
  /// Nothing has flowed since the last commit.
  void forget();
  /// Advances histories; `flowed` becomes the cells that flowed.
  void commit(std::vector<std::size_t>& flowed);
  /// commit() for a state in which nothing has flowed.
  void commit_rest();
  /// The cost of all solutions so far, in evaluations of a cell's acceleration.
  double work() const { return work_; }
  /// M_p times the rotation of all hinges, either way, over M_y kappa_y m.
  double hinge_work() const;
  /// The hinges, where nothing has flowed since the last commit.
  void exchange(Snapshot& snapshot) {
    for (Hinge& hinge : hinges_) snapshot(hinge);
  }

 private:
  struct Hinge {
    std::size_t section;
    std::size_t local = SubCellSections::none;  // among the nodes of the equations
    double turned = 0.0;                        // since the last commit, kappa_y m
    double sense = 0.0;                         // while it turns, else 0
    double sense_before = 0.0;                  // at the last commit
    double path = 0.0;                          // turned before it, either way
    double below = 0.0;                         // M_p while its moment is held there, in M_y

    void exchange(Snapshot& snapshot) { snapshot(turned, sense, sense_before, path, below); }
    bool is_among() const { return local != SubCellSections::none; }
    bool turns() const { return sense != 0.0; }
    bool turns_back() const { return turned * sense < 0.0; }  // against its moment
    double moment() const { return sense * (MomentLaw::limit - below); }
  };
  using Ends = SubCellSections::Ends;
  struct LocalCell {
    std::size_t index;
    std::array<std::size_t, 2> nodes;
    SubCellSections::Flow flow;
  };

  void gather(const std::vector<std::size_t>& active, bool coupled);
  std::size_t local_of(std::size_t node) const;
  void resize(std::size_t stride);
  void read_responses();
  void start(const Moments& moments);
  // Newton's method with hinges that begin and stop to turn; after so many bold iterations the
  // error must fall in each.
  bool iterate(int bold);
  // Newton's method with hinges that begin to turn `within` a distance of M_p.
  bool converge(int bold, double within);
  // The moment, just below M_p, with which a hinge does not turn, by bisection: for one that turns
  // back at M_p and would turn again wherever it is freed.
  bool hold(Hinge& hinge);
  double evaluate();
  struct Rows {
    std::size_t begin, end;
  };
  Rows rows_of(std::size_t column) const;
  void subtract_response(std::size_t node, double p, double b, Rows rows, double* column) const;
  void find_step();
  void assemble();
  void advance();
  void descend(double error);
  bool is_inside() const;
  bool release_hinges();
  void engage_hinges(double within);
  void pull_inside();
  Ends at_ends(const LocalCell& cell, const AlignedVector& of_nodes) const;

  const MixedMesh& mesh_;
  SubCellSections& cells_;
  double yield_curvature_;
  double work_ = 0.0;
  PlasticResponse response_;
  std::vector<Hinge> hinges_;
  // What the equations were gathered for, and their nodes, as sections of the mesh.
  std::vector<std::size_t> gathered_;
  bool coupled_ = true;
  std::vector<LocalCell> local_cells_;
  std::vector<std::size_t> nodes_;
  // One entry per node, and more up to a whole number of lanes, stride_, that do not count.
  std::size_t stride_ = 0;
  std::size_t band_ = 0;  // of the matrix: half its width in nodes
  AlignedVector moments_, without_flow_, p_, b_, error_, step_, part_, tried_, tried_turn_, above_;
  // Columns of stride_ entries: m of all nodes for a unit of one node's p or b.
  AlignedVector of_p_, of_b_, jacobian_;
};

}  // namespace subimpact
