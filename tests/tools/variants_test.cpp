/// `handway bench --variants`: the problems that are made, and what is said of runs on them.
#include "command_line.h"
#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/limit_violation.h"
#include "handway/geometric/robot/robot_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace handway::test {
namespace {

using geometric::FclChecker;
using geometric::Pose;
using geometric::RobotState;
using geometric::Scene;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string shipped(const std::string& name) {
  return (source_dir() / "scenes" / (name + ".yaml")).string();
}

Eigen::Vector3d middle_of(const geometric::SceneObject& object) {
  return object.X_PO * bounding_box(*tessellate(object.shape)).centre();
}

// Returns the pose of the palm at the goal, seen from an object.
Pose palm_at_goal(const Scene& scene, const std::string& object) {
  RobotState state(scene.robots.front().model, scene.robots.front().X_WB);
  state.set_configuration(scene.goal.value());
  return find_object(scene, object)->X_PO.inverse() * state.link_pose("palm");
}

class HandwayVariants : public testing::Test {
 protected:
  [[nodiscard]] std::vector<std::string> written(const std::string& arguments) const {
    const Outcome run = line_.run("bench " + arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return lines_of(run.out);
  }

  CommandLine line_;
};

TEST_F(HandwayVariants, AreTheSameForTheSameSeed) {
  const std::string problem = shipped("t_shape") + " --variants 2 --write ";
  const std::vector<std::string> names = written(problem + "a");
  ASSERT_EQ(names.size(), 2U);
  EXPECT_EQ(names[1], "a/t_shape_seed1_variant02.yaml");
  static_cast<void>(written(problem + "b"));
  static_cast<void>(written(problem + "c --variant-seed 2"));
  EXPECT_EQ(line_.read("a/t_shape_seed1_variant02.yaml"),
            line_.read("b/t_shape_seed1_variant02.yaml"));
  EXPECT_NE(line_.read("a/t_shape_seed1_variant02.yaml"),
            line_.read("c/t_shape_seed2_variant02.yaml"));
  EXPECT_NE(line_.read("a/t_shape_seed1_variant02.yaml"),
            line_.read("a/t_shape_seed1_variant01.yaml"));
}

TEST_F(HandwayVariants, MoveObjectsALittleButNotFurniture) {
  const Scene original = geometric::read_scene(shipped("cans_on_desk"));
  for (const std::string& file :
       written(shipped("cans_on_desk") + " --variants 3 --variant-seed 5 --write hard")) {
    const Scene variant = geometric::read_scene(line_.folder() / file);
    std::set<std::string> moved;
    for (std::size_t i = 0; i < original.objects.size(); ++i) {
      const geometric::SceneObject& before = original.objects[i];
      const geometric::SceneObject& after = variant.objects[i];
      const Eigen::AngleAxisd turn(after.X_PO.linear() * before.X_PO.linear().transpose());
      const Eigen::Vector3d shift = middle_of(after) - middle_of(before);
      EXPECT_LE(shift.norm(), 0.05 + 1e-9) << before.name;
      EXPECT_LE(std::abs(turn.angle()), geometric::radians(25.0) + 1e-9) << before.name;
      if (!shift.isZero(1e-9)) {
        moved.insert(before.name);
        EXPECT_NEAR(shift.z(), 0.0, 1e-9) << before.name << " stands on something";
        EXPECT_NEAR(std::abs(turn.axis().z()), 1.0, 1e-6) << before.name;
      }
    }
    EXPECT_THAT(moved, testing::ElementsAre("can", "can_left", "can_left_above", "can_right"));
  }
}

TEST_F(HandwayVariants, BeginAndEndFreelyWithTheHandJustOffTheObject) {
  const Scene original = geometric::read_scene(shipped("t_shape"));
  for (const std::string& file : written(shipped("t_shape") + " --variants 3 --write hard")) {
    const Scene variant = geometric::read_scene(line_.folder() / file);
    FclChecker checker(std::make_shared<const geometric::CollisionWorld>(variant));
    for (const auto& q : {variant.start.value(), variant.goal.value()}) {
      EXPECT_THAT(find_collisions(checker, q), IsEmpty()) << file;
      EXPECT_THAT(limit_violations(*variant.robots.front().model, q), IsEmpty()) << file;
    }
    EXPECT_EQ(variant.start, original.start);
    const geometric::NamedPair nearest = find_clearance(checker, variant.goal.value());
    EXPECT_EQ(nearest.b, "t_shape");
    EXPECT_NEAR(geometric::millimetres(nearest.distance), 0.3, 0.01) << file;
    EXPECT_TRUE(palm_at_goal(variant, "t_shape").isApprox(palm_at_goal(original, "t_shape"), 1e-6))
        << file;
  }
}

TEST_F(HandwayVariants, BringObstaclesNearerStepByStep) {
  const auto files = written(shipped("cans_on_desk") + " --variants 12 --write hard");
  ASSERT_EQ(files.size(), 12U);
  const auto gap = [&](const std::string& file) {
    const Scene variant = geometric::read_scene(line_.folder() / file);
    FclChecker checker(std::make_shared<const geometric::CollisionWorld>(variant));
    checker.place(variant.goal.value());
    double least = 1.0;
    for (const char* obstacle : {"can_left", "can_left_above", "can_right"}) {
      for (const int pair : checker.world().pairs_with(obstacle)) {
        least = std::min(least, checker.pair_distance(pair, least));
      }
    }
    return geometric::millimetres(least);
  };
  EXPECT_GT(gap(files[0]), 20.0);
  EXPECT_LT(gap(files[5]), 10.0);
  EXPECT_LT(gap(files[11]), 10.0);
}

TEST_F(HandwayVariants, OfImportedProblemsOpenAgain) {
  HANDWAY_NEED_REFERENCE(reference);
  const std::filesystem::path problem =
      reference / "auro" / "TX90_RHand_ICRA10_5PMD_CanBox_new.xml";
  const auto files = written(problem.string() + " --variants 1 --write hard");
  ASSERT_EQ(files.size(), 1U);
  const Outcome info = line_.run("info " + files[0]);
  EXPECT_THAT(info.out, AllOf(HasSubstr("basis for TX90 SA Hand Right: 13 joints"),
                              HasSubstr("start: free"), HasSubstr("goal: free")));
}

TEST_F(HandwayVariants, AreRunWithPlannersSideBySide) {
  const Outcome run = line_.run(
      "bench post.yaml --variants 2 --seeds 2 --time-limit 5 --planner rrt-connect --check-paths "
      "--out .");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("2 variants"), HasSubstr("auto"), HasSubstr("4/4"),
                             HasSubstr("4 of 4 paths valid at 1 mm"), Not(HasSubstr("FAULT")),
                             HasSubstr("of these the scene's own planner solves 4 (100.0 %)")));
  const auto report = nlohmann::json::parse(line_.read("variants.json"));
  EXPECT_EQ(report["variant_seed"], 1);
  EXPECT_EQ(report["summary"]["pairs"], 4);
  EXPECT_EQ(report["summary"]["default_share"], 1.0);
  ASSERT_EQ(report["scenes"][0]["variants"].size(), 2U);
  const auto& plans = report["scenes"][0]["variants"][1]["plans"];
  ASSERT_EQ(plans.size(), 2U);
  EXPECT_EQ(plans[1]["planner"], "rrt-connect");
  EXPECT_EQ(plans[1]["runs"][1]["seed"], 2);
}

