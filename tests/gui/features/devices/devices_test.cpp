/// The Devices tab: from a path on screen to a motion of emulated hardware.
#include "features/devices/device_session.h"
#include "features/devices/devices_panel.h"
#include "features/editing/scene_editing.h"
#include "handway/device/emulators/arm_emulator.h"
#include "handway/planning/edits/scene_edits.h"
#include "model/planning/path_validity.h"
#include "patience.h"
#include "widgets/forms/slider_row.h"
#include "window_test.h"

#include <QAction>
#include <QCheckBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTabWidget>
#include <QTextDocument>
#include <QUndoStack>

#include <chrono>

namespace handway::test {
namespace {

using gui::MotionDriver;
using ::testing::HasSubstr;
using Clock = std::chrono::steady_clock;

class Devices : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (!IsSkipped()) {
      open(cell().post());
      window().player().set_loop(false);
      part<QTabWidget>("control_tabs").setCurrentWidget(&panel());
    }
  }

  [[nodiscard]] gui::DevicesPanel& panel() const { return tool<gui::DevicesPanel>(); }
  [[nodiscard]] MotionDriver& driver() const { return window().workbench().driver; }
  [[nodiscard]] bool reaches(MotionDriver::State state) const {
    return QTest::qWaitFor([&] { return driver().state() == state; }, kPatienceMs);
  }
  /// Waits for the end of a motion. @returns the state after it: without a fault kConnected.
  [[nodiscard]] MotionDriver::State state_after_motion() const {
    const auto ended = [&] {
      return driver().state() == MotionDriver::State::kConnected ||
             driver().state() == MotionDriver::State::kOff;
    };
    EXPECT_TRUE(QTest::qWaitFor(ended, kPatienceMs));
    return driver().state();
  }
  void wait_for_problem() const {
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return window().document().problem()->if_ready() != nullptr; }, kPatienceMs));
  }
  void connect_emulators() const {
    wait_for_problem();
    click("devices_connect");
    ASSERT_TRUE(reaches(MotionDriver::State::kConnected)) << text("devices_problem");
  }
  void choose_speed(double speed) const {
    auto& row = part<gui::SliderRow>("devices_speed");
    row.set_value(speed);
    emit row.value_edited(speed);
  }
  /// Waits until the motion may run, and ticks that it may.
  void arm() const {
    auto& armed = part<QCheckBox>("devices_armed");
    ASSERT_TRUE(QTest::qWaitFor([&] { return armed.isEnabled(); }, kPatienceMs))
        << text("devices_motion");
    armed.click();
    ASSERT_TRUE(part<QPushButton>("devices_run").isEnabled());
  }
  /// A wall of 1500 × 20 × 3000 mm from the base outwards, `angle` (rad) about it.
  void add_wall(double angle) const {
    geometric::SceneObject wall;
    wall.name = "wall";
    wall.shape = geometric::Box{{1.5, 0.02, 3.0}};
    wall.X_PO = geometric::pose_from_rpy({std::cos(angle), std::sin(angle), 0.0}, 0.0, 0.0, angle);
    editor().apply("Add a wall", planning::with_object(editor().state(), wall), {"wall"});
  }
  [[nodiscard]] gui::SceneEditor& editor() const { return window().editor(); }
  /// Across the workspace, between start and goal.
  static constexpr double kAcross = 1.2;
  [[nodiscard]] bool says(const char* label, const char* words) const {
    return QTest::qWaitFor([&] { return text(label).find(words) != std::string::npos; },
                           kPatienceMs);
  }
  /// Plans, connects, and lets the robot begin to move.
  void run_the_path() {
    plan();
    connect_emulators();
    choose_speed(1.0);
    arm();
    QSignalSpy progressed(&driver(), &MotionDriver::progressed);
    click("devices_run");
    ASSERT_TRUE(QTest::qWaitFor([&] { return progressed.size() > 5; }, kPatienceMs));
  }
  /// Returns whether the measured robot is free.
  [[nodiscard]] bool is_free() const {
    const auto& problem = window().document().problem();
    std::stop_source never;
    return !problem->wait(never.get_token())
                ->checker->clone()
                ->first_collision(window().document().configuration());
  }
  [[nodiscard]] std::string text(const char* label) const {
    QTextDocument document;
    document.setHtml(part<QLabel>(label).text());
    return document.toPlainText().toStdString();
  }
};

