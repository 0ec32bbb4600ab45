/// Tests the choice of the joints that move in the Plan panel.
#include "handway/geometric/setup/moving_group.h"

#include "features/editing/editing_test.h"

#include <QAction>
#include <QMenu>
#include <QPushButton>

namespace handway::test {
namespace {

class MovingGroup : public EditingTest {
 protected:
  [[nodiscard]] QPushButton& button() const { return part<QPushButton>("moving_group"); }
  void choose(const char* name) const {
    emit button().menu()->aboutToShow();
    for (QMenu* menu : {button().menu(), button().menu()->findChild<QMenu*>()}) {
      for (QAction* action : menu->actions()) {
        if (action->text() == QLatin1String(name)) {
          action->trigger();
          return;
        }
      }
    }
    FAIL() << "no choice " << name;
  }
};

TEST_F(MovingGroup, IsChosenAndUndone) {
  EXPECT_EQ(button().text(), "All joints");
  choose("arm");
  EXPECT_EQ(scene().group, std::vector<std::string>{"arm"});
  EXPECT_EQ(button().text(), "arm");
  EXPECT_EQ(window().document().joints().arm.size(), geometric::moving_variables(scene()).size());
  EXPECT_TRUE(window().document().joints().hand.empty());
  choose("arm");
  EXPECT_TRUE(scene().group.empty()) << "the last one taken away: all";
  editor().undo_stack().undo();
  editor().undo_stack().undo();
  EXPECT_TRUE(scene().group.empty());
  EXPECT_EQ(button().text(), "All joints");
  EXPECT_FALSE(window().document().joints().hand.empty());
}

TEST_F(MovingGroup, KeepsTheGoalOfWhatDoesNotMoveAtTheStart) {
  choose("arm");
  geometric::Configuration q = *scene().start;
  q.array() += 0.05;
  editor().set_goal(q);
  const std::vector<int> hand = *scene().robots.front().model->find_group("hand");
  EXPECT_EQ((*scene().goal)(hand), (*scene().start)(hand));
  EXPECT_EQ((*scene().goal)[0], q[0]);
}

}  // namespace
}  // namespace handway::test
