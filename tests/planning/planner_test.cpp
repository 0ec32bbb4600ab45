/// Tests the checks of Planner::plan() that hold for any planner: no search if there is no path,
/// and no path that leads elsewhere.
#include "handway/planning/planners/planner.h"

#include "handway/geometric/scene/scene.h"
#include "handway/planning/core/plan_result.h"
#include "handway_test/solid_robots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace handway::planning {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A ball of 20 mm that slides from x = -0.5 m to 0.5 m, past what `objects` adds.
PlanningProblem ball(const std::function<void(geometric::Scene&)>& add_objects) {
  geometric::Scene scene = test::scene_of(test::gantry(geometric::Sphere{0.02}));
  scene.start = Eigen::Vector3d(-0.5, 0.0, 0.0);
  scene.goal = Eigen::Vector3d(0.5, 0.0, 0.0);
  add_objects(scene);
  return make_problem(std::make_shared<const geometric::Scene>(std::move(scene)), nullptr);
}

void add_cage(geometric::Scene& scene, const geometric::Shape& shape, double x) {
  test::add_object(scene, "cage", shape, Eigen::Vector3d(x, 0.0, 0.0));
  scene.objects.back().solid = false;
}

PlanResult plan(const PlanningProblem& problem, const std::string& planner) {
  PlanRequest request;
  request.time_limit_s = 20.0;
  return PlannerRegistry().create(planner)->plan(problem, request);
}

class EveryPlanner : public testing::TestWithParam<std::string> {};

TEST_P(EveryPlanner, KnowsThatNothingComesOutOfAClosedCage) {
  const geometric::Shape box = geometric::Box{{0.4, 0.4, 0.4}};
  for (const geometric::Shape& shape : {box, geometric::Shape(test::as_mesh(box))}) {
    for (const double x : {0.5, -0.5}) {
      const PlanResult result =
          plan(ball([&](geometric::Scene& scene) { add_cage(scene, shape, x); }), GetParam());
      EXPECT_EQ(result.status, PlanStatus::kInfeasible);
      EXPECT_EQ(result.statistics.samples, 0U);
      EXPECT_THAT(result.reason, AllOf(HasSubstr("probe is inside of cage"),
                                       HasSubstr(x > 0.0 ? "at the goal" : "at the start")));
      EXPECT_THAT(explain_failure(result), testing::ElementsAre(HasSubstr("opening")));
    }
  }
}

TEST_P(EveryPlanner, GoesAroundACageThatIsEmptyAndThroughOneThatIsAroundAll) {
  const auto cage = [&](double size) {
    return plan(ball([&](geometric::Scene& scene) {
                  add_cage(scene, geometric::Box{{size, size, size}}, 0.0);
                }),
                GetParam());
  };
  EXPECT_TRUE(cage(0.2).solved());
  EXPECT_TRUE(cage(3.0).solved());
}

INSTANTIATE_TEST_SUITE_P(OfPlanners, EveryPlanner, testing::Values("auto", "rrt-connect"),
                         [](const auto& test) {
                           return std::string(test.param == "auto" ? "Auto" : "RrtConnect");
                         });

/// Planner that reports a path it has not found.
class Liar final : public Planner {
 public:
  explicit Liar(std::vector<Configuration> waypoints) : waypoints_(std::move(waypoints)) {}
  [[nodiscard]] std::string name() const override { return "liar"; }
  [[nodiscard]] std::string description() const override { return "Leads elsewhere."; }
  [[nodiscard]] PlannerCapabilities capabilities() const override { return {}; }

 private:
  void do_plan(PlanningContext& /*context*/, PlanResult& result) override {
    result.status = PlanStatus::kSolved;
    result.path.waypoints = waypoints_;
  }
  [[nodiscard]] std::vector<geometric::BoundParameter> own_parameters() override { return {}; }

  std::vector<Configuration> waypoints_;
};

TEST(Planner, RefusesAPathThatDoesNotLeadFromTheStartToTheGoal) {
  const PlanningProblem problem = ball([](geometric::Scene& /*scene*/) {});
  const Configuration between = 0.5 * (problem.start + problem.goal);
  for (const std::vector<Configuration>& path : {std::vector<Configuration>{},
                                                 {problem.start},
                                                 {problem.start, between},
                                                 {between, problem.goal},
                                                 {problem.goal, problem.start}}) {
    EXPECT_THROW(static_cast<void>(Liar(path).plan(problem, {})), std::logic_error);
  }
  EXPECT_TRUE(Liar({problem.start, problem.goal}).plan(problem, {}).solved());
}

TEST(PlanStatistics, NamesItsSamples) {
  PlanStatistics statistics;
  EXPECT_EQ(statistics.samples_text(), "0 samples");
  statistics.samples = 1;
  EXPECT_EQ(statistics.samples_text(), "1 sample");
}

}  // namespace
}  // namespace handway::planning
