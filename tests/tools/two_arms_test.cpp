/// Tests plans of two arms with two hands alone and together, as robots of one scene or on one
/// stand.
#include "command_line.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace handway::test {
namespace {

namespace fs = std::filesystem;

/// An arm of seven joints with a hand, standing in the world or mounted.
std::string arm_with_hand(const fs::path& robots, const std::string& side,
                          const std::string& where) {
  return "  - {name: " + side + ", model: " + (robots / "iiwa14/iiwa14.urdf").string() + ", " +
         where + "}\n  - {name: " + side +
         "_hand, model: " + (robots / "allegro_hand/allegro_hand_right.urdf").string() +
         ", mount: {robot: " + side +
         ", link: ee_link, pose: {xyz: [0.1, 0, 0], rpy_deg: [0, 90, 0]}}}\n";
}

/// Returns goals at which both arms reach forward. @param left prefix of the names of its joints:
/// the part that stands in the world keeps its own.
std::string goals(const std::string& left) {
  return "goal: {" + left + "A1: 0.3, " + left + "A2: 0.7, " + left +
         "A4: -1.2, right/A1: -0.3, right/A2: 0.7, right/A4: -1.2, right_hand/joint_1.0: 0.4}\n";
}

constexpr const char* kPost =
    "objects:\n  - {name: post, box: {size: [0.1, 0.1, 1.5]}, pose: {xyz: [0.55, 0, 0.75]}}\n";

class TwoArmsOfOthers : public ::testing::Test {
 protected:
  /// Plans, checks, and returns the report.
  nlohmann::json planned(const std::string& more) const {
    const Outcome plan =
        line_.run("plan two.yaml --time-limit 60 --out path.csv --report r.json" + more);
    EXPECT_EQ(plan.exit_code, 0) << more << plan.err;
    EXPECT_EQ(line_.run("check two.yaml path.csv" + more).exit_code, 0) << more;
    EXPECT_EQ(line_.run("time path.csv --scene two.yaml" + more).exit_code, 0) << more;
    return nlohmann::json::parse(line_.read("r.json"));
  }
  CommandLine line_;
};

TEST_F(TwoArmsOfOthers, PlanAloneAndTogetherWhereTheyStand) {
  HANDWAY_NEED_REFERENCE(reference);
  const fs::path robots = reference / "robots";
  line_.write("two.yaml", "handway: 1\nrobots:\n" +
                              arm_with_hand(robots, "left", "base: {xyz: [0, 0.4, 0]}") +
                              arm_with_hand(robots, "right", "base: {xyz: [0, -0.4, 0]}") + kPost +
                              "group: [left, left_hand, right, right_hand]\n" + goals(""));
  EXPECT_EQ(planned("")["moving"].size(), 46U);
  EXPECT_EQ(planned(" --group right,right_hand")["moving"].size(), 23U);
  EXPECT_EQ(planned(" --group left")["moving"].size(), 7U);
}

TEST_F(TwoArmsOfOthers, PlanAloneAndTogetherOnOneStand) {
  HANDWAY_NEED_REFERENCE(reference);
  const fs::path robots = reference / "robots";
  line_.write("stand.urdf",
              "<robot name=\"stand\"><link name=\"plate\"><collision><origin xyz=\"0 0 -0.05\"/>"
              "<geometry><box size=\"0.3 1.1 0.1\"/></geometry></collision></link></robot>");
  const auto on_stand = [](const std::string& y) {
    return "mount: {robot: stand, link: plate, pose: {xyz: [0, " + y + ", 0]}}";
  };
  line_.write("two.yaml", "handway: 1\nrobots:\n  - {name: stand, model: stand.urdf}\n" +
                              arm_with_hand(robots, "left", on_stand("0.4")) +
                              arm_with_hand(robots, "right", on_stand("-0.4")) + kPost +
                              goals("left/"));
  EXPECT_EQ(planned("")["moving"].size(), 46U) << "everything of one robot";
  EXPECT_EQ(planned(" --group right")["moving"].size(), 7U);
}

}  // namespace
}  // namespace handway::test
