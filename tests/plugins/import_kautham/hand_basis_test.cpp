#include "handway_test/paths.h"
#include "kautham_importer.h"
#include "small_problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::import_kautham {
namespace {

using sampling::PmdBasis;
using test::SmallProblem;

TEST(KauthamHandBasis, KeepsControlsAsPrinted) {
  const SmallProblem files;
  const planning::SceneState loaded = KauthamImporter().read(files.problem());
  const PmdBasis& basis = *loaded.basis;
  EXPECT_THAT(basis.joints, testing::ElementsAre("Thumb", "Spread", "Med"));
  EXPECT_EQ(basis.mean, Eigen::Vector3d(0.4, 0.5, 0.3));
  ASSERT_EQ(basis.free_joints.size(), 1U);
  EXPECT_EQ(basis.free_joints[0].joint, 0);
  EXPECT_EQ(basis.free_joints[0].centre, 0.4);
  EXPECT_EQ(basis.free_joints[0].half_side, 0.4);
  ASSERT_EQ(basis.directions.size(), 2U);
  EXPECT_EQ(basis.directions[0].name, "Close") << "the widest comes first";
  EXPECT_EQ(basis.directions[0].half_side, 0.45);
  EXPECT_EQ(basis.directions[0].vector, Eigen::Vector3d(0.0, 0.6, 0.8));
  EXPECT_EQ(basis.directions[1].name, "Spread");
}

TEST(KauthamHandBasis, WarnsOfVectorsThatAreNotUnit) {
  const SmallProblem files;
  SmallProblem::edit(files.robot(), "\" 0.8\"", "\" 0.7\"");
  SmallProblem::edit(files.robot(), "\"0.8\"/>\n    </Control>\n  </ControlSet>",
                     "\"0.7\"/>\n    </Control>\n  </ControlSet>");
  const planning::SceneState loaded = KauthamImporter().read(files.problem());
  EXPECT_THAT(loaded.scene->warnings,
              testing::Contains(testing::HasSubstr("not of unit length over the joints that move "
                                                   "on their own: the vectors of controls Close")));
}

TEST(KauthamHandBasis, IsAbsentWithoutControls) {
  const SmallProblem files;
  SmallProblem::edit(files.robot(), "<ControlSet", "<Unused");
  SmallProblem::edit(files.robot(), "</ControlSet>", "</Unused>");
  EXPECT_FALSE(KauthamImporter().read(files.robot()).basis);
}

PmdBasis reference_basis(const std::filesystem::path& reference, const char* robot) {
  return *KauthamImporter().read(reference / "auro/robots" / robot).basis;
}

TEST(ReferenceHandBasis, HasThePapersThumbAndFourDirections) {
  HANDWAY_NEED_REFERENCE(reference);
  const PmdBasis basis = reference_basis(reference, "TX90_RHand_5PMD_thumb2.rob");
  EXPECT_EQ(basis.joints.size(), 13U);
  ASSERT_EQ(basis.free_joints.size(), 1U);
  EXPECT_EQ(basis.joints[static_cast<std::size_t>(basis.free_joints[0].joint)], "Thumb");
  ASSERT_EQ(basis.directions.size(), 4U);
  for (const sampling::PrincipalDirection& direction : basis.directions) {
    EXPECT_NEAR(direction.vector.norm(), 1.0, 1e-3) << direction.name;
  }
  EXPECT_DOUBLE_EQ(basis.directions[0].half_side, 0.8275);
  EXPECT_DOUBLE_EQ(basis.directions[3].half_side, 0.3587);
}

TEST(ReferenceHandBasis, MapsToThePostureOfTheControls) {
  HANDWAY_NEED_REFERENCE(reference);
  const PmdBasis basis = reference_basis(reference, "TX90_RHand_5PMD_thumb2.rob");
  Eigen::VectorXd u = Eigen::VectorXd::Constant(5, 0.5);
  EXPECT_LT((sampling::map_to_posture(basis, u) - basis.mean).norm(), 1e-12);
  u[1] = 1.0;  // C1 = 1: the medial joint of the thumb goes up by 0.8275 * 0.3194
  EXPECT_NEAR(sampling::map_to_posture(basis, u)[3], 0.5143 + 0.8275 * 0.3194, 1e-12);
}

TEST(ReferenceHandBasis, OfAllJointsIsFree) {
  HANDWAY_NEED_REFERENCE(reference);
  const PmdBasis basis = reference_basis(reference, "TX90_RHand_allDOF.rob");
  EXPECT_EQ(basis.free_joints.size(), 13U);
  EXPECT_THAT(basis.directions, testing::IsEmpty());
}

TEST(ReferenceHandBasis, OfThirteenDirectionsEndsWithTheMotionlessOne) {
  HANDWAY_NEED_REFERENCE(reference);
  const planning::SceneState loaded =
      KauthamImporter().read(reference / "auro/robots/TX90_RHand_13PMD_SUN.rob");
  ASSERT_EQ(loaded.basis->directions.size(), 13U);
  EXPECT_EQ(loaded.basis->directions.back().half_side, 0.0);
  // The printed sixth vector has lost some entries.
  EXPECT_THAT(loaded.scene->warnings,
              testing::ElementsAre(testing::HasSubstr("Thumb-Dist would follow Thumb-Med but for"),
                                   testing::HasSubstr("vectors of controls C1 C3 C5 C6")));
}

}  // namespace
}  // namespace handway::import_kautham
