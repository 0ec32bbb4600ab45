#include "features/editing/editing_test.h"
#include "features/planning/collision_display.h"

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
  EXPECT_THAT(said(), AllOf(HasSubstr("goal can't be planned to"), HasSubstr("<b>wall</b>"),
                            HasSubstr("mm deep, at ("), HasSubstr("A free one is ")));
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
  EXPECT_THAT(said(), HasSubstr("goal can't be planned to"));
}

TEST_F(GoalDoctor, NamesJointsBeyondTheirLimits) {
  geometric::Configuration q = *scene().start;
  q[0] = 1.9;
  editor().set_start(q);
  wait_for_diagnosis();
  EXPECT_THAT(said(), AllOf(HasSubstr("start can't be planned from"),
                            HasSubstr("Beyond its limits: <b>shoulder</b>"), HasSubstr("5.7°")));
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
