// The rigid-plastic free beam under a force at its middle: when it folds, and where.

#include <Eigen/Dense>
#include <cmath>

#include "model/mesh/cell_mesh.h"
#include "outcome.h"

namespace subimpact::validation {
namespace {

/// Moments of the mesh's half beam that moves as one rigid link, hinged at the struck point if
/// asked.
///
/// The unknowns: the link's acceleration (and its angular one), and the moments of all sections
/// (that of the hinge is the yield moment). The equations: the mesh's own, one a cell.
class RigidLink {
 public:
  RigidLink(const Beam& beam, std::size_t n_cells)
      : mesh_(beam, 0.5, n_cells, CellMesh::Extent::half), half_length_(0.5 * beam.length) {
    const auto n = static_cast<Eigen::Index>(mesh_.n_unknowns());
    const auto n_sections = static_cast<Eigen::Index>(mesh_.n_sections());
    translation_.resize(n);
    rotation_.resize(n);
    bending_.resize(n, n_sections);
    load_ = Eigen::VectorXd::Zero(n);
    std::vector<double> shape(mesh_.n_unknowns()), product(mesh_.n_unknowns());
    const double dx = beam.length / static_cast<double>(n_cells);
    const auto inertia = [&](Eigen::VectorXd& into, auto value) {
      for (std::size_t i = 0; i < shape.size(); ++i) shape[i] = value(i);
      mesh_.mass().multiply(shape, product);
      into = Eigen::Map<Eigen::VectorXd>(product.data(), n);
    };
    inertia(translation_, [](std::size_t) { return 1.0; });
    // The distance from the struck cell, the last.
    inertia(rotation_,
            [&](std::size_t i) { return dx * static_cast<double>(shape.size() - 1 - i); });
    std::vector<double> moments(mesh_.n_sections(), 0.0), forces(mesh_.n_unknowns());
    for (Eigen::Index k = 0; k < n_sections; ++k) {
      moments[static_cast<std::size_t>(k)] = 1.0;
      mesh_.bending_forces(moments, forces);
      bending_.col(k) = Eigen::Map<Eigen::VectorXd>(forces.data(), n);
      moments[static_cast<std::size_t>(k)] = 0.0;
    }
    std::vector<double> load(mesh_.n_unknowns(), 0.0);
    mesh_.struck_point().add_to(load, 1.0);
    load_ = Eigen::Map<Eigen::VectorXd>(load.data(), n);
  }

  /// Moments M (positive at the struck point) for a force; in units where the yield moment is 1.
  Eigen::VectorXd moments(double force, bool hinged) const {
    const Eigen::Index n = bending_.rows();
    const Eigen::Index m = bending_.cols();
    // Mass a - bending(moments) = force: unknowns a, then moments but the hinge's, then rotation.
    Eigen::MatrixXd matrix(n, n);
    matrix.col(0) = translation_;
    matrix.middleCols(1, m - 1) = -bending_.leftCols(m - 1);
    matrix.col(m) = hinged ? rotation_ : Eigen::VectorXd(-bending_.col(m - 1));
    Eigen::VectorXd right = force * load_;
    if (hinged) right -= bending_.col(m - 1);  // moments passed on are -M
    const Eigen::VectorXd solution = matrix.partialPivLu().solve(right);
    Eigen::VectorXd result(m);
    result.head(m - 1) = -solution.segment(1, m - 1);
    result(m - 1) = hinged ? 1.0 : -solution(m);
    return result;
  }

  double half_length() const { return half_length_; }
  /// Distance of a section from the struck one, over the half length.
  double distance(Eigen::Index section) const {
    const auto x = mesh_.section_positions();
    return (x.back() - x[static_cast<std::size_t>(section)]) / half_length_;
  }

 private:
  CellMesh mesh_;
  double half_length_;
  Eigen::VectorXd translation_, rotation_, load_;
  Eigen::MatrixXd bending_;
};

}  // namespace

Outcome check_rigid_plastic() {
  const Case input = case_of("rigid_plastic");
  const RigidLink link(input.scene.beam, static_cast<std::size_t>(input.model.segments));
  const double half = link.half_length();
  Outcome outcome{"Lee and Symonds 1952", {}, {}};
  // A rigid beam: the moment at the middle is proportional to the force.
  const Eigen::VectorXd rigid = link.moments(1.0, false);
  outcome.rows.push_back({"P L/M_p at which the first hinge forms", 4.0,
                          half / rigid(rigid.size() - 1), Bound::relative, 2e-3});
  // One hinge: the force at which the hogging moment further out reaches the yield moment, too.
  double low = 4.0 / half, high = 40.0 / half;
  Eigen::Index where = 0;
  for (int i = 0; i < 60; ++i) {
    const double force = 0.5 * (low + high);
    const double lowest = link.moments(force, true).minCoeff(&where);
    (lowest > -1.0 ? low : high) = force;
  }
  outcome.rows.push_back(
      {"P L/M_p at which side hinges form", 22.887, low * half, Bound::relative, 5e-3});
  outcome.rows.push_back({"their distance from the middle over L", 0.4039, link.distance(where),
                          Bound::absolute, 2e-3});
  return outcome;
}

}  // namespace subimpact::validation
