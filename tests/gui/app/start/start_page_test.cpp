#include "app/start/start_page.h"

#include "features/editing/scene_editing.h"
#include "patience.h"
#include "window_test.h"

#include <QDockWidget>
#include <QFileDialog>
#include <QFrame>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QScrollBar>
#include <QSignalSpy>
#include <QTimer>

#include <algorithm>
#include <utility>

namespace handway::test {
namespace {

class StartingTheWindow : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (!IsSkipped()) {
      QApplication::setActiveWindow(&window());  // there may be no window manager
    }
  }
  void wait_for_scene() {
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return window().document().scene() != nullptr; }, kPatienceMs));
  }
  void run_command(const char* typed) {
    QTest::keyClick(&window(), Qt::Key_P, Qt::ControlModifier | Qt::ShiftModifier);
    auto& field = part<QLineEdit>("palette_field");
    ASSERT_TRUE(field.isVisible());
    QTest::keyClicks(&field, typed);
    QTest::keyClick(&field, Qt::Key_Return);
    EXPECT_FALSE(field.isVisible());
  }
};

TEST_F(StartingTheWindow, OpensAShippedSceneFromItsPicture) {
  ASSERT_TRUE(part<QWidget>("start_page").isVisible());
  click("open can_on_table");
  wait_for_scene();
  EXPECT_EQ(window().document().scene()->name, "Can on a table");
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return !part<QWidget>("start_page").isVisible(); }, kPatienceMs));
}

// An example that was tried out was no example any more.
TEST_F(StartingTheWindow, SavesAShippedSceneUnderANameOfItsOwn) {
  click("open can_on_table");
  wait_for_scene();
  bool asked = false;
  QTimer::singleShot(0, &window(), [&] {
    if (auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget())) {
      asked = true;
      dialog->reject();
    }
  });
  part<QAction>("save").trigger();
  EXPECT_TRUE(asked);
}

TEST_F(StartingTheWindow, ShowsAsManyPicturesBesideEachOtherAsThereIsRoomFor) {
  gui::StartPage page;
  page.show();
  for (const auto& [width, columns] : {std::pair(360, 1), {700, 2}, {1300, 4}, {700, 2}}) {
    page.resize(width, 600);
    QTest::qWait(50);
    EXPECT_EQ(page.horizontalScrollBar()->maximum(), 0) << width;
    const auto cards = page.findChildren<QAbstractButton*>(QRegularExpression("^open "));
    EXPECT_EQ(std::ranges::count(cards, cards.front()->y(), &QWidget::y), columns) << width;
  }
}

TEST_F(StartingTheWindow, HasNoPanelsUntilThereIsAScene) {
  EXPECT_TRUE(part<QDockWidget>("scene").isHidden());
  click("new tx90_sah");
  wait_for_scene();
  EXPECT_TRUE(QTest::qWaitFor([&] { return !part<QDockWidget>("scene").isHidden(); }));
  window().document().close();
  EXPECT_TRUE(part<QDockWidget>("scene").isHidden());
}

TEST_F(StartingTheWindow, PlansAndPlaysTheSceneThatIsTried) {
  click("start_try");
  wait_for_scene();
  EXPECT_TRUE(QTest::qWaitFor([&] { return window().player().is_playing(); }, 20000));
}

TEST_F(StartingTheWindow, BeginsANewSceneWithARobotOfTheLibrary) {
  click("new tx90_sah");
  wait_for_scene();
  EXPECT_TRUE(window().document().file().empty());
  EXPECT_LE(window().document().scene()->objects.size(), 1U) << "what the robot stands on";
  EXPECT_TRUE(window().document().loaded().basis) << "fits the hand";
  EXPECT_FALSE(part<QPushButton>("plan").isEnabled()) << "no start and goal yet";
  run_command("set start");
  run_command("set goal");
  EXPECT_TRUE(window().document().scene()->start);
  EXPECT_TRUE(part<QPushButton>("plan").isEnabled());
  run_command("add box");
  EXPECT_TRUE(geometric::find_object(*window().document().scene(), "box"));
  run_command("undo");
  EXPECT_LE(window().document().scene()->objects.size(), 1U) << "what the robot stands on";
  window().editor().undo_stack().setClean();
}

TEST_F(StartingTheWindow, MountsTheChosenHandOnTheChosenArm) {
  click("start_new");
  EXPECT_TRUE(part<QAbstractButton>("choose no hand").isChecked());
  click("choose ur5e_class");
  click("choose leap_class_right");
  EXPECT_EQ(part<QLabel>("new_scene_note").text(),
            "leap_class_right is mounted on the end of ur5e_class.");
  click("new_scene_create");
  wait_for_scene();
  const geometric::Scene& scene = *window().document().scene();
  ASSERT_EQ(scene.robots.size(), 1U);
  ASSERT_EQ(scene.robots.front().parts.size(), 2U);
  EXPECT_EQ(scene.robots.front().parts[1].file, "leap_class_right");
  EXPECT_TRUE(window().document().loaded().basis) << "fits the hand";
}

TEST_F(StartingTheWindow, ChoosesNoHandForARobotThatHasOne) {
  click("start_new");
  click("choose leap_class_right");
  click("choose tx90_sah");
  EXPECT_FALSE(part<QWidget>("choose leap_class_right").isEnabled());
  click("new_scene_create");
  wait_for_scene();
  EXPECT_TRUE(window().document().scene()->robots.front().parts.empty());
}

TEST_F(StartingTheWindow, BeginsTheNextSceneWithTheRobotsOfThisOne) {
  window().workbench().create("ur5e_class", "leap_class_right");
  wait_for_scene();
  part<QAction>("new_scene").trigger();
  EXPECT_TRUE(part<QAbstractButton>("choose ur5e_class").isChecked());
  EXPECT_TRUE(part<QAbstractButton>("choose leap_class_right").isChecked());
  click("choose no arm");
  click("new_scene_create");
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return window().document().robot()->name == "leap_class_right"; }, kPatienceMs));
  EXPECT_TRUE(window().document().scene()->robots.front().parts.empty());
}

TEST_F(StartingTheWindow, HelpsWithTheViewOnF1) {
  open(cell().post());
  QTest::keyClick(&window(), Qt::Key_F1);
  EXPECT_TRUE(QTest::qWaitFor([&] { return window().findChild<QFrame*>("help_card"); }));
}

}  // namespace
}  // namespace handway::test