TEST_F(Devices, RunAPathAndTellHowItWent) {
  plan();
  connect_emulators();
  choose_speed(1.0);
  arm();
  const int width = panel().minimumSizeHint().width();
  std::shared_ptr<const gui::ExecutedMotion> executed;
  QObject::connect(&driver(), &MotionDriver::ended, &driver(),
                   [&](const auto& /*outcome*/, const auto& motion) { executed = motion; });
  click("devices_run");
  ASSERT_TRUE(QTest::qWaitFor([&] { return executed != nullptr; }, kPatienceMs));
  ASSERT_THAT(text("devices_outcome"), HasSubstr("Done in"));
  EXPECT_THAT(text("devices_outcome"), HasSubstr("Largest following error"));
  EXPECT_EQ(panel().minimumSizeHint().width(), width) << "the curves would push the view aside";
  EXPECT_EQ(state_after_motion(), MotionDriver::State::kConnected);
  EXPECT_FALSE(panel().is_armed()) << "it holds for one motion";
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return part<QPushButton>("devices_run").text() == "Run backwards"; }, kPatienceMs));
  EXPECT_TRUE(std::filesystem::exists(executed->log));
  EXPECT_NEAR(window().document().configuration()[0], window().document().scene()->goal.value()[0],
              0.02);
}

TEST_F(Devices, MoveNothingUnlessTheyAreArmed) {
  plan();
  connect_emulators();
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return part<QCheckBox>("devices_armed").isEnabled(); }, kPatienceMs));
  EXPECT_FALSE(part<QPushButton>("devices_run").isEnabled());
}

// At full speed the path passes the post at less than the assumed following error.
TEST_F(Devices, AreLetMoveTooCloseOnlyByAConfirmationThatSaysSo) {
  plan();
  connect_emulators();
  auto& armed = part<QCheckBox>("devices_armed");
  choose_speed(0.05);
  arm();
  EXPECT_EQ(armed.text(), "Let the robot move");
  choose_speed(1.0);
  EXPECT_FALSE(armed.isChecked()) << "it was for the slow motion";
  ASSERT_TRUE(QTest::qWaitFor([&] { return armed.isEnabled(); }, kPatienceMs));
  EXPECT_THAT(text("devices_motion"), HasSubstr("too close"));
  EXPECT_EQ(armed.text(), "Move despite low clearance");
  EXPECT_FALSE(part<QPushButton>("devices_run").isEnabled());
  armed.click();
  EXPECT_TRUE(part<QPushButton>("devices_run").isEnabled());
}

TEST_F(Devices, HoldAndGoOn) {
  plan();
  connect_emulators();
  choose_speed(1.0);
  arm();
  QSignalSpy progressed(&driver(), &MotionDriver::progressed);
  click("devices_run");
  ASSERT_TRUE(QTest::qWaitFor([&] { return progressed.size() > 5; }, kPatienceMs));
  click("devices_hold");
  EXPECT_TRUE(driver().is_held());
  QTest::qWait(400);
  const geometric::Configuration held = window().document().configuration();
  QTest::qWait(200);
  EXPECT_TRUE(window().document().configuration().isApprox(held, 1e-3));
  click("devices_hold");
  ASSERT_EQ(state_after_motion(), MotionDriver::State::kConnected);
  EXPECT_THAT(text("devices_outcome"), HasSubstr("Done in"));
}

TEST_F(Devices, StopAtTheRedButton) {
  plan();
  auto& stop = part<QPushButton>("devices_stop");
  EXPECT_TRUE(stop.isHidden());
  connect_emulators();
  EXPECT_TRUE(stop.isVisible());
  choose_speed(0.5);
  arm();
  QSignalSpy progressed(&driver(), &MotionDriver::progressed);
  click("devices_run");
  ASSERT_TRUE(QTest::qWaitFor([&] { return progressed.size() > 5; }, kPatienceMs));
  click("devices_stop");
  ASSERT_EQ(state_after_motion(), MotionDriver::State::kConnected);
  EXPECT_THAT(text("devices_outcome"), HasSubstr("Stopped after"));
  EXPECT_GT(window().document().configuration()[0], -0.1);
  EXPECT_LT(window().document().configuration()[0], 1.45);
}

