#include "features/grasping/grasp_tool.h"

#include "features/editing/editing_test.h"
#include "view3d/scene_view.h"

#include <QAction>
#include <QLabel>
#include <QSignalSpy>
#include <QTreeWidget>

namespace handway::test {
namespace {

class ClickToPlan : public EditingTest {
 protected:
  void grasp(const char* object) {
    select(object);
    part<QAction>("posture").trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !tool<gui::GraspTool>().is_busy(); }, 30000));
  }
};

TEST_F(ClickToPlan, PlansToTheGraspThatIsChosen) {
  open(source_dir() / "scenes" / "can_on_table.yaml");
  const geometric::Configuration before = *scene().goal;
  grasp("can");
  const std::vector<planning::Pregrasp> grasps = tool<gui::GraspTool>().grasps();
  ASSERT_FALSE(grasps.empty());
  auto& list = part<QTreeWidget>("grasp_list");
  EXPECT_EQ(list.topLevelItemCount(), static_cast<int>(grasps.size()));
  EXPECT_EQ(*scene().goal, before) << "only looked at";
  EXPECT_FALSE(window().view().gizmo().is_shown()) << "it would hide the fingers";
  keep_picture("click_to_plan");
  QSignalSpy started(&window().session(), &gui::PlanningSession::started);
  click("grasp_plan");
  EXPECT_EQ(started.count(), 1);
  EXPECT_EQ(*scene().goal, grasps.front().q);
  EXPECT_EQ(editor().undo_stack().undoText(), "Set goal");
  window().session().cancel();
  EXPECT_TRUE(QTest::qWaitFor([&] { return !window().session().is_running(); }, 8000));
}

TEST_F(ClickToPlan, LeavesTheGoalWhenTheListIsClosed) {
  open(source_dir() / "scenes" / "can_on_table.yaml");
  const gui::SceneState before = editor().state();
  grasp("can");
  click("grasp_close");
  EXPECT_EQ(editor().state(), before);
  EXPECT_TRUE(tool<gui::GraspTool>().grasps().empty());
  EXPECT_TRUE(window().view().gizmo().is_shown());
}

TEST_F(ClickToPlan, SaysWhenThereIsNoWay) {
  open(source_dir() / "scenes" / "can_on_table.yaml");
  grasp("table");
  EXPECT_TRUE(tool<gui::GraspTool>().grasps().empty());
  EXPECT_THAT(part<QLabel>("grasp_note").text().toStdString(), ::testing::HasSubstr("too large"));
}

}  // namespace
}  // namespace handway::test
