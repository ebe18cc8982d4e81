#include "subimpact/study/run_as_asked.h"

#include "elastic_case.h"
#include "subimpact/case/simulate.h"
#include "testing.h"

namespace subimpact {
namespace {

// At 0.1 m/s nothing yields: the first contact of the published beam ends at 403.89 us, with shear
// (k = 5/6, nu = 0.33) at 424.18 us, in the limit of fine meshes.
TEST(NeglectedShear, IsThatOfFineMeshesToATenthOfItsSize) {
  Case input = elastic_case(0.6e-3);
  input.scene.striker.velocity = 0.1;
  input.scene.beam.poisson = 0.33;
  input.scene.beam.shear_coefficient = 5.0 / 6.0;
  const auto shear = neglected_shear(input, simulate(input));
  ASSERT_TRUE(shear && shear->with);
  EXPECT_NEAR(*shear->with - shear->without, 424.18e-6 - 403.89e-6, 2e-6);
}

TEST(NeglectedShear, IsNoneWhereTheTheoryHasShearOrTheBeamIsRigidOrNoContactEnded) {
  Case input = elastic_case(0.6e-3);
  input.end_time = 1e-4;
  EXPECT_FALSE(neglected_shear(input, simulate(input)));
  input.end_time = 0.6e-3;
  EXPECT_TRUE(neglected_shear(input, simulate(input)));
  input.model.mesh = MeshKind::rigid;
  EXPECT_FALSE(neglected_shear(input, simulate(input)));
  input.model.mesh = MeshKind::cells;
  input.scene.beam.poisson = 0.3;
  input.scene.beam.theory = BeamTheory::timoshenko;
  EXPECT_FALSE(neglected_shear(input, simulate(input)));
}

}  // namespace
}  // namespace subimpact