TEST_F(Devices, RefuseAPathThatBeginsElsewhereAndOfferAWayOut) {
  plan();
  window().document().set_configuration(geometric::Configuration::Constant(4, 0.1));
  connect_emulators();
  auto& start_here = part<QPushButton>("devices_start_here");
  ASSERT_TRUE(QTest::qWaitFor([&] { return start_here.isVisible(); }, kPatienceMs));
  EXPECT_THAT(text("devices_motion"), HasSubstr("shoulder is 5.7° away"));
  EXPECT_FALSE(part<QCheckBox>("devices_armed").isEnabled());
  start_here.click();
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return part<QCheckBox>("devices_armed").isEnabled(); }, kPatienceMs))
      << text("devices_motion");
  EXPECT_NEAR(window().document().scene()->start.value()[0], 0.1, 1e-3);
}

TEST_F(Devices, SayWhyTheyCannotBeReached) {
  wait_for_problem();
  panel().choose_devices("localhost:1", "none");
  click("devices_connect");
  ASSERT_TRUE(reaches(MotionDriver::State::kOff));
  EXPECT_THAT(text("devices_problem"), HasSubstr("arm://localhost:1"));
}

TEST_F(Devices, StopTheHandWhenTheArmFails) {
  plan();
  wait_for_problem();
  device::Val3ControllerSettings settings;
  settings.joints = {{"shoulder", "elbow"},
                     Eigen::Vector2d(-0.3, -2.5),
                     Eigen::Vector2d(1.8, 2.5),
                     Eigen::Vector2d(1.0, 1.0)};
  settings.position = Eigen::Vector2d::Zero();
  settings.fault = {device::FaultKind::kEstop, 0.3};
  const device::ArmEmulator emulator(settings, 0);
  panel().choose_devices(QString::fromStdString(emulator.address()), "emulator");
  click("devices_connect");
  ASSERT_TRUE(reaches(MotionDriver::State::kConnected)) << text("devices_problem");
  arm();
  click("devices_run");
  ASSERT_TRUE(reaches(MotionDriver::State::kOff));
  EXPECT_THAT(text("devices_outcome"), HasSubstr("emergency"));
}

TEST_F(Devices, DoNotRunThroughAWallThatWasAddedAfterPlanning) {
  plan();
  connect_emulators();
  arm();
  ASSERT_TRUE(QTest::qWaitFor([&] { return window().workbench().analysis.motion() != nullptr; },
                              kPatienceMs))
      << "the path has times";
  auto& run = part<QPushButton>("devices_run");
  auto& armed = part<QCheckBox>("devices_armed");
  const auto* to_export = window().findChild<QAction*>(QStringLiteral("export_path"));
  ASSERT_TRUE(to_export && to_export->isEnabled());
  add_wall(kAcross);
  EXPECT_FALSE(run.isEnabled()) << "at once";
  EXPECT_FALSE(armed.isEnabled());
  EXPECT_FALSE(to_export->isEnabled());
  EXPECT_THAT(text("devices_motion"), HasSubstr("Out of date"));
  EXPECT_THAT(text("path_validity"), HasSubstr("Out of date"));
  EXPECT_EQ(text("playback_note"), "out of date");
  ASSERT_TRUE(says("devices_motion", "Not cleared")) << text("devices_motion");
  ASSERT_TRUE(says("path_validity", "wall")) << text("path_validity");
  EXPECT_THAT(text("path_validity"), HasSubstr(" s of the path"));
  EXPECT_EQ(window().workbench().validity.state(), gui::PathValidity::State::kInvalid);
  EXPECT_FALSE(run.isEnabled());
  EXPECT_FALSE(armed.isEnabled());
  EXPECT_FALSE(to_export->isEnabled());
  editor().undo_stack().undo();
  EXPECT_FALSE(run.isEnabled()) << "until it is checked again";
  arm();
  EXPECT_TRUE(QTest::qWaitFor([&] { return to_export->isEnabled(); }, kPatienceMs));
  EXPECT_TRUE(text("path_validity").empty() || !part<QLabel>("path_validity").isVisible());
}

