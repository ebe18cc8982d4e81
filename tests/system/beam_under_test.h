#pragma once

#include "banded_examples.h"
#include "model/mesh/cell_mesh.h"
#include "paper_scene.h"
#include "print.h"
#include "struck_beam_of.h"

namespace subimpact {

/// Models of the paper's example on a coarse mesh, in every combination the tests care for.
struct Model {
  std::string name;
  CellMesh::Extent extent = CellMesh::Extent::whole;
  double position = 0.5;
  bool yields = false;
  std::size_t n_cells = 31;
};

inline void PrintTo(const Model& model, std::ostream* out) { *out << model.name; }

inline std::vector<Model> models() {
  return {{"whole, elastic", CellMesh::Extent::whole, 0.5, false},
          {"whole, yielding", CellMesh::Extent::whole, 0.5, true},
          {"half, elastic", CellMesh::Extent::half, 0.5, false},
          {"half, yielding", CellMesh::Extent::half, 0.5, true},
          {"struck between cells, yielding", CellMesh::Extent::whole, 0.317, true, 30}};
}

inline StruckBeam make_beam(const Model& model) {
  Scene scene = paper_scene();
  scene.striker.position = model.position;
  auto mesh = std::make_unique<CellMesh>(scene.beam, model.position, model.n_cells, model.extent);
  SectionField sections =
      model.yields ? SectionField(mesh->n_sections(), SectionLaw(scene.beam, Fibres::continuous()))
                   : SectionField(mesh->n_sections(), scene.beam.bending_stiffness());
  return struck_beam_of(scene, std::move(mesh), std::move(sections));
}

/// A smooth random motion: the beam bent to about `bending` yield curvatures, the nose pressed in
/// by `indentation` (m) and going deeper at `rate` (m/s).
inline State smooth_state(const StruckBeam& beam, unsigned seed, double bending, double indentation,
                          double rate) {
  const std::size_t n = beam.n_positions() - 1;
  const auto length = static_cast<double>(beam.mesh().symmetric() ? 2 * n - 1 : n);
  const std::vector<double> c = random_numbers(seed, 8);
  State y(2 * (n + 1));
  for (std::size_t i = 0; i < n; ++i) {
    const double x = (static_cast<double>(i) + 0.5) / length;  // even cosines are symmetric
    for (std::size_t k = 0; k < 4; ++k) {
      const double shape = std::cos(2.0 * std::numbers::pi * static_cast<double>(k) * x);
      y[i] += 1e-3 * c[k] * shape;
      y[n + 1 + i] += 3.0 * c[4 + k] * shape;
    }
  }
  std::vector<double> curvatures(beam.mesh().n_sections());
  beam.mesh().curvatures({y.data(), n}, curvatures);
  const double factor = bending * paper_beam().yield_curvature() / largest_of(curvatures);
  for (std::size_t i = 0; i < n; ++i) y[i] *= factor;
  y[n] = beam.mesh().struck_point()({y.data(), n}) + indentation;
  y.back() = beam.mesh().struck_point()({y.data() + n + 1, n}) + rate;
  return y;
}

/// y + h y', by the beam's own equations.
inline State along_the_flow(StruckBeam& beam, const State& y, double h) {
  const std::size_t n = beam.n_positions();
  std::vector<double> a(n);
  beam.acceleration({y.data(), n}, a);
  State moved = y;
  for (std::size_t i = 0; i < n; ++i) {
    moved[i] += h * y[n + i];
    moved[n + i] += h * a[i];
  }
  return moved;
}

/// Puts a beam into a branch of the contact, with a given largest indentation.
inline void enter(StruckBeam& beam, ContactBranch branch, double max_indentation) {
  beam.contact().set(branch, {max_indentation});
}

}  // namespace subimpact
