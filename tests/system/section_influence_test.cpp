// What one section's moment does to the beam, worked out once a section.

#include "system/section_events.h"

#include "model/cell_mesh.h"
#include "model/hermite_mesh.h"
#include "model/timoshenko_mesh.h"
#include "paper_scene.h"
#include "random_walk.h"
#include "testing.h"

namespace subimpact {
namespace {

struct Mesh {
  std::string name;
  std::unique_ptr<BeamMesh> mesh;
};

std::vector<Mesh> meshes() {
  const Beam rayleigh = paper_beam();
  Beam slender = rayleigh;
  slender.theory = BeamTheory::euler_bernoulli;
  std::vector<Mesh> all;
  for (const Beam& beam : {rayleigh, slender}) {
    const std::string theory = beam.theory == BeamTheory::rayleigh ? "Rayleigh" : "slender";
    all.push_back(
        {theory + " half of cells",
         std::make_unique<CellMesh>(beam, 0.5, std::size_t{201}, CellMesh::Extent::half)});
    all.push_back(
        {theory + " cells, struck off centre",
         std::make_unique<CellMesh>(beam, 0.317, std::size_t{60}, CellMesh::Extent::whole)});
    all.push_back(
        {theory + " half of elements",
         std::make_unique<HermiteMesh>(beam, 0.5, std::size_t{40}, 2, HermiteMesh::Extent::half)});
  }
  Beam shearing = rayleigh;
  shearing.theory = BeamTheory::timoshenko;
  shearing.poisson = 0.33;
  all.push_back(
      {"half of cells that shear", std::make_unique<TimoshenkoMesh>(shearing, 0.5, std::size_t{51},
                                                                    TimoshenkoMesh::Extent::half)});
  shearing.ends = {EndSupport::pinned, EndSupport::clamped};
  all.push_back({"cells that shear, supported, struck off centre",
                 std::make_unique<TimoshenkoMesh>(shearing, 0.317, std::size_t{60},
                                                  TimoshenkoMesh::Extent::whole)});
  return all;
}

// Calls check(mesh, solver, influence) on every mesh.
template <class Check>
void on_every_mesh(Check check) {
  for (const Mesh& of : meshes()) {
    SCOPED_TRACE(of.name);
    const BandedSolver solver(of.mesh->mass());
    SectionInfluence influence(*of.mesh, solver);
    check(*of.mesh, solver, influence);
  }
}

double largest_of(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

TEST(SectionInfluence, GivesTheCurvatureAccelerationsThatAMassSolveGives) {
  on_every_mesh([](const BeamMesh& mesh, const BandedSolver& solver, SectionInfluence& influence) {
    const std::vector<double> moments = random_numbers(7, mesh.n_sections());
    constexpr double force = 3.0;
    std::vector<double> accelerations(mesh.n_unknowns());
    mesh.bending_forces(moments, accelerations);
    mesh.struck_point().add_to(accelerations, force);
    std::vector<double> shear_forces(mesh.shears() ? mesh.n_unknowns() : 0, 0.0);
    mesh.add_shear_forces(random_numbers(8, mesh.n_unknowns(), 1e-9), shear_forces);
    for (std::size_t i = 0; i < shear_forces.size(); ++i) accelerations[i] += shear_forces[i];
    solver.solve(accelerations);
    std::vector<double> expected(mesh.n_sections());
    mesh.curvatures(accelerations, expected);
    std::vector<double> weighted = moments;
    for (std::size_t i = 0; i < weighted.size(); ++i) weighted[i] *= mesh.section_weights()[i];
    const double largest = largest_of(expected);
    for (std::size_t i = 0; i < weighted.size(); ++i) {
      EXPECT_NEAR(influence.curvature_acceleration(i, weighted, force, shear_forces), expected[i],
                  1e-13 * largest)
          << "section " << i;
    }
  });
}

TEST(SectionInfluence, AddsUpToTheAccelerationsOfAllMoments) {
  on_every_mesh([](const BeamMesh& mesh, const BandedSolver& solver, SectionInfluence& influence) {
    const std::vector<double> moments = random_numbers(11, mesh.n_sections());
    std::vector<double> expected(mesh.n_unknowns());
    mesh.bending_forces(moments, expected);
    solver.solve(expected);
    std::vector<double> sum(mesh.n_unknowns(), 0.0);
    for (std::size_t i = 0; i < moments.size(); ++i) {
      influence.add_accelerations(i, moments[i], sum);
    }
    const double largest = largest_of(expected);
    for (std::size_t i = 0; i < sum.size(); ++i) {
      EXPECT_NEAR(sum[i], expected[i], 1e-13 * largest) << "unknown " << i;
    }
  });
}

TEST(SectionInfluence, OfOneSectionOnAnotherIsTheCurvatureOfItsAccelerations) {
  on_every_mesh([](const BeamMesh& mesh, const BandedSolver&, SectionInfluence& influence) {
    for (const std::size_t section : {std::size_t{0}, mesh.n_sections() / 3}) {
      std::vector<double> accelerations(mesh.n_unknowns(), 0.0);
      influence.add_accelerations(section, 1.0, accelerations);
      std::vector<double> curvatures(mesh.n_sections());
      mesh.curvatures(accelerations, curvatures);
      const double own = std::abs(curvatures[section]);
      for (std::size_t other = 0; other < mesh.n_sections(); ++other) {
        EXPECT_NEAR(influence.curvature_acceleration_at(other, section), curvatures[other],
                    1e-13 * own);
      }
    }
  });
}

}  // namespace
}  // namespace subimpact