TEST_F(Devices, HoldBeforeAWallThatIsAddedUnderWay) {
  run_the_path();
  if (HasFatalFailure()) {
    return;
  }
  double held_ms = -1.0;
  const auto edited = Clock::now();
  QObject::connect(&driver(), &MotionDriver::held, &driver(), [&] {
    if (held_ms < 0.0) {
      held_ms = std::chrono::duration<double, std::milli>(Clock::now() - edited).count();
    }
  });
  add_wall(kAcross);
  ASSERT_TRUE(says("devices_problem", "wall")) << text("devices_problem");
  EXPECT_LE(held_ms, 100.0);
  RecordProperty("held_ms", std::to_string(held_ms));
  EXPECT_TRUE(driver().is_held());
  QTest::qWait(500);
  EXPECT_EQ(driver().state(), MotionDriver::State::kRunning);
  EXPECT_TRUE(is_free());
  // It does not go on, however often this is requested.
  const geometric::Configuration held = window().document().configuration();
  for (int k = 0; k < 3; ++k) {
    QSignalSpy refused(&driver(), &MotionDriver::held);
    click("devices_hold");
    ASSERT_TRUE(QTest::qWaitFor([&] { return !refused.isEmpty(); }, kPatienceMs));
    QTest::qWait(100);
    EXPECT_TRUE(window().document().configuration().isApprox(held, 1e-3));
  }
  editor().undo_stack().undo();
  ASSERT_TRUE(says("devices_problem", "can continue")) << text("devices_problem");
  click("devices_hold");
  ASSERT_EQ(state_after_motion(), MotionDriver::State::kConnected);
  EXPECT_THAT(text("devices_outcome"), HasSubstr("Done in"));
}

TEST_F(Devices, DoNotGoOnThroughAWallThatWasAddedDuringAHold) {
  run_the_path();
  if (HasFatalFailure()) {
    return;
  }
  click("devices_hold");
  QTest::qWait(400);
  add_wall(kAcross);
  ASSERT_TRUE(says("devices_problem", "wall")) << text("devices_problem");
  click("devices_hold");
  QTest::qWait(400);
  EXPECT_TRUE(driver().is_held());
  EXPECT_TRUE(is_free());
  click("devices_stop");
  EXPECT_EQ(state_after_motion(), MotionDriver::State::kConnected);
}

TEST_F(Devices, StopWhereAnObjectIsPutOnTheRobot) {
  run_the_path();
  if (HasFatalFailure()) {
    return;
  }
  add_wall(window().document().configuration()[0]);
  ASSERT_EQ(state_after_motion(), MotionDriver::State::kConnected);
  EXPECT_THAT(text("devices_outcome"), HasSubstr("wall"));
}

TEST_F(Devices, ShowTheMeasuredPostureAlone) {
  plan();
  connect_emulators();
  ASSERT_TRUE(QTest::qWaitFor([&] { return window().document().shows_measured(); }, kPatienceMs));
  const geometric::Configuration measured = window().document().configuration();
  const auto shows_it = [&] {
    return window().document().configuration().isApprox(measured, 1e-6);
  };
  EXPECT_EQ(text("playback_note"), "robot as measured");
  window().player().play();
  QTest::qWait(300);
  EXPECT_TRUE(shows_it()) << "played";
  window().player().seek(0.7);
  EXPECT_TRUE(shows_it()) << "stepped";
  window().document().set_configuration((measured.array() + 0.2).matrix());
  EXPECT_TRUE(shows_it()) << "dragged";
  add_wall(-1.2);
  EXPECT_TRUE(shows_it()) << "edited";
  editor().undo_stack().undo();
  EXPECT_TRUE(shows_it()) << "undone";
  QTest::qWait(300);
  EXPECT_TRUE(shows_it());
  part<QCheckBox>("devices_mirror").click();
  window().document().set_configuration((measured.array() + 0.2).matrix());
  EXPECT_FALSE(shows_it()) << "not wanted any more";
  part<QCheckBox>("devices_mirror").click();
  EXPECT_TRUE(shows_it()) << "at once";
}

TEST_F(Devices, LetGoWhenAnotherSceneIsOpened) {
  connect_emulators();
  open(cell().wall());
  EXPECT_TRUE(reaches(MotionDriver::State::kOff));
}

}  // namespace
}  // namespace handway::test
