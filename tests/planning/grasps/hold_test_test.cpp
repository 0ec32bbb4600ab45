#include "handway/planning/grasps/hold_test.h"

#include <gtest/gtest.h>

#include <stop_token>
#include <string>
#include <vector>

namespace handway::planning {
namespace {

/// Holds from some friction on, up to some mass and some misplacement.
class SimpleHold : public HoldTest {
 public:
  [[nodiscard]] HoldResult test(const Pregrasp& grasp, const HoldConditions& conditions,
                                const std::stop_token& stop,
                                const HoldWatcher& /*watch*/) const override {
    const bool holds = grasp.quality.epsilon > 0.0 && conditions.contact.friction >= 0.23 &&
                       conditions.mass <= 0.7 && conditions.misplacement.norm() < 0.007;
    HoldResult result;
    result.directions.assign(6, {holds, 0.0, 0.0});
    if (!stop.stop_requested()) {
      result.lift = HoldSlip{holds, 0.0, 0.0};
    }
    return result;
  }
  [[nodiscard]] CarryResult carry(const Pregrasp& /*grasp*/, const PalmMotion& /*motion*/,
                                  const HoldConditions& /*conditions*/,
                                  const std::stop_token& /*stop*/,
                                  const HoldWatcher& /*watch*/) const override {
    return {};
  }
  [[nodiscard]] std::vector<std::string> assumptions() const override { return {}; }
};

Pregrasp grasp_with(double epsilon) {
  Pregrasp grasp;
  grasp.quality.epsilon = epsilon;
  return grasp;
}

TEST(HoldMargins, AreWhereAGraspJustHolds) {
  const HoldMargins margins = hold_margins(SimpleHold(), grasp_with(0.1), {});
  ASSERT_TRUE(margins.least_friction && margins.largest_mass && margins.position_error);
  EXPECT_GE(*margins.least_friction, 0.23) << "it holds there";
  EXPECT_LE(*margins.least_friction, 0.24);
  EXPECT_LE(*margins.largest_mass, 0.7);
  EXPECT_GE(*margins.largest_mass, 0.7 / 1.05);
  EXPECT_EQ(*margins.position_error, 0.005);
}

TEST(HoldMargins, AreNoneOfAGraspThatDoesNotHold) {
  const HoldMargins margins = hold_margins(SimpleHold(), grasp_with(0.0), {});
  EXPECT_FALSE(margins.least_friction || margins.largest_mass || margins.position_error);
}

std::vector<double> epsilons(const std::vector<TestedGrasp>& ranked) {
  std::vector<double> all;
  for (const TestedGrasp& tested : ranked) {
    all.push_back(tested.grasp.quality.epsilon);
  }
  return all;
}

TEST(RankByTests, PutsFirstWhatHolds) {
  const std::vector<Pregrasp> grasps{grasp_with(0.0), grasp_with(0.2), grasp_with(0.1)};
  const std::vector<TestedGrasp> ranked = rank_by_tests(SimpleHold(), grasps, 3, {}, 2);
  EXPECT_EQ(epsilons(ranked), (std::vector{0.2, 0.1, 0.0}));
  EXPECT_TRUE(ranked[0].hold->held_under_all_loads());
  EXPECT_EQ(ranked[2].hold->loads_held(), 0);
}

TEST(RankByTests, EndsWhenEnoughHold) {
  const std::vector<Pregrasp> grasps{grasp_with(0.0), grasp_with(0.3), grasp_with(0.2),
                                     grasp_with(0.1)};
  const std::vector<TestedGrasp> ranked = rank_by_tests(SimpleHold(), grasps, 1, {}, 1);
  EXPECT_EQ(epsilons(ranked), (std::vector{0.3, 0.2, 0.1, 0.0}));
  EXPECT_FALSE(ranked[1].hold || ranked[2].hold) << "one that holds was wanted";
  EXPECT_TRUE(ranked[3].hold) << "it was tried first";
  EXPECT_EQ(epsilons(rank_by_tests(SimpleHold(), grasps, 1, {}, 4)), epsilons(ranked));
}

TEST(RankByTests, TestsNothingUnlessItIsWanted) {
  EXPECT_TRUE(rank_by_tests(SimpleHold(), {}, 5, {}, 2).empty());
  EXPECT_FALSE(rank_by_tests(SimpleHold(), {grasp_with(0.1)}, 0, {}, 2).front().hold);
  EXPECT_FALSE(HoldResult{}.held());
}

TEST(RankByTests, LeavesOutWhatWasStopped) {
  std::stop_source stop;
  stop.request_stop();
  const std::vector<TestedGrasp> ranked =
      rank_by_tests(SimpleHold(), {grasp_with(0.1)}, 1, {}, 1, stop.get_token());
  ASSERT_EQ(ranked.size(), 1U);
  EXPECT_FALSE(ranked.front().hold);
}

}  // namespace
}  // namespace handway::planning
