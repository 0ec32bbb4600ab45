#include "handway/planning/timing/time_path.h"
#include "handway_test/input_errors.h"
#include "handway_test/planar_problems.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace handway::planning {
namespace {

using test::planar_configuration;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class Preflight : public testing::Test {
 protected:
  Preflight()
      : timed_(time_path(problem_,
                         {{problem_.start, planar_configuration(0.2, 0.3, 0.1), problem_.goal}},
                         "wave")) {
    options_.limits = timed_.motion.limits;
  }

  [[nodiscard]] PreflightReport run(const Trajectory& trajectory) const {
    return preflight(problem_, trajectory, options_);
  }

  PlanningProblem problem_ = test::open_problem();
  TimedPath timed_;
  TimingOptions options_;
};

TEST_F(Preflight, ClearsWhatTimePathMakes) {
  ASSERT_TRUE(timed_.cleared()) << to_text(timed_.preflight);
  EXPECT_GT(timed_.preflight.velocity.share + timed_.preflight.acceleration.share, 0.95);
  EXPECT_LE(timed_.preflight.acceleration.share, 1.001);
  EXPECT_GE(timed_.preflight.duration, timed_.least_duration);
  EXPECT_THAT(timed_.motion.waypoint_times, SizeIs(3));
  EXPECT_EQ(timed_.motion.waypoint_times.back(), timed_.preflight.duration);
}

TEST_F(Preflight, RunsAtTheSpeedAsked) {
  TimingOptions options;
  options.speed = 0.5;
  options.blends.deviation = 0.0;
  const Path path = {{problem_.start, problem_.goal}};
  const double slow = time_path(problem_, path, "a", options).preflight.duration;
  options.speed = 1.0;
  const double fast = time_path(problem_, path, "a", options).preflight.duration;
  EXPECT_NEAR(slow, 2.0 * fast, 0.0081) << "but for whole periods";
}

TEST_F(Preflight, NamesTheJointThatIsNotWhereTheMotionBegins) {
  options_.measured_start = problem_.start;
  EXPECT_TRUE(run(timed_.motion.trajectory).cleared());
  options_.measured_start = planar_configuration(-0.5, 0.35, 0.1);
  const PreflightReport report = run(timed_.motion.trajectory);
  ASSERT_THAT(report.faults, SizeIs(1));
  EXPECT_EQ(report.faults[0].joint, "elbow");
  EXPECT_EQ(report.faults[0].value, 0.35);
  EXPECT_THAT(report.faults[0].text, HasSubstr("0.05"));
  options_.measured_start = Eigen::Vector2d(0, 0);
  EXPECT_FALSE(run(timed_.motion.trajectory).cleared());
}

TEST_F(Preflight, NamesWhatCollidesAndWhen) {
  const PlanningProblem post = test::post_problem();
  // A motion that was timed in a world without the post.
  const TimedPath through = time_path(problem_, {{post.start, post.goal}}, "sweep");
  ASSERT_TRUE(through.cleared());
  const PreflightReport report = preflight(post, through.motion.trajectory, options_);
  ASSERT_THAT(report.faults, SizeIs(1));
  EXPECT_THAT(report.faults[0].text, HasSubstr("post"));
  EXPECT_GT(report.faults[0].time, 0.0);
  EXPECT_LT(report.faults[0].time, through.preflight.duration);
}

TEST_F(Preflight, ReportsASentenceForEveryFaultOfAJoint) {
  Trajectory broken = timed_.motion.trajectory;
  broken.points[10].velocity[0] = 5.0;
  broken.points[20].velocity[0] = 6.0;
  broken.points[12].acceleration[1] = -50.0;
  const PreflightReport report = run(broken);
  EXPECT_THAT(to_text(report), AllOf(HasSubstr("Joint shoulder at 0.0400 s: velocity 5.0000"),
                                     HasSubstr("elbow"), HasSubstr("NOT CLEARED")));
}

TEST_F(Preflight, IsWrittenAsJson) {
  const auto good = nlohmann::json::parse(to_json(timed_.preflight));
  EXPECT_EQ(good["cleared"], true);
  EXPECT_THAT(good["faults"], IsEmpty());
  EXPECT_EQ(good["points"], timed_.motion.trajectory.points.size());
  EXPECT_GT(good["velocity"]["share"], 0.0);
  Trajectory broken = timed_.motion.trajectory;
  broken.points[3].position[1] = std::numeric_limits<double>::quiet_NaN();
  const auto bad = nlohmann::json::parse(to_json(run(broken)));
  EXPECT_EQ(bad["cleared"], false);
  EXPECT_EQ(bad["faults"][0]["joint"], "elbow");
  EXPECT_EQ(bad["faults"][0]["time_s"], 0.012);
  EXPECT_TRUE(bad["faults"][0]["value"].is_null());
}

TEST(TimePath, SaysWhichPathIsNotFree) {
  const PlanningProblem problem = test::post_problem();
  const TimedPath timed = time_path(problem, {{problem.start, problem.goal}}, "sweep");
  EXPECT_FALSE(timed.cleared());
  EXPECT_THAT(timed.blends.fault, HasSubstr("post"));
  EXPECT_TRUE(timed.motion.trajectory.empty());
}

TEST(TimePath, KeepsJerkInItsLimitsIfAsked) {
  const PlanningProblem problem = test::open_problem();
  const Path path = {{problem.start, test::planar_configuration(0.2, 0.3, 0.1), problem.goal}};
  TimingOptions options;
  const TimedPath fast = time_path(problem, path, "fast", options);
  EXPECT_EQ(fast.motion.limits.jerk.size(), 0);
  options.limit_jerk = true;
  const TimedPath smooth = time_path(problem, path, "smooth", options);
  ASSERT_TRUE(smooth.cleared()) << to_text(smooth.preflight);
  EXPECT_GT(smooth.preflight.duration, fast.preflight.duration);
  EXPECT_LT(smooth.preflight.duration, 3.0 * fast.preflight.duration);
  EXPECT_EQ(smooth.blends.arcs, 1);
  EXPECT_THAT(check_trajectory(problem.model(), fast.motion.trajectory, smooth.motion.limits),
              testing::Contains(testing::Field(&TrajectoryFault::text, HasSubstr("jerk"))))
      << "the fast motion's accelerations jump";
}

TEST(TimePath, RefusesOptionsOutOfTheirRanges) {
  const PlanningProblem problem = test::open_problem();
  const Path path = {{problem.start, problem.goal}};
  const auto refusal = [&](const TimingOptions& options) {
    return test::refusal_of([&] { static_cast<void>(time_path(problem, path, "a", options)); });
  };
  TimingOptions options;
  options.speed = 1.5;
  EXPECT_THAT(refusal(options), AllOf(HasSubstr("speed"), HasSubstr("1.5")));
  options = {};
  options.period = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(options), HasSubstr("period"));
  options = {};
  options.blends.deviation = -0.1;
  EXPECT_THAT(refusal(options), HasSubstr("deviation"));
}

TEST(MotionName, IsOneThatProgramsTake) {
  EXPECT_EQ(motion_name("can_on_table"), "can_on_table");
  EXPECT_EQ(motion_name("my path-2"), "my_path_2");
  EXPECT_EQ(motion_name("2nd"), "path_2nd");
  EXPECT_EQ(motion_name(""), "path_");
}

}  // namespace
}  // namespace handway::planning
