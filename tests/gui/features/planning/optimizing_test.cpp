#include "handway/planning/core/objective.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/planners/planner.h"
#include "patience.h"
#include "window_test.h"

#include <QAction>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalSpy>

#include <limits>
#include <map>

namespace handway::test {
namespace {

using ::testing::HasSubstr;

class OptimizingInTheWindow : public WindowTest {
 protected:
  /// A path around the post that there is much to gain for.
  void plan_roughly() {
    open(cell().post());
    window().workbench().plan_settings.apply({"rrt-connect", {{"smoothing_checks", "0"}}});
    plan();
    ASSERT_TRUE(part<QPushButton>("optimize").isVisible());
  }
  void begin(double seconds) {
    part<QDoubleSpinBox>("optimize_limit").setValue(seconds);
    click("optimize");
  }
  [[nodiscard]] bool wait_for_end() const {
    return QTest::qWaitFor([&] { return !window().session().is_running(); }, kPatienceMs);
  }
  [[nodiscard]] planning::PlanningProblem problem() const {
    return planning::make_problem(window().document().scene(), window().document().loaded().basis);
  }
  [[nodiscard]] const planning::Path& path() const { return window().player().timeline().path(); }
  [[nodiscard]] double length() const { return path_quality(problem(), path()).length; }
};

TEST_F(OptimizingInTheWindow, IsOfferedOnceThereIsAPath) {
  open(cell().post());
  EXPECT_FALSE(part<QPushButton>("optimize").isVisible());
  EXPECT_FALSE(part<QAction>("optimize_action").isEnabled());
  plan();
  EXPECT_TRUE(part<QPushButton>("optimize").isVisible());
  EXPECT_TRUE(part<QAction>("optimize_action").isEnabled());
}

TEST_F(OptimizingInTheWindow, IsNotOfferedWhereNoPathWasFound) {
  open(cell().wall());
  window().workbench().plan_settings.apply({"rrt-connect", {{"max_samples", "300"}}});
  plan();
  EXPECT_FALSE(part<QPushButton>("optimize").isVisible());
}

TEST_F(OptimizingInTheWindow, MakesThePathBetterUntilNothingIsToBeGained) {
  plan_roughly();
  part<QComboBox>("objective").setCurrentText("shortest");
  const double before = length();
  int progressed = 0;
  QObject::connect(&window().session(), &gui::PlanningSession::path_optimized,
                   [&] { ++progressed; });
  begin(0.0);
  EXPECT_EQ(part<QPushButton>("cancel").text(), "Stop");
  ASSERT_TRUE(wait_for_end());
  EXPECT_GE(progressed, 2) << "a better path, and the end";
  EXPECT_LT(length(), before);
  EXPECT_THAT(result(), HasSubstr("Converged."));
  EXPECT_THAT(result(), HasSubstr("Clearance"));
  EXPECT_TRUE(planning::check_path(problem(), path(), 1e-3).valid());
  EXPECT_EQ(window().player().made_from(), window().document().revision());
  EXPECT_EQ(part<QPushButton>("cancel").text(), "Cancel");
}

TEST_F(OptimizingInTheWindow, IsAPathOfItsOwnThatTheOneBeforeCanReplace) {
  plan_roughly();
  const auto planned = window().session().shown_run();
  begin(0.0);
  ASSERT_TRUE(wait_for_end());
  const auto optimized = window().session().shown_run();
  ASSERT_TRUE(optimized);
  EXPECT_EQ(optimized->number, planned->number + 1);
  EXPECT_EQ(optimized->result.path.waypoints, path().waypoints);
  EXPECT_GT(optimized->result.optimize_checks, 0U);
  EXPECT_TRUE(QTest::qWaitFor([&] { return window().player().timeline().motion() != nullptr; },
                              kPatienceMs))
      << "it is timed";
}

TEST_F(OptimizingInTheWindow, StopsWithTheBestSoFarAndGoesOnFromThereBitForBit) {
  plan_roughly();
  begin(0.0);
  click("cancel");
  ASSERT_TRUE(wait_for_end());
  begin(0.0);
  ASSERT_TRUE(wait_for_end());
  const auto run = window().session().shown_run();
  const std::map<std::string, std::string> settings(run->planner.settings.begin(),
                                                    run->planner.settings.end());
  ASSERT_EQ(settings.count("optimize_checks"), 1U);
  const auto planner = planning::PlannerRegistry().create(run->planner.name);
  for (const auto& [key, value] : settings) {
    planner->set_parameter(key, value);
  }
  planning::PlanRequest request;
  request.seed = run->request.seed;
  EXPECT_EQ(planner->plan(problem(), request).path.waypoints, path().waypoints)
      << "with optimize_checks = " << settings.at("optimize_checks");
}

TEST_F(OptimizingInTheWindow, EndsWithoutAPathWhenTheSceneIsEdited) {
  plan_roughly();
  const auto before = path().waypoints;
  QSignalSpy ended(&window().session(), &gui::PlanningSession::ended);
  begin(0.0);
  planning::SceneState state = window().document().state();
  auto scene = std::make_shared<geometric::Scene>(*state.scene);
  scene->objects.front().X_PO.translation().x() += 1.0;
  state.scene = scene;
  window().document().set_state(state);
  ASSERT_EQ(ended.count(), 1);
  EXPECT_FALSE(ended.front().front().toBool());
  EXPECT_FALSE(window().session().is_running());
  EXPECT_TRUE(part<QPushButton>("plan").isEnabled());
  EXPECT_FALSE(part<QProgressBar>("progress").isVisible());
}

TEST_F(OptimizingInTheWindow, IsNotOfferedForAPathThatIsOutOfDate) {
  plan_roughly();
  planning::SceneState state = window().document().state();
  auto scene = std::make_shared<geometric::Scene>(*state.scene);
  scene->goal = scene->start;
  scene->objects.front().X_PO.translation() = Eigen::Vector3d(0.3, 0.0, 0.0);  // in the arm
  state.scene = scene;
  window().document().set_state(state);
  EXPECT_FALSE(part<QPushButton>("optimize").isVisible());
  EXPECT_FALSE(part<QAction>("optimize_action").isEnabled());
}

}  // namespace
}  // namespace handway::test
