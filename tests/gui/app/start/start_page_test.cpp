#include "app/start/start_page.h"

#include "features/editing/scene_editing.h"
#include "patience.h"
#include "window_test.h"

#include <QFrame>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>

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
  EXPECT_FALSE(part<QWidget>("start_page").isVisible());
}

TEST_F(StartingTheWindow, BeginsANewSceneWithARobotOfTheLibrary) {
  click("new tx90_sah");
  wait_for_scene();
  EXPECT_TRUE(window().document().file().empty());
  EXPECT_TRUE(window().document().scene()->objects.empty());
  EXPECT_TRUE(window().document().loaded().basis) << "fits the hand";
  EXPECT_FALSE(part<QPushButton>("plan").isEnabled()) << "no start and goal yet";
  run_command("set start");
  run_command("set goal");
  EXPECT_TRUE(window().document().scene()->start);
  EXPECT_TRUE(part<QPushButton>("plan").isEnabled());
  run_command("add box");
  EXPECT_TRUE(geometric::find_object(*window().document().scene(), "box"));
  run_command("undo");
  EXPECT_TRUE(window().document().scene()->objects.empty());
  window().editor().undo_stack().setClean();
}

TEST_F(StartingTheWindow, HelpsWithTheViewOnF1) {
  open(cell().post());
  QTest::keyClick(&window(), Qt::Key_F1);
  EXPECT_TRUE(QTest::qWaitFor([&] { return window().findChild<QFrame*>("help_card"); }));
}

}  // namespace
}  // namespace handway::test
