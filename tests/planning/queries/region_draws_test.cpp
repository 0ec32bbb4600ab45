#include "handway/planning/queries/region_draws.h"

#include "handway/geometric/robot/hand_structure.h"
#include "handway/planning/planners/planner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <handway_test/planar_problems.h>

#include <stop_token>

namespace handway::planning {
namespace {

using testing::SizeIs;

class RegionDrawsOfTheFlatArm : public testing::Test {
 protected:
  [[nodiscard]] int palm() const { return problem_.model().find_link("palm").value(); }
  [[nodiscard]] RegionDraws draw(const SamplingRegion& region, int configurations,
                                 const std::stop_token& stop = {}) const {
    return draw_region(problem_, palm(), region, configurations, stop);
  }

  PlanningProblem problem_ = test::open_problem();
};

TEST_F(RegionDrawsOfTheFlatArm, AreOnTheStraightMotionForANarrowCorridor) {
  const RegionDraws draws = draw({.rho_a = 1e-5}, 50);
  EXPECT_THAT(draws.palms, SizeIs(50));
  EXPECT_THAT(draws.fingertips,
              SizeIs(50 * geometric::fingertips(problem_.model(), problem_.joints.hand).size()));
  EXPECT_LT(draws.palm_reach, 1e-3);
  EXPECT_GT((draws.motion.back() - draws.motion.front()).norm(), 0.1);
}

TEST_F(RegionDrawsOfTheFlatArm, SpreadWithTheCorridor) {
  const RegionDraws narrow = draw({.rho_a = 0.01}, 200);
  const RegionDraws wide = draw({.rho_a = 0.04}, 200);
  EXPECT_NEAR(wide.palm_reach / narrow.palm_reach, 4.0, 0.5) << "the same draws, moved outwards";
  EXPECT_GT(narrow.hypercubes, wide.hypercubes);
}

TEST_F(RegionDrawsOfTheFlatArm, SpreadTheFingersWithMoreDirections) {
  const auto away = [&](int pmds) {
    const RegionDraws one = draw({.rho_a = 1e-5, .pmds = 0}, 100);
    const RegionDraws more = draw({.rho_a = 1e-5, .pmds = pmds}, 100);
    double sum = 0.0;
    for (std::size_t i = 0; i < one.fingertips.size(); ++i) {
      sum += (one.fingertips[i] - more.fingertips[i]).norm();
    }
    return sum;
  };
  EXPECT_EQ(away(0), 0.0);
  EXPECT_GT(away(1), 0.1);
  EXPECT_GT(away(2), 0.1);
}

TEST_F(RegionDrawsOfTheFlatArm, AreTheSameEveryTime) {
  const SamplingRegion region{.rho_a = 0.02};
  EXPECT_EQ(draw(region, 20).fingertips, draw(region, 20).fingertips);
}

TEST_F(RegionDrawsOfTheFlatArm, EndWhenNobodyWaitsForThem) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THAT(draw({}, 1000, stop.get_token()).palms, SizeIs(0));
}

TEST(FirstRegion, IsWhatThePlannersParametersSay) {
  const PlannerRegistry registry;
  const auto planner = registry.create("pmd-prm");
  planner->set_parameter("rho_a", "0.02");
  planner->set_parameter("corridor", "cartesian");
  const std::optional<SamplingRegion> region = first_region(*planner, 9);
  ASSERT_TRUE(region);
  EXPECT_EQ(region->rho_a, 0.02);
  EXPECT_EQ(region->corridor, CorridorForm::kCartesian);
  EXPECT_EQ(region->pmds, 4) << "the planner's most";
  EXPECT_EQ(region->hand, HandSpace::kPrincipalDirections);
}

TEST(FirstRegion, KnowsPlannersWithoutOne) {
  const PlannerRegistry registry;
  EXPECT_FALSE(first_region(*registry.create("rrt-connect"), 9)) << "draws from everywhere";
  EXPECT_EQ(first_region(*registry.create("auto"), 9)->pmds, 9);
  EXPECT_EQ(first_region(*registry.create("full-prm"), 9)->hand, HandSpace::kAllJoints);
}

TEST(FirstRegion, IsThatOfEachSearchInARace) {
  const auto planner = PlannerRegistry().create("auto");
  const std::vector<SamplingRegion> regions = first_regions(*planner, 9);
  ASSERT_THAT(regions, SizeIs(4));
  EXPECT_EQ(regions[0].rho_a, first_region(*planner, 9)->rho_a);
  EXPECT_EQ(regions[1].rho_a, 1.0) << "expansive trees go anywhere";
  EXPECT_THAT(first_regions(*PlannerRegistry().create("pmd-prm"), 9), SizeIs(1));
  EXPECT_THAT(first_regions(*PlannerRegistry().create("rrt-connect"), 9), SizeIs(0));
}

}  // namespace
}  // namespace handway::planning
