#include "handway/planning/grasps/given_grasps.h"

#include "handway/planning/grasps/grasp_file.h"
#include "handway_test/input_errors.h"
#include "handway_test/known_problems.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace handway::planning {
namespace {

using testing::HasSubstr;

class GivenGrasps : public testing::Test {
 protected:
  static PlanningProblem can_on_table() {
    for (const test::KnownProblem& known : test::known_problems()) {
      if (known.name == "can_on_table") {
        const SceneState scene = test::load(known);
        return make_problem(scene.scene, scene.basis);
      }
    }
    throw std::runtime_error("no such scene");
  }
  std::filesystem::path file(const std::string& text) const {
    const std::filesystem::path path = folder_.path() / "grasps.yaml";
    std::ofstream(path) << text;
    return path;
  }
  MeasuredGrasps measured(const std::string& text) const {
    return measure_given_grasps(problem_, "can", read_given_grasps(file(text), problem_, "can"));
  }
  std::string refusal(const std::string& text) const {
    return test::refusal_of(
        [&] { static_cast<void>(read_given_grasps(file(text), problem_, "can")); });
  }

  test::ScratchFolder folder_;
  PlanningProblem problem_ = can_on_table();
};

TEST_F(GivenGrasps, AreMeasuredAsTheyWereFound) {
  PregraspOptions options;
  options.most = 10;
  const Pregrasps found = find_pregrasps(problem_, "can", options);
  ASSERT_EQ(found.found.size(), 10U);
  const MeasuredGrasps given = measured(grasp_file_text(problem_, "can", options, found));
  EXPECT_TRUE(given.left_out.empty());
  ASSERT_EQ(given.grasps.found.size(), 10U);
  for (const Pregrasp& grasp : given.grasps.found) {
    EXPECT_THAT(grasp.source, HasSubstr("grasps.yaml:"));
    EXPECT_FALSE(problem_.checker->clone()->first_collision(grasp.q));
  }
  for (const Pregrasp& grasp : found.found) {
    EXPECT_TRUE(std::ranges::any_of(given.grasps.found, [&](const Pregrasp& other) {
      return std::abs(other.quality.epsilon - grasp.quality.epsilon) < 0.01;
    })) << grasp.quality.epsilon;
  }
}

TEST_F(GivenGrasps, MayBeMatricesAndQuaternionsOfAnyLink) {
  const std::string palm = problem_.model().link(problem_.hand.palm).name;
  const std::vector<GivenGrasp> grasps = read_given_grasps(
      file("link: " + palm +
           "\ngrasps:\n"
           "  - {pose: [0.1, 0, 0.05, 0, 0, 1, 0], joints: {}}\n"
           "  - {pose: [[-1, 0, 0, 0.1], [0, -1, 0, 0], [0, 0, 1, 0.05], [0, 0, 0, 1]],"
           " joints: {}}\n"
           "  - {palm_in_object: {xyz: [0.1, 0, 0.05], rpy: [0, 0, 180]}, grasp: {}}\n"),
      problem_, "can");
  ASSERT_EQ(grasps.size(), 3U);
  for (const GivenGrasp& grasp : grasps) {
    EXPECT_TRUE(grasp.X_OP.isApprox(grasps.front().X_OP, 1e-9));
  }
}

// A file of the same hand on another arm has other names for the arm's joints.
TEST_F(GivenGrasps, MayNameJointsOfAnotherArm) {
  std::string joints;
  for (const int v : problem_.joints.hand) {
    joints +=
        '"' + problem_.model().variable(v).name + "\": " + std::to_string(problem_.start[v]) + ", ";
  }
  const std::string begin = "- {pose: [0, 0, 0, 0, 0, 0, 1], joints: {";
  EXPECT_EQ(read_given_grasps(file(begin + joints + "shoulder_pan: 1}}"), problem_, "can").size(),
            1U);
  EXPECT_THAT(refusal(begin + "shoulder_pan: 1}}"), HasSubstr("shoulder_pan"));
}

TEST_F(GivenGrasps, MayNameJointsThatFollow) {
  const geometric::RobotModel& model = problem_.model();
  int link = 1;
  while (link + 1 < model.link_count() &&
         !(model.joint(link).mimic && model.mimic_mapping(link).multiplier != 0.0)) {
    ++link;
  }
  const auto& [variable, multiplier, offset] = model.mimic_mapping(link);
  ASSERT_GE(variable, 0);
  const std::string name = '"' + model.joint(link).name + "\": ";
  const std::string begin = "- {pose: [0, 0, 0, 0, 0, 0, 1], joints: {";
  const std::vector<GivenGrasp> grasps = read_given_grasps(
      file(begin + name + std::to_string(offset + 0.3 * multiplier) + "}}"), problem_, "can");
  EXPECT_NEAR(grasps.front().q[variable], 0.3, 1e-5);
  EXPECT_THAT(refusal(begin + name + std::to_string(offset + 0.3 * multiplier) + ", \"" +
                      model.variable(variable).name + "\": 0.1}}"),
              HasSubstr("as coupled to joint " + model.variable(variable).name));
}

TEST_F(GivenGrasps, AreLeftOutWithTheReason) {
  const MeasuredGrasps given = measured(
      "- {pose: [9, 0, 0, 0, 0, 0, 1], joints: {}}\n"
      "- {pose: [0, 0, 0, 0, 0, 0, 1], joints: {}}\n");
  EXPECT_TRUE(given.grasps.found.empty());
  ASSERT_EQ(given.left_out.size(), 2U);
  EXPECT_THAT(given.left_out[0], HasSubstr("grasps.yaml:1: the arm does not get there."));
  EXPECT_THAT(given.left_out[1], HasSubstr("grasps.yaml:2: "));
}

TEST_F(GivenGrasps, AreRefusedIfTheyCannotBeRead) {
  EXPECT_THAT(refusal("grasps: []"), HasSubstr("no grasps"));
  EXPECT_THAT(refusal("- {pose: [1, 2, 3], joints: {}}"), HasSubstr("a list of 3"));
  EXPECT_THAT(refusal("- {pose: [0, 0, 0, 0, 0, 0, 2], joints: {}}"), HasSubstr("length is not 1"));
  EXPECT_THAT(refusal("- {pose: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 2, 0], [0, 0, 0, 1]],"
                      " joints: {}}"),
              HasSubstr("no rotation"));
  EXPECT_THAT(refusal("- {pose: [0, 0, 0, 0, 0, 0, 1], joints: {nothing: 1}}"),
              HasSubstr("nothing"));
  EXPECT_THAT(refusal("link: nowhere\ngrasps:\n  - {pose: [0, 0, 0, 0, 0, 0, 1], joints: {}}"),
              HasSubstr("nowhere"));
  EXPECT_THAT(refusal("- {joints: {}}"), HasSubstr("palm_in_object"));
  EXPECT_THAT(refusal("- {pose: [0, 0, 0, 0, 0, 0, 1], joints: {}, pregasp: {}}"),
              HasSubstr("Did you mean \"pregrasp\"?"));
  EXPECT_THAT(refusal("- {pose: [0, 0, 0, 0, 0, 0, 1], joints: {\"" +
                      problem_.model().variable(problem_.joints.hand.front()).name + "\": 80}}"),
              HasSubstr("Is this value in degrees?"));
  EXPECT_THAT(refusal("handway_grasps: 2\ngrasps: []"), HasSubstr("version 1"));
}

}  // namespace
}  // namespace handway::planning
