/// Constraints along the path: kept by every planner at every configuration, as kinematics of the
/// test's own say.
#include "handway/geometric/math/units.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/queries/nearest_free.h"
#include "handway/planning/replanning/dynamic_roadmap.h"
#include "handway/planning/timing/blended_path.h"
#include "handway/planning/timing/time_path.h"
#include "handway_test/known_problems.h"
#include "handway_test/planar_problems.h"
#include "handway_test/roadmap_scenes.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace handway::planning {
namespace {

using geometric::OrientationConstraint;
using geometric::PathConstraint;
using geometric::PositionConstraint;
using testing::HasSubstr;

constexpr double kMostAngle = 0.45;  // rad

// The flat arm sweeps across a post, with more to keep.
PlanningProblem post_problem_with(const PathConstraint& constraint) {
  const PlanningProblem plain = test::post_problem();
  geometric::Scene scene = *plain.scene;
  scene.constraints.push_back(constraint);
  return test::planar_problem(std::move(scene), plain.start, plain.goal);
}

PathConstraint heading(double angle) {
  return {"heading", "palm",
          OrientationConstraint{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitX(), angle}};
}

// Forward kinematics of the test's own: from the link to the base, joint after joint.
geometric::Pose own_link_pose(const geometric::RobotModel& model, const Configuration& q,
                              const std::string& name) {
  geometric::Pose X_BL = geometric::Pose::Identity();
  for (int link = model.find_link(name).value(); link > 0; link = model.parent(link)) {
    const geometric::Joint& joint = model.joint(link);
    const auto& drive = model.mimic_mapping(link);
    const double value =
        drive.offset + (drive.variable < 0 ? 0.0 : drive.multiplier * q[drive.variable]);
    geometric::Pose motion = geometric::Pose::Identity();
    if (joint.type == geometric::JointType::kRevolute) {
      motion.linear() = Eigen::AngleAxisd(value, joint.axis).toRotationMatrix();
    } else if (joint.type == geometric::JointType::kPrismatic) {
      motion.translation() = value * joint.axis;
    }
    X_BL = joint.X_PJ * motion * X_BL;
  }
  return X_BL;
}

Eigen::Vector3d palm_at(const PlanningProblem& problem, const Configuration& q) {
  return own_link_pose(problem.model(), q, "palm").translation();
}

// Holds start, goal and the arc between them.
PathConstraint strip() {
  const PlanningProblem plain = test::post_problem();
  const Eigen::Vector3d corner = palm_at(plain, plain.goal);
  constexpr double kRoom = 0.03;  // m
  const double near = corner.x() - kRoom;
  const double far = corner.norm() + kRoom;
  return {"strip", "palm",
          PositionConstraint{
              Eigen::Vector3d::Zero(), Eigen::Vector3d(far - near, 2.0 * (corner.y() + kRoom), 0.1),
              geometric::Pose(Eigen::Translation3d(0.5 * (near + far), 0.0, corner.z()))}};
}

// Checks the path at steps of less than 1 mm and 0.1°.
void expect_along(const Path& path, const PlanningProblem& problem,
                  const std::function<bool(const geometric::Pose&)>& holds) {
  constexpr double kStep = 5e-4;  // rad, of all joints together, of a robot that reaches 2 m
  int looks = 0;
  int violations = 0;
  for (std::size_t edge = 0; edge + 1 < path.waypoints.size(); ++edge) {
    const Configuration delta = path.waypoints[edge + 1] - path.waypoints[edge];
    const int steps = static_cast<int>(std::ceil(delta.lpNorm<1>() / kStep));
    for (int i = 0; i <= steps; ++i, ++looks) {
      const Configuration q = path.waypoints[edge] + (static_cast<double>(i) / steps) * delta;
      violations += holds(own_link_pose(problem.model(), q, "palm")) ? 0 : 1;
    }
  }
  EXPECT_EQ(violations, 0) << "of " << looks;
}

class Constraints : public testing::TestWithParam<std::string> {
 protected:
  static PlanResult plan(const PlanningProblem& problem) {
    PlanRequest request;
    request.time_limit_s = 60.0;
    return PlannerRegistry().create(GetParam())->plan(problem, request);
  }
};

TEST_P(Constraints, KeepAnAxisNearADirection) {
  const PlanningProblem problem = post_problem_with(heading(kMostAngle));
  const PlanResult result = plan(problem);
  ASSERT_TRUE(result.solved()) << result.reason;
  expect_along(result.path, problem, [](const geometric::Pose& X_WP) {
    return std::acos(std::min(1.0, X_WP.linear()(0, 0))) <= kMostAngle;
  });
  EXPECT_TRUE(check_path(problem, result.path, 1e-3).valid());
}

TEST_P(Constraints, KeepAPointInARegion) {
  const PathConstraint constraint = strip();
  const auto& region = std::get<PositionConstraint>(constraint.what);
  const PlanningProblem problem = post_problem_with(constraint);
  const PlanResult result = plan(problem);
  ASSERT_TRUE(result.solved()) << result.reason;
  expect_along(result.path, problem, [&](const geometric::Pose& X_WP) {
    const Eigen::Vector3d p = region.X_WR.inverse() * X_WP.translation();
    return (p.cwiseAbs().array() <= 0.5 * region.size.array()).all();
  });
}

INSTANTIATE_TEST_SUITE_P(Planners, Constraints,
                         testing::Values("auto", "rrt-connect", "pmd-rrt-connect", "pmd-prm",
                                         "pmd-lazy", "full-prm"),
                         [](const auto& planner) {
                           std::string name = planner.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(ConstraintRefusals, AnEndOutsideIsNamedWithWhatIsFoundAndAllowed) {
  const PlanResult result =
      PlannerRegistry().create("auto")->plan(post_problem_with(heading(0.25)), {});
  EXPECT_EQ(result.status, PlanStatus::kStartInvalid);
  EXPECT_THAT(result.reason, HasSubstr("violates constraint heading"));
  EXPECT_THAT(result.reason, HasSubstr("22.92° off, at most 14.3239° are allowed"));
}

TEST(ConstraintRefusals, APathThatLeavesARegionIsNotFree) {
  const PlanningProblem plain = test::post_problem();
  geometric::Scene scene = *plain.scene;
  scene.objects.clear();
  scene.constraints.push_back(strip());
  auto& region = std::get<PositionConstraint>(scene.constraints.back().what);
  region.size.x() -= 0.04;  // cuts off the arc's middle
  region.X_WR.translation().x() -= 0.02;
  const PlanningProblem problem = test::planar_problem(scene, plain.start, plain.goal);
  const Path path{{problem.start, problem.goal}};
  const auto conflict = PathConflictSearch(problem).run(path.waypoints);
  ASSERT_TRUE(conflict);
  EXPECT_EQ(conflict->text, "The motion violates constraint strip");
  const PathCheckResult check = check_path(problem, path, 1e-3);
  ASSERT_FALSE(check.valid());
  EXPECT_THAT(check.faults.front(), HasSubstr("Constraint strip is violated after waypoint 1"));
}

TEST(ConstraintRefusals, AConstraintOnWhatIsNotCarriedIsRefused) {
  EXPECT_THROW(post_problem_with({"post", "post", OrientationConstraint{}}), std::exception);
}

bool is_near_heading(const geometric::Pose& X_WP) {
  return std::acos(std::min(1.0, X_WP.linear()(0, 0))) <= kMostAngle;
}

PlanResult plan_by_default(const PlanningProblem& problem, double optimize_s = 0.0) {
  PlanRequest request;
  request.optimize_s = optimize_s;
  PlanResult result = PlannerRegistry().create("auto")->plan(problem, request);
  EXPECT_TRUE(result.solved()) << result.reason;
  return result;
}

TEST(ConstraintsKept, ByWhatOptimisingMakesOfAPath) {
  const PlanningProblem problem = post_problem_with(heading(kMostAngle));
  expect_along(plan_by_default(problem, 0.3).path, problem, is_near_heading);
}

TEST(ConstraintsKept, ByRoundedCorners) {
  const PlanningProblem problem = post_problem_with(heading(kMostAngle));
  const BlendResult blends = certified_blends(problem, plan_by_default(problem).path);
  ASSERT_TRUE(blends.path) << blends.fault;
  EXPECT_GT(blends.arcs, 0);
  for (const PathPiece& piece : blends.path->pieces()) {
    Path samples;
    for (int i = 0; i <= 100; ++i) {
      samples.waypoints.push_back(piece.derivative(0, piece.length * i / 100.0));
    }
    expect_along(samples, problem, is_near_heading);
  }
}

TEST(ConstraintsKept, WhileAnObjectMoves) {
  DynamicRoadmap roadmap(post_problem_with(heading(kMostAngle)));
  for (int step = 0; step < 8; ++step) {
    test::move_object(
        roadmap, "post",
        geometric::Pose(Eigen::Translation3d(0.755, 0.02 * std::sin(1.0 * step), 0.0)));
    const PlanResult result = roadmap.plan({});
    ASSERT_TRUE(result.solved()) << "step " << step << ": " << result.reason;
    expect_along(result.path, roadmap.problem(), is_near_heading);
  }
}

TEST(ConstraintsKept, ByTheNearestFreeConfiguration) {
  const PlanningProblem problem = post_problem_with(heading(0.25));
  const NearestFree nearest = find_nearest_free(problem, problem.start);
  ASSERT_TRUE(nearest.q);
  EXPECT_LE(std::acos(own_link_pose(problem.model(), *nearest.q, "palm").linear()(0, 0)), 0.25);
}

TEST(ConstraintsKept, ByProjectedConfigurations) {
  const PlanningProblem problem = post_problem_with(heading(0.25));
  const auto projected = [&](const Configuration& q) {
    return geometric::project_onto_constraints(
        problem.model(), problem.checker->world().constraints(), problem.joints.arm, q);
  };
  const Configuration inside = test::planar_configuration(0.1, 0.1);
  EXPECT_EQ(projected(inside), inside);
  const auto moved = projected(test::planar_configuration(-1.0, 2.0, 0.3));
  ASSERT_TRUE(moved);
  EXPECT_LE(std::acos(own_link_pose(problem.model(), *moved, "palm").linear()(0, 0)), 0.25);
  EXPECT_EQ((*moved)[2], 0.3) << "the hand may not move";
}

TEST(ConstraintRefusals, AMotionThatWasTimedWithoutThemIsNotCleared) {
  const PlanningProblem plain = test::open_problem();
  const TimedPath timed = time_path(plain, {{plain.start, plain.goal}}, "sweep");
  ASSERT_TRUE(timed.cleared());
  geometric::Scene scene = *plain.scene;
  scene.constraints.push_back(heading(0.35));
  TimingOptions options;
  options.limits = timed.motion.limits;
  const PreflightReport report =
      preflight(test::planar_problem(std::move(scene), plain.start, plain.goal),
                timed.motion.trajectory, options);
  ASSERT_EQ(report.faults.size(), 1U);
  EXPECT_THAT(report.faults.front().text, HasSubstr("The motion violates constraint heading at "));
}

// A can in the hand of the TX90, from one side of a post to the other.
PlanningProblem carried_can(double degrees) {
  const auto known = test::known_problems();
  const auto table = std::ranges::find(known, "can_on_table", &test::KnownProblem::name);
  const SceneState loaded = test::load(*table);
  geometric::Scene scene = *loaded.scene;
  std::erase_if(scene.objects, [](const auto& object) { return object.name == "table"; });
  const geometric::RobotModel& model = *scene.robots.front().model;
  geometric::SceneObject& can = scene.objects.back();
  can.X_PO = own_link_pose(model, *scene.goal, "palm").inverse() *
             scene.robots.front().X_WB.inverse() * can.X_PO;
  can.attachment = geometric::Attachment{scene.robots.front().name, "palm", {}};
  for (const geometric::Link& link : model.description().links) {
    can.attachment->touching.push_back(link.name);
  }
  const auto at = [&](std::initializer_list<double> arm) {
    Configuration q = *scene.goal;
    int joint = 1;
    for (const double value : arm) {
      q[model.find_variable("joint_" + std::to_string(joint++)).value()] = value;
    }
    return q;
  };
  scene.start = at({-0.539586, 0.179620, 1.895421, 1.278401, -0.789985, 0.294071});
  scene.goal = at({0.671624, 0.140165, 1.942064, 1.077793, -0.616349, 0.416985});
  scene.objects.push_back({"post",
                           geometric::Cylinder{0.04, 1.6},
                           geometric::Pose(Eigen::Translation3d(0.75, 0.0, 0.8)),
                           {},
                           {}});
  geometric::OrientationConstraint upright;
  upright.angle = geometric::radians(degrees);
  scene.constraints.push_back({"can upright", "can", upright});
  return make_problem(std::make_shared<const geometric::Scene>(std::move(scene)), loaded.basis);
}

TEST(CarriedUpright, ACanGoesAroundAPost) {
  for (const double degrees : {10.0, 5.0}) {
    const PlanningProblem problem = carried_can(degrees);
    const Eigen::Matrix3d R_PO = problem.scene->objects[1].X_PO.linear();
    for (const char* planner : {"auto", "rrt-connect", "pmd-lazy"}) {
      for (const std::uint64_t seed : {1U, 2U, 3U}) {
        PlanRequest request;
        request.seed = seed;
        const PlanResult result = PlannerRegistry().create(planner)->plan(problem, request);
        ASSERT_TRUE(result.solved()) << planner << ": " << result.reason;
        expect_along(result.path, problem, [&](const geometric::Pose& X_BP) {
          return std::acos(std::min(1.0, (X_BP.linear() * R_PO)(2, 2))) <=
                 geometric::radians(degrees);
        });
      }
    }
  }
}

TEST(CarriedUpright, AnyNumberOfThreadsFindsTheSamePath) {
  const PlanningProblem problem = carried_can(10.0);
  PlanRequest request;
  const Path one = PlannerRegistry().create("auto")->plan(problem, request).path;
  request.threads = 3;
  EXPECT_EQ(PlannerRegistry().create("auto")->plan(problem, request).path.waypoints, one.waypoints);
}

TEST(ConstraintExplanation, CountsViolationsByName) {
  PlanResult result;
  result.status = PlanStatus::kTimeLimit;
  result.statistics.rejections[{"heading", ""}] = 90;
  result.statistics.rejections[{"palm", "post"}] = 10;
  EXPECT_THAT(explain_failure(result),
              testing::Contains(HasSubstr("90 % constraint heading was violated")));
}

}  // namespace
}  // namespace handway::planning
