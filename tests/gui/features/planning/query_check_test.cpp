#include "features/planning/query_check.h"

#include "features/editing/editing_test.h"

#include <QPushButton>

namespace handway::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class GoalDoctor : public EditingTest {
 protected:
  void wait_for_diagnosis() {
    ASSERT_TRUE(QTest::qWaitFor([&] { return !tool<gui::QueryCheck>().is_busy(); }, 8000));
  }
  [[nodiscard]] std::string said() const {
    return tool<gui::QueryCheck>().card().text().toStdString();
  }
};

TEST_F(GoalDoctor, SaysNothingWhereAllIsWell) {
  wait_for_diagnosis();
  EXPECT_EQ(said(), "");
}

TEST_F(GoalDoctor, ExplainsAGoalInCollisionAndMovesItOut) {
  open(cell().goal_in_wall());
  wait_for_diagnosis();
  EXPECT_THAT(said(), AllOf(HasSubstr("Goal in collision"), HasSubstr("<b>wall</b>"),
                            HasSubstr("mm deep, at ("), HasSubstr("Nearest free posture: ")));
  const geometric::Configuration before = *scene().goal;
  click("doctor_show");
  const geometric::Configuration shown = window().document().configuration();
  EXPECT_NE(shown, before);
  click("doctor_use");
  EXPECT_EQ(*scene().goal, shown);
  EXPECT_EQ(editor().undo_stack().undoText(), "Set goal");
  wait_for_diagnosis();
  EXPECT_EQ(said(), "");
  actions().undo->trigger();
  wait_for_diagnosis();
  EXPECT_EQ(*scene().goal, before);
  EXPECT_THAT(said(), HasSubstr("Goal in collision"));
}

TEST_F(GoalDoctor, NamesJointsBeyondTheirLimits) {
  geometric::Configuration q = *scene().start;
  q[0] = 1.9;
  editor().set_start(q);
  wait_for_diagnosis();
  EXPECT_THAT(said(), AllOf(HasSubstr("Start not valid"),
                            HasSubstr("Out of limits: <b>shoulder</b>"), HasSubstr("5.7°")));
}

// The card stood before what it spoke of.
TEST_F(GoalDoctor, LeavesInSightWhatCollides) {
  open(cell().goal_in_wall());
  wait_for_diagnosis();
  const gui::DoctorCard& card = tool<gui::QueryCheck>().card();
  const gui::OrbitCamera::Placement usual = window().view().camera().placement();
  ASSERT_FALSE(card.isHidden());
  for (const double shift : {-0.25, 0.25}) {  // of what is in the middle, in heights of the view
    gui::OrbitCamera::Placement placement = usual;
    placement.target.z() += shift * placement.distance;
    window().view().set_camera(placement);
    editor().set_goal(*scene().goal + Eigen::Vector4d(0.001 * shift, 0.0, 0.0, 0.0));
    wait_for_diagnosis();
    ASSERT_FALSE(card.isHidden());
    const bool at_head = card.geometry().center().y() < window().view().height() / 2;
    EXPECT_EQ(at_head, shift > 0.0) << shift;
  }
}

TEST_F(GoalDoctor, OffersToMakeACellAroundTheRobotHollow) {
  geometric::Scene closed = scene();
  geometric::SceneObject cell;
  cell.name = "cell";
  cell.shape = geometric::Box{{3.0, 3.0, 3.0}};
  closed.objects.push_back(cell);
  window().document().set_state(
      {std::make_shared<const geometric::Scene>(closed), window().document().loaded().basis});
  wait_for_diagnosis();
  EXPECT_THAT(said(), AllOf(HasSubstr("inside of <b>cell</b>"), HasSubstr("hollow")));
  click("doctor_mend");
  EXPECT_FALSE(object("cell").solid);
  EXPECT_EQ(editor().undo_stack().undoText(), "Make cell hollow");
  wait_for_diagnosis();
  EXPECT_EQ(said(), "");
}

TEST_F(GoalDoctor, OffersToLetAnAttachedObjectTouchTheRobot) {
  geometric::Scene held = scene();
  geometric::SceneObject cup;
  cup.name = "cup";
  cup.shape = geometric::Box{{0.2, 0.02, 0.02}};  // about the elbow, into the upper arm
  cup.attachment = geometric::Attachment{held.robots.front().name, "lower", {}};
  held.objects.push_back(cup);
  window().document().set_state(
      {std::make_shared<const geometric::Scene>(held), window().document().loaded().basis});
  wait_for_diagnosis();
  EXPECT_THAT(said(), AllOf(HasSubstr("<b>cup</b> is attached"), HasSubstr("<b>upper</b>")));
  click("doctor_mend");
  EXPECT_THAT(object("cup").attachment->touching, ::testing::Contains("upper"));
  EXPECT_THAT(editor().undo_stack().undoText().toStdString(), HasSubstr("Let cup touch"));
}

TEST_F(GoalDoctor, OffersNoSuchThingForAWallInTheWay) {
  open(cell().goal_in_wall());
  wait_for_diagnosis();
  EXPECT_FALSE(part<QPushButton>("doctor_mend").isVisible());
}

TEST_F(GoalDoctor, LeavesOutAnEndThatIsNotThere) {
  geometric::Scene bare = scene();
  bare.goal.reset();
  bare.start.reset();
  window().document().set_state({std::make_shared<const geometric::Scene>(bare)});
  wait_for_diagnosis();
  EXPECT_EQ(said(), "");
}

}  // namespace
}  // namespace handway::test
