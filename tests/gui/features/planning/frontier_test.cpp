#include "features/planning/planning_commands.h"
#include "features/planning/roadmap_display.h"
#include "handway/geometric/collision/collision_checker.h"
#include "handway/planning/core/planning_problem.h"
#include "view3d/scene_view.h"
#include "window_test.h"

#include <QLabel>
#include <QPushButton>
#include <QWidget>

namespace handway::test {
namespace {

using ::testing::HasSubstr;

class FrontierOfASearch : public WindowTest {
 protected:
  void fail_to_plan() {
    open(cell().wall());
    window().workbench().plan_settings.apply({"rrt-connect", {{"max_samples", "300"}}});
    plan();
    ASSERT_TRUE(window().player().timeline().empty());
  }
  [[nodiscard]] const planning::SearchReach* shown() const {
    return tool<gui::FrontierDisplay>().shown();
  }
  [[nodiscard]] bool has_legend() const { return part<QWidget>("frontier_legend").isVisible(); }
};

TEST_F(FrontierOfASearch, IsShownWithALegendWhereNoPathIsFound) {
  open(cell().wall());
  EXPECT_FALSE(has_legend());
  fail_to_plan();
  ASSERT_TRUE(shown());
  EXPECT_TRUE(has_legend());
  EXPECT_THAT(part<QLabel>("frontier_from_start").text().toStdString(), HasSubstr("start"));
  EXPECT_THAT(part<QLabel>("frontier_colliding").text().toStdString(), HasSubstr("wall"));
  EXPECT_THAT(result(), HasSubstr("The search came"));
  EXPECT_THAT(result(), HasSubstr("Try "));
}

TEST_F(FrontierOfASearch, IsOfFreeConfigurations) {
  fail_to_plan();
  const planning::PlanningProblem problem =
      planning::make_problem(window().document().scene(), nullptr);
  const auto checker = problem.checker->clone();
  for (const auto& q : {shown()->farthest_from_start, shown()->farthest_from_goal}) {
    EXPECT_FALSE(checker->first_collision(q));
  }
}

TEST_F(FrontierOfASearch, PutsTheRobotThere) {
  fail_to_plan();
  click("frontier_from_start_show");
  EXPECT_EQ(window().document().configuration(), shown()->farthest_from_start);
  click("frontier_from_goal_show");
  EXPECT_EQ(window().document().configuration(), shown()->farthest_from_goal);
}

TEST_F(FrontierOfASearch, ChangesThePictureUntilItIsClosed) {
  open(cell().wall());
  QTest::qWait(300);
  const QImage before = window().view().grab().toImage();
  fail_to_plan();
  QTest::qWait(300);
  EXPECT_NE(window().view().grab().toImage(), before);
  click("frontier_close");
  EXPECT_FALSE(shown());
  EXPECT_FALSE(has_legend());
}

TEST_F(FrontierOfASearch, GoesWithTheNextEdit) {
  fail_to_plan();
  planning::SceneState state = window().document().state();
  auto scene = std::make_shared<geometric::Scene>(*state.scene);
  scene->objects.front().X_PO.translation().x() += 0.5;
  state.scene = scene;
  window().document().set_state(state);
  EXPECT_FALSE(shown());
  EXPECT_FALSE(has_legend());
}

TEST_F(FrontierOfASearch, GoesWithTheNextPath) {
  fail_to_plan();
  open(cell().post());
  EXPECT_FALSE(shown());
  plan();
  EXPECT_FALSE(shown());
  EXPECT_FALSE(has_legend());
}

}  // namespace
}  // namespace handway::test
