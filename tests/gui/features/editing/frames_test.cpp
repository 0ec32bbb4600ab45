/// Named frames in the window: they are added, moved, fixed, renamed and removed, and followed.
#include "features/editing/editing_test.h"

#include <QAction>
#include <QComboBox>
#include <QLineEdit>
#include <QTreeWidget>

#include <gmock/gmock.h>

namespace handway::test {
namespace {

class Frames : public EditingTest {
 protected:
  void SetUp() override {
    EditingTest::SetUp();
    if (!IsSkipped()) {
      select("post");
      part<QAction>("add_frame").trigger();
    }
  }
  [[nodiscard]] const geometric::NamedFrame& frame() const { return scene().frames.at(0); }
  [[nodiscard]] Eigen::Vector3d place() const {
    return editor().selected_pose().value().translation();
  }
};

TEST_F(Frames, AreAddedOnTopOfTheSelectedObject) {
  EXPECT_EQ(frame().parent, "post");
  EXPECT_EQ(editor().selected_frame(), &frame());
  const auto box = geometric::bounds(scene(), window().document().configuration(), {"post"});
  EXPECT_NEAR(place().z(), box.upper.z(), 1e-9);
  EXPECT_EQ(part<QLineEdit>("object_name").text(), "frame");
  EXPECT_EQ(part<QComboBox>("frame_parent").currentText(), "post");
  keep_picture("frame_on_post");
}

TEST_F(Frames, MoveWithTheirObject) {
  const Eigen::Vector3d before = place();
  select("post");
  geometric::Pose aside = editor().selected_pose().value();
  aside.translation().x() += 0.1;
  editor().place(aside);
  editor().select(gui::frame_item("frame"));
  EXPECT_TRUE(place().isApprox(before + Eigen::Vector3d(0.1, 0.0, 0.0), 1e-9));
}

TEST_F(Frames, AreMovedFixedRenamedAndRemoved) {
  geometric::Pose X_WF = editor().selected_pose().value();
  X_WF.translation().y() += 0.05;
  editor().place(X_WF);
  EXPECT_TRUE(editor().selected_pose()->isApprox(X_WF, 1e-9));
  auto& parent = part<QComboBox>("frame_parent");
  parent.setCurrentIndex(0);
  emit parent.activated(0);
  EXPECT_EQ(frame().parent, "");
  EXPECT_TRUE(frame().X_PF.isApprox(X_WF, 1e-9)) << "it stays where it is";
  editor().rename("place");
  EXPECT_EQ(frame().name, "place");
  EXPECT_EQ(editor().selected_frame(), &frame());
  editor().remove();
  EXPECT_TRUE(scene().frames.empty());
  EXPECT_EQ(editor().selected_frame(), nullptr);
  for (int edit = 0; edit < 5; ++edit) {
    editor().undo_stack().undo();
  }
  EXPECT_TRUE(scene().frames.empty()) << "there was none at first";
}

TEST_F(Frames, LeadGoalPosesThatNameThem) {
  editor().add_goal_pose();
  geometric::PoseGoal goal = *editor().selected_goal_pose();
  goal.reference = "frame";
  editor().change_goal_pose(goal);
  editor().select(gui::frame_item("frame"));
  geometric::Pose X_WF = editor().selected_pose().value();
  X_WF.translation().z() += 0.1;
  editor().place(X_WF);
  EXPECT_NEAR(scene().goal_poses.at(0).X_WG.translation().z(), goal.X_WG.translation().z() + 0.1,
              1e-9);
}

}  // namespace
}  // namespace handway::test
