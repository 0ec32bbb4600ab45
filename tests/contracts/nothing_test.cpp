/// Tests scenes in which something is empty: no bodies, no pairs, no joints, no objects, no hand.
/// Every query of them has an answer, or one clear message.
#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/collision/continuous/continuous_collision_checker.h"
#include "handway/geometric/collision/narrow_phase/contact.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/hand_structure.h"
#include "handway/geometric/setup/collision_sampling.h"
#include "handway/geometric/setup/robot_setup.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/grasps/pregrasp_search.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/paths/path_file.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/queries/nearest_free.h"
#include "handway/planning/queries/palm_ik.h"
#include "handway/planning/timing/time_path.h"
#include "handway/sampling/postures/principal_components.h"
#include "handway_test/planar_problems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace handway::planning {
namespace {

using geometric::CheckerKind;
using geometric::RobotDescription;
using geometric::Scene;

struct Nothing {
  const char* name;
  Scene (*make)();
};

Scene without(bool shapes, bool joints, bool groups) {
  RobotDescription robot = test::planar_hand_arm();
  for (geometric::Link& link : robot.links) {
    link.collision = shapes ? link.collision : std::vector<geometric::LinkGeometry>();
  }
  for (geometric::Joint& joint : robot.joints) {
    joint.type = joints ? joint.type : geometric::JointType::kFixed;
    joint.mimic = joints ? joint.mimic : std::nullopt;
  }
  if (!groups) {
    robot.groups.clear();
  }
  Scene scene = test::scene_of(std::move(robot));
  const geometric::RobotModel& model = *scene.robots.front().model;
  scene.start = model.neutral();
  scene.goal = 0.5 * (model.neutral() + model.upper());
  return scene;
}

const std::vector<Nothing> kNothings{
    {"NoShapes", [] { return without(false, true, true); }},
    {"NoShapesButAnObject",
     [] {
       Scene scene = without(false, true, true);
       test::add_object(scene, "can", geometric::Cylinder{0.03, 0.1}, Eigen::Vector3d(0.5, 0, 0));
       return scene;
     }},
    {"NoShapesButACarriedObject",
     [] {
       Scene scene = without(false, true, true);
       test::add_object(scene, "can", geometric::Cylinder{0.03, 0.1}, Eigen::Vector3d(0.5, 0, 0));
       scene.objects.back().attachment =
           geometric::Attachment{scene.robots.front().name, "palm", {}};
       return scene;
     }},
    {"NoPairs",
     [] {
       Scene scene = without(true, true, true);
       for (const geometric::Link& a : scene.robots.front().model->description().links) {
         for (const geometric::Link& b : scene.robots.front().model->description().links) {
           scene.allowed_collisions[std::minmax(a.name, b.name)] = true;
         }
       }
       return scene;
     }},
    {"NoJoints", [] { return without(true, false, true); }},
    {"NoJointsNorShapes", [] { return without(false, false, false); }},
    {"OneLinkAlone",
     [] {
       RobotDescription robot;
       robot.name = "stone";
       robot.links.push_back({"stone", {}, {}});
       Scene scene = test::scene_of(std::move(robot));
       scene.start = scene.goal = scene.robots.front().model->neutral();
       return scene;
     }},
    {"NoGroups", [] { return without(true, true, false); }},
    {"NoObjects", [] { return without(true, true, true); }},
    {"AMeshWithoutTriangles",
     [] {
       Scene scene = without(true, true, true);
       const geometric::Mesh empty{
           {}, Eigen::Vector3d::Ones(), std::make_shared<const geometric::TriangleMesh>()};
       test::add_object(scene, "empty", empty, Eigen::Vector3d(0.5, 0, 0));
       return scene;
     }},
};

class EveryNothing : public testing::TestWithParam<Nothing> {
 protected:
  const std::shared_ptr<const Scene> scene_ = std::make_shared<const Scene>(GetParam().make());
  const std::shared_ptr<const geometric::CollisionWorld> world_ =
      std::make_shared<const geometric::CollisionWorld>(*scene_);
  const Configuration start_ = scene_->start.value();
  const Configuration goal_ = scene_->goal.value();
};

TEST_P(EveryNothing, IsAskedByEveryChecker) {
  for (const CheckerKind kind :
       {CheckerKind::kFast, CheckerKind::kFcl, CheckerKind::kFclBroadphase}) {
    const auto checker = make_collision_checker(world_, kind);
    EXPECT_FALSE(checker->first_collision(start_));
    EXPECT_TRUE(find_collisions(*checker, start_).empty());
    EXPECT_TRUE(find_contacts(*checker, start_).empty());
    EXPECT_GT(find_clearance(*checker, start_).distance, 0.0);
    EXPECT_TRUE(checker->enclosed(start_).empty());
    EXPECT_FALSE(is_closer_than(*checker, start_, 1e-6));
    const auto motion = std::make_shared<const geometric::MotionBound>(*world_);
    geometric::ContinuousCollisionChecker edges(*checker, motion, 5e-5);
    static_cast<void>(edges.check(start_, goal_));
    EXPECT_GE(edges
                  .clearance(std::vector{start_, goal_}, std::numeric_limits<double>::infinity(),
                             1e-4, 0.1)
                  .distance,
              0.0);
    EXPECT_GE(motion->any_point(Eigen::VectorXd::Ones(start_.size())), 0.0);
  }
}

TEST_P(EveryNothing, IsPlannedCheckedTimedAndWritten) {
  PluginManager plugins;
  const PlanningProblem problem = make_problem(scene_, nullptr);
  for (const std::string& name : plugins.planners().names()) {
    SCOPED_TRACE(name);
    PlanRequest request;
    request.time_limit_s = 5.0;
    const auto planner = plugins.planners().create(name);
    PlanResult result;
    try {
      result = planner->plan(problem, request);
    } catch (const geometric::InputError& error) {
      EXPECT_FALSE(std::string(error.what()).empty()) << "what it needs, in words";
      continue;
    }
    if (!result.solved()) {
      EXPECT_FALSE(result.reason.empty());
      continue;
    }
    const PathCheckResult check = check_path(problem, result.path, 1e-3);
    EXPECT_TRUE(check.valid()) << check.faults.front();
    for (const bool jerk : {false, true}) {
      TimingOptions options;
      options.limit_jerk = jerk;
      const TimedPath timed = time_path(problem, result.path, "motion", options);
      EXPECT_FALSE(to_text(timed.preflight).empty());
      EXPECT_FALSE(to_json(timed.preflight).empty());
    }
    EXPECT_FALSE(to_csv(result.path, problem.model()).empty());
    if (name == "auto") {
      EXPECT_TRUE(result.path.waypoints.size() >= 1);
    }
  }
}

TEST_P(EveryNothing, IsAskedWhatTheWindowAsks) {
  const PlanningProblem problem = make_problem(scene_, nullptr);
  EXPECT_TRUE(find_nearest_free(problem, start_).q);
  EXPECT_EQ(describe_change(problem.model(), start_, start_), "nothing");
  static_cast<void>(geometric::HandStructure::of(problem.model(), {}, {}));
  static_cast<void>(geometric::sample_overlapping_links(problem.model(), 20, 1));
  for (const geometric::SceneObject& object : scene_->objects) {
    try {
      EXPECT_TRUE(find_pregrasps(problem, object.name).found.size() < 1000);
    } catch (const geometric::InputError& error) {
      EXPECT_FALSE(std::string(error.what()).empty());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, EveryNothing, testing::ValuesIn(kNothings),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(NoPostures, AreNamedInsteadOfAnalysed) {
  for (const auto& [rows, columns] : {std::pair(0, 5), std::pair(5, 0), std::pair(0, 0)}) {
    EXPECT_ANY_THROW(
        static_cast<void>(sampling::principal_components(Eigen::MatrixXd::Zero(rows, columns))))
        << rows << " x " << columns;
    EXPECT_ANY_THROW(static_cast<void>(
        sampling::robust_principal_components(Eigen::MatrixXd::Zero(rows, columns))))
        << rows << " x " << columns;
  }
}

}  // namespace
}  // namespace handway::planning