TEST_F(HandwayVariants, NameWhatTheDefaultMissed) {
  line_.replace("walled.yaml", "name: left wall", "locked: true\n    name: left wall");
  line_.replace("walled.yaml", "name: right wall", "locked: true\n    name: right wall");
  const Outcome run = line_.run(
      "bench post.yaml walled.yaml --variants 1 --seeds 1 --time-limit 0.2 --planner rrt-connect "
      "--only-missed --out .");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("missed: variant 1, seed 1; solved by no planner"),
                             HasSubstr("2 pairs of variant and seed, 1 solved by any planner; of "
                                       "these the scene's own planner solves 1 (100.0 %)")));
  const auto report = nlohmann::json::parse(line_.read("variants.json"));
  const auto& missed = report["summary"]["missed_by_default"];
  ASSERT_EQ(missed.size(), 1U);
  EXPECT_EQ(missed[0]["file"], "walled.yaml");
  EXPECT_THAT(missed[0]["solved_by"], IsEmpty());
  const auto& plans = report["scenes"][0]["variants"][0]["plans"];
  EXPECT_THAT(plans[1]["runs"], IsEmpty()) << "nothing was missed there";
}

TEST_F(HandwayVariants, SayWhereNoneIsFound) {
  line_.replace("post.yaml", "-0.4", "-0.066");
  line_.replace("post.yaml", "name: post", "locked: true\n    name: post");  // the start is in it
  const Outcome run = line_.run("bench post.yaml --variants 1 --seeds 1");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("variant 1: no free start and goal in 100 samples"));
}

TEST_F(HandwayVariants, RefuseOptionsThatMeanNothing) {
  for (const std::string arguments :
       {"--variants 0", "--write hard", "--variant-seed 2", "--only-missed", "--others-limit 3",
        "--variants 2 --checks", "--variants 2 --write hard --seeds 3",
        "--variants 2 --checker fcl --checker fast", "--set rho"}) {
    EXPECT_EQ(line_.run("bench open.yaml " + arguments).exit_code, 2) << arguments;
  }
  const Outcome run = line_.run("bench open.yaml --variants 2 --write open.yaml");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, AllOf(HasSubstr("open.yaml"), HasSubstr("a folder to write to")));
}

}  // namespace
}  // namespace handway::test
