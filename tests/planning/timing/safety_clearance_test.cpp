#include "handway/planning/paths/safety_clearance.h"

#include "handway/geometric/collision/collision_checker.h"
#include "handway/planning/timing/time_path.h"
#include "handway_test/planar_problems.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace handway::planning {
namespace {

using test::planar_configuration;
using testing::HasSubstr;
using testing::Not;

PlanningProblem sweep_past_post_at(double x) {
  geometric::Scene scene = test::scene_of(test::planar_hand_arm());
  test::add_object(scene, "post", geometric::Cylinder{0.01, 0.3}, Eigen::Vector3d(x, 0.0, 0.0));
  return test::planar_problem(std::move(scene), planar_configuration(-0.6, 0.0),
                              planar_configuration(0.6, 0.0));
}

struct Nearest {
  double shoulder = 0.0;  ///< rad
  double gap = 10.0;      ///< m
};

/// Returns the place where the sweep is nearest to the post.
Nearest nearest_to_post(const PlanningProblem& problem) {
  const auto checker = problem.checker->clone();
  Nearest nearest;
  for (int step = -600; step <= 600; ++step) {
    const double shoulder = 1e-3 * step;
    checker->place(planar_configuration(shoulder, 0.0));
    for (std::size_t p = 0; p < checker->world().pairs().size(); ++p) {
      const int pair = static_cast<int>(p);
      const auto named = geometric::named_pair(checker->world(), pair, 0.0);
      if (named.a == "post" || named.b == "post") {
        const double gap = checker->pair_distance(pair, nearest.gap);
        nearest = gap < nearest.gap ? Nearest{shoulder, gap} : nearest;
      }
    }
  }
  return nearest;
}

/// The stretched arm sweeps past a post, that it misses by `clearance` (m).
PlanningProblem sweep_past_post(double clearance) {
  double x = 1.0;
  for (int round = 0; round < 4; ++round) {
    x += clearance - nearest_to_post(sweep_past_post_at(x)).gap;
  }
  return sweep_past_post_at(x);
}

PreflightReport preflight_at(double clearance, double speed = 1.0,
                             const SafetyMargin& safety = {}) {
  const PlanningProblem problem = sweep_past_post(clearance);
  TimingOptions options;
  options.speed = speed;
  options.safety = safety;
  const TimedPath timed = time_path(problem, {{problem.start, problem.goal}}, "sweep", options);
  EXPECT_TRUE(timed.cleared()) << timed.blends.fault;
  return timed.preflight;
}

TEST(SafetyClearance, IsTooLittleWhereARobotThatIsOffByItsFollowingErrorTouches) {
  const PreflightReport report = preflight_at(0.2e-3, 0.1);
  ASSERT_TRUE(report.cleared());
  ASSERT_TRUE(report.is_tight());
  const ClearanceShortfall& place = *report.shortfall;
  EXPECT_TRUE(place.a == "post" || place.b == "post");
  EXPECT_NEAR(place.clearance, 2e-4, 5e-5);
  EXPECT_NEAR(place.place, 0.5 * report.duration, 0.2 * report.duration);
  EXPECT_GT(place.needed(), 5e-4);
  EXPECT_TRUE(report.is_under_way());
  const std::string text = to_text(report);
  EXPECT_THAT(text, HasSubstr("cleared, but too close"));
  EXPECT_THAT(text, HasSubstr("post"));
  EXPECT_THAT(text, HasSubstr("margin"));
  const auto json = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(json["verdict"], "tight");
  EXPECT_EQ(json["cleared"], true);
  EXPECT_GT(json["shortfall"]["needed_mm"], json["shortfall"]["clearance_mm"]);
}

TEST(SafetyClearance, IsEnoughFarFromEverything) {
  const PreflightReport report = preflight_at(0.06);
  EXPECT_TRUE(report.cleared());
  EXPECT_FALSE(report.is_tight()) << to_text(report);
  EXPECT_THAT(to_text(report), Not(HasSubstr("too close")));
  EXPECT_EQ(nlohmann::json::parse(to_json(report))["verdict"], "cleared");
}

TEST(SafetyClearance, CountsWhatAFastRobotMissesByMore) {
  EXPECT_TRUE(preflight_at(0.005, 1.0).is_tight());
  EXPECT_FALSE(preflight_at(0.005, 0.1).is_tight());
}

TEST(SafetyClearance, CountsWhatWasMeasured) {
  SafetyMargin exact;
  exact.following_error = Eigen::VectorXd::Zero(planar_configuration(0, 0).size());
  EXPECT_FALSE(preflight_at(0.005, 1.0, exact).is_tight());
  SafetyMargin loose = exact;
  loose.following_error.setConstant(0.1);
  EXPECT_TRUE(preflight_at(0.03, 1.0, loose).is_tight());
}

TEST(SafetyClearance, KeepsTheMarginThatIsChosen) {
  SafetyMargin safety;
  safety.margin = 0.01;
  const PreflightReport report = preflight_at(0.005, 0.1, safety);
  ASSERT_TRUE(report.is_tight());
  EXPECT_NEAR(report.shortfall->margin, 0.01, 1e-12);
  EXPECT_GE(report.shortfall->suggested_margin(), 0.01);
}

TEST(SafetyClearance, SaysThatAnEndIsTooNearWherePlanningCanNotHelp) {
  const PlanningProblem problem = sweep_past_post(0.2e-3);
  const double shoulder = nearest_to_post(problem).shoulder;
  const Path path = {{problem.start, planar_configuration(shoulder, 0.0)}};
  TimingOptions options;
  options.speed = 0.05;
  const TimedPath timed = time_path(problem, path, "up_to", options);
  ASSERT_TRUE(timed.cleared()) << timed.blends.fault;
  const PreflightReport& report = timed.preflight;
  ASSERT_TRUE(report.is_tight());
  EXPECT_FALSE(report.is_under_way());
  EXPECT_THAT(report.advice(), HasSubstr("goal itself"));
}

TEST(SafetyClearance, IsLookedAtOnPathsWithoutTimes) {
  const PlanningProblem near = sweep_past_post(0.08e-3);
  const auto shortfall = path_shortfall(near, {{near.start, near.goal}}, 0.0);
  ASSERT_TRUE(shortfall);
  EXPECT_THAT(to_string(*shortfall), HasSubstr("post"));
  const PlanningProblem far = sweep_past_post(0.005);
  EXPECT_FALSE(path_shortfall(far, {{far.start, far.goal}}, 0.0));
  EXPECT_TRUE(path_shortfall(far, {{far.start, far.goal}}, 0.01));
}

TEST(SafetyClearance, HasNothingToSayWhereThereIsNothing) {
  const PlanningProblem problem =
      test::planar_problem(test::scene_of(test::planar_hand_arm()), planar_configuration(0, 0),
                           planar_configuration(0.1, 0));
  EXPECT_FALSE(path_shortfall(problem, {}, 0.01));
}

}  // namespace
}  // namespace handway::planning
