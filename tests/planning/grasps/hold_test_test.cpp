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

TEST(TestGrasps, GivesOneResultForEachOfTheFirst) {
  const std::vector<Pregrasp> grasps{grasp_with(0.1), grasp_with(0.0), grasp_with(0.2)};
  const std::vector<HoldResult> results = test_grasps(SimpleHold(), grasps, 2, {}, 2);
  ASSERT_EQ(results.size(), 2U);
  EXPECT_TRUE(results[0].held());
  EXPECT_FALSE(results[1].held());
  EXPECT_EQ(test_grasps(SimpleHold(), grasps, 100, {}, 1).size(), 3U);
}

TEST(TestGrasps, GivesNothingForNothing) {
  EXPECT_TRUE(test_grasps(SimpleHold(), {}, 5, {}, 2).empty());
  EXPECT_FALSE(HoldResult{}.held());
}

TEST(TestGrasps, LeavesOutWhatWasStopped) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_TRUE(test_grasps(SimpleHold(), {grasp_with(0.1)}, 1, {}, 1, stop.get_token()).empty());
}

}  // namespace
}  // namespace handway::planning
