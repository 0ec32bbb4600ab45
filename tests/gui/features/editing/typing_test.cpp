#include "features/devices/devices_panel.h"
#include "patience.h"
#include "widgets/forms/typed_input.h"
#include "window_test.h"

#include <QAbstractSpinBox>
#include <QDockWidget>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QTabWidget>

#include <cmath>

namespace handway::test {
namespace {

using Kind = gui::SceneItem::Kind;

/// Types into the fields of all panels while the robot moves.
class TypingWhileTheRobotMoves : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (!IsSkipped()) {
      window().resize(1400, 1000);
      open(cell().post());
      QApplication::setActiveWindow(&window());
    }
  }
  void play() {
    plan();
    gui::PathPlayer& player = window().player();
    QObject::connect(&player, &gui::PathPlayer::moved, &player, [this] { ++frames_; });
    player.set_loop(true);
    player.set_speed(0.25);
    player.play();
    wait_for_frames(3);
  }
  void wait_for_frames(int count) {
    const int before = frames_;
    ASSERT_TRUE(QTest::qWaitFor([&] { return frames_ >= before + count; }, kPatienceMs));
  }
  [[nodiscard]] gui::SceneEditor& editor() const { return window().workbench().editor; }

  /// A person's pace: the robot moves between the keys.
  void type_slowly(QWidget& field, const QString& text) {
    field.setFocus();
    QTest::keyClick(&field, Qt::Key_A, Qt::ControlModifier);
    for (const QChar key : text) {
      QTest::keyClick(&field, key.toLatin1());
      wait_for_frames(2);
    }
  }
  /// Types into every number field and name of the panel that can be changed, and takes it back.
  /// @returns how many fields there were.
  int type_into_all(QWidget& panel) {
    int count = 0;
    QList<QWidget*> fields;
    for (auto* field : panel.findChildren<QAbstractSpinBox*>()) {
      fields << field;
    }
    for (auto* field : panel.findChildren<QLineEdit*>()) {
      if (!qobject_cast<QAbstractSpinBox*>(field->parentWidget())) {
        fields << field;
      }
    }
    for (QWidget* field : fields) {
      const QVariant read_only = field->property("readOnly");
      if (!field->isVisible() || !field->isEnabled() || read_only.toBool()) {
        continue;
      }
      type_slowly(*field, QStringLiteral("0.5"));
      const bool is_number = qobject_cast<QAbstractSpinBox*>(field) != nullptr;
      const QString shown = field->property(is_number ? "cleanText" : "text").toString();
      EXPECT_EQ(shown, "0.5") << panel.objectName().toStdString() << ": "
                              << field->objectName().toStdString();
      gui::forget_typed(*field);
      if (!is_number) {
        field->setProperty("text", QString());
      }
      ++count;
    }
    return count;
  }

  int frames_ = 0;
};

TEST_F(TypingWhileTheRobotMoves, ANumberOfAPoseIsEntered) {
  play();
  editor().select({Kind::kObject, "", "post"});
  auto& x = part<QAbstractSpinBox>("position_x");
  type_slowly(x, QStringLiteral("-350"));
  EXPECT_TRUE(window().player().is_playing());
  QTest::keyClick(&x, Qt::Key_Return);
  EXPECT_NEAR(editor().state().find("post")->X_PO.translation().x(), -0.35, 1e-9);
}

TEST_F(TypingWhileTheRobotMoves, ANameIsEntered) {
  play();
  editor().select({Kind::kObject, "", "post"});
  auto& name = part<QLineEdit>("object_name");
  type_slowly(name, QStringLiteral("pillar"));
  QTest::keyClick(&name, Qt::Key_Return);
  EXPECT_TRUE(editor().state().find("pillar"));
}

TEST_F(TypingWhileTheRobotMoves, AJointIsEntered) {
  play();
  window().workbench().show_panel("joints");
  auto& elbow = *part<QWidget>("elbow").findChild<QAbstractSpinBox*>();
  type_slowly(elbow, QStringLiteral("12.5"));
  QTest::keyClick(&elbow, Qt::Key_Return);
  EXPECT_FALSE(window().player().is_playing()) << "a person took over";
  EXPECT_NEAR(window().document().configuration()[1], 12.5 * M_PI / 180.0, 1e-6);
}

TEST_F(TypingWhileTheRobotMoves, TypingIsAboutWhatIsSelected) {
  play();
  editor().select({Kind::kObject, "", "post"});
  const geometric::Pose before = editor().state().find("post")->X_PO;
  type_slowly(part<QAbstractSpinBox>("position_x"), QStringLiteral("5"));
  editor().select({Kind::kPalm, "", ""});
  wait_for_frames(2);
  EXPECT_FALSE(gui::is_being_edited(part<QAbstractSpinBox>("position_x")));
  EXPECT_TRUE(editor().state().find("post")->X_PO.isApprox(before));
}

TEST_F(TypingWhileTheRobotMoves, NoPanelWritesOverIt) {
  play();
  int count = 0;
  for (const gui::SceneItem& item :
       {gui::SceneItem{Kind::kObject, "", "post"}, gui::SceneItem{Kind::kPalm, "", ""},
        gui::SceneItem{Kind::kStart, "", ""}}) {
    editor().select(item);
    count += type_into_all(part<QDockWidget>("properties"));
  }
  for (const char* dock : {"control"}) {
    auto* found = window().findChild<QDockWidget*>(QLatin1String(dock));
    ASSERT_TRUE(found) << dock;
    show_dock(dock);
    QList<QTabWidget*> tabs = found->findChildren<QTabWidget*>();
    const int pages = tabs.isEmpty() ? 1 : tabs.front()->count();
    for (int page = 0; page < pages; ++page) {
      if (!tabs.isEmpty()) {
        tabs.front()->setCurrentIndex(page);
        QTest::qWait(20);
      }
      count += type_into_all(*found);
    }
    if (!window().player().is_playing()) {
      window().player().play();
    }
  }
  RecordProperty("fields", count);
  EXPECT_GT(count, 30);
}

TEST_F(TypingWhileTheRobotMoves, EmulatedDevicesDoNotWriteOverIt) {
  tool<gui::DevicesPanel>().choose_devices("emulator", "none");
  gui::MotionDriver& driver = window().workbench().driver;
  QObject::connect(&driver, &gui::MotionDriver::measured, &driver, [this] { ++frames_; });
  click("devices_connect");
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return driver.state() == gui::MotionDriver::State::kConnected; }, kPatienceMs));
  editor().select({Kind::kObject, "", "post"});
  auto& y = part<QAbstractSpinBox>("position_y");
  type_slowly(y, QStringLiteral("410"));
  QTest::keyClick(&y, Qt::Key_Return);
  EXPECT_NEAR(editor().state().find("post")->X_PO.translation().y(), 0.41, 1e-9);
  click("devices_connect");
  ASSERT_TRUE(QTest::qWaitFor([&] { return driver.state() == gui::MotionDriver::State::kOff; },
                              kPatienceMs));
}

}  // namespace
}  // namespace handway::test
