#include "features/tracker/wrist_page.h"

#include "features/glove/glove_panel.h"
#include "handway/device/emulators/device_emulator.h"
#include "handway/device/emulators/tracker_units.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/robot_state.h"
#include "patience.h"
#include "window_test.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>

#include <mutex>

namespace handway::test {
namespace {

using ::testing::HasSubstr;

constexpr double kExact = 1e-3;  // m

/// The workbench with the scene that ships, and an emulated Fastrak whose sensor is where the test
/// puts it.
class WristPage : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (IsSkipped()) {
      return;
    }
    open(source_dir() / "scenes" / "can_on_table.yaml");
    window().document().set_configuration(*window().document().scene()->start);
    WindowTest::tool<gui::GlovePanel>().come_to_front("Wrist");
  }

  void connect_to(const QString& address) const {
    part<QComboBox>("tracker_protocol").setCurrentIndex(1);
    part<QLineEdit>("tracker_address").setText(address);
    click("tracker_connect");
  }

  void connect_to_emulator() {
    emulator_ = std::make_unique<device::DeviceEmulator>(
        device::DeviceEmulatorSettings{},
        device::make_fastrak_unit({}, [place = place_](double, int) {
          const std::lock_guard lock(place->mutex);
          return geometric::pose_from_rpy(place->p_ST, 0.0, 0.0, 0.0);
        }));
    connect_to(QString::fromStdString(emulator_->address()));
    ASSERT_TRUE(QTest::qWaitFor([&] { return page().listening_time() > 0.0; }, kPatienceMs));
  }

  void take_hold() {
    grip_ = tool();
    click("tracker_clutch");
    ASSERT_TRUE(page().leader().is_clutch_closed());
    wait_for_sample();
  }

  /// The first sample after the clutch was closed, or a setting changed, is where it takes hold;
  /// the second was surely measured later.
  void wait_for_sample() const {
    for (int i = 0; i < 2; ++i) {
      const double time = page().listening_time();
      ASSERT_TRUE(QTest::qWaitFor([&] { return page().listening_time() > time; }, kPatienceMs));
    }
  }

  void move_sensor(const Eigen::Vector3d& way) {
    const std::lock_guard lock(place_->mutex);
    place_->p_ST += way;
  }
  void unplug() { emulator_.reset(); }

  [[nodiscard]] gui::WristPage& page() const { return WindowTest::tool<gui::WristPage>(); }
  /// Returns the motion of the tool since the clutch was closed, m.
  [[nodiscard]] Eigen::Vector3d way() const { return tool() - grip_; }
  [[nodiscard]] bool waits_for_way(const Eigen::Vector3d& wanted) const {
    return QTest::qWaitFor([&] { return (way() - wanted).norm() < kExact; }, kPatienceMs);
  }
  [[nodiscard]] Eigen::Vector3d tool() const {
    const geometric::RobotInstance& robot = *window().document().robot();
    geometric::RobotState state(robot.model);
    state.set_configuration(window().document().configuration());
    const int last = window().document().joints().arm.back();
    return state.link_pose(robot.model->variable_link(last)).translation();
  }

 private:
  struct Place {
    std::mutex mutex;
    Eigen::Vector3d p_ST{0.4, 0.0, 0.1};
  };

  std::shared_ptr<Place> place_ = std::make_shared<Place>();
  std::unique_ptr<device::DeviceEmulator> emulator_;
  Eigen::Vector3d grip_ = Eigen::Vector3d::Zero();
};

TEST_F(WristPage, LeadsTheArmWhileTheClutchIsClosed) {
  connect_to_emulator();
  const Eigen::Vector3d before = tool();
  move_sensor({0.0, 0.05, 0.0});
  wait_for_sample();
  take_hold();
  EXPECT_LT((tool() - before).norm(), kExact) << "an arm that isn't led stands";
  move_sensor({0.0, 0.04, 0.05});
  EXPECT_TRUE(waits_for_way({0.0, 0.04, 0.05})) << way().transpose();
  click("tracker_clutch");
  move_sensor({0.0, -0.1, 0.0});
  wait_for_sample();
  take_hold();
  EXPECT_LT(way().norm(), kExact);
  move_sensor({0.02, 0.0, 0.0});
  EXPECT_TRUE(waits_for_way({0.02, 0.0, 0.0})) << way().transpose();
}

TEST_F(WristPage, ScalesTheWayAndKeepsTheToolInItsBox) {
  connect_to_emulator();
  part<QDoubleSpinBox>("tracker_scale").setValue(0.5);
  part<QCheckBox>("tracker_box").setChecked(true);
  take_hold();
  move_sensor({0.0, 0.0, 0.1});
  EXPECT_TRUE(waits_for_way({0.0, 0.0, 0.05})) << way().transpose();
  const double highest = tool().z() + 0.02;
  part<QDoubleSpinBox>("tracker_most_Z").setValue(geometric::millimetres(highest));
  wait_for_sample();
  move_sensor({0.0, 0.0, 0.2});
  EXPECT_TRUE(QTest::qWaitFor([&] { return std::abs(tool().z() - highest) < kExact; }, kPatienceMs))
      << tool().z() << " instead of " << highest;
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return part<QLabel>("tracker_follow").text().contains("edge"); }, kPatienceMs));
}

TEST_F(WristPage, SlidesOverTheTable) {
  connect_to_emulator();
  part<QComboBox>("contact_rule").setCurrentIndex(2);
  take_hold();
  for (int i = 0; i < 40 && part<QLabel>("glove_contact").isHidden(); ++i) {
    move_sensor({0.0, 0.0, -0.015});
    wait_for_sample();
  }
  ASSERT_FALSE(part<QLabel>("glove_contact").isHidden()) << way().transpose();
  const double side = way().y();
  for (int i = 0; i < 40 && way().y() < side + 0.05; ++i) {
    move_sensor({0.0, 0.015, 0.0});
    wait_for_sample();
  }
  EXPECT_GE(way().y(), side + 0.05) << way().transpose();
  const auto problem = window().document().problem()->if_ready();
  ASSERT_TRUE(problem);
  const auto checker = problem->checker->clone();
  EXPECT_FALSE(checker->first_collision(window().document().configuration()));
}

TEST_F(WristPage, ReleasesTheArmWhenTheTrackerIsDisconnected) {
  connect_to_emulator();
  take_hold();
  click("tracker_connect");
  EXPECT_FALSE(page().leader().is_clutch_closed());
  EXPECT_FALSE(part<QPushButton>("tracker_clutch").isEnabled());
}

TEST_F(WristPage, SaysWhyItCannotConnect) {
  connect_to("/dev/no-such-tracker");
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return page().session().link().state() == device::StreamState::kFailed; },
      kPatienceMs));
  EXPECT_THAT(part<QLabel>("tracker_error").text().toStdString(),
              HasSubstr("/dev/no-such-tracker"));
  connect_to("");
  EXPECT_THAT(part<QLabel>("tracker_error").text().toStdString(), HasSubstr("no address"));
}

TEST_F(WristPage, NoticesThatTheTrackerIsGone) {
  connect_to_emulator();
  unplug();
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return page().session().link().state() == device::StreamState::kLost; }, kPatienceMs));
  EXPECT_FALSE(part<QLabel>("tracker_error").text().isEmpty());
}

TEST_F(WristPage, BringsItsOwnEmulator) {
  part<QComboBox>("tracker_protocol").setCurrentIndex(0);
  click("tracker_connect");
  ASSERT_TRUE(QTest::qWaitFor([&] { return page().listening_time() > 0.0; }, kPatienceMs));
  take_hold();
  EXPECT_TRUE(QTest::qWaitFor([&] { return way().norm() > 0.02; }, kPatienceMs));
}

}  // namespace
}  // namespace handway::test
