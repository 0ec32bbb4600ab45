#include "features/glove/calibration_guide.h"

#include "glove_dock.h"
#include "handway/device/emulators/device_emulator.h"
#include "handway/device/emulators/landmark_unit.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/human_hand.h"
#include "patience.h"

#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>

#include <cmath>

namespace handway::test {
namespace {

using ::testing::HasSubstr;

class CalibrationGuide : public GloveDock {
 protected:
  [[nodiscard]] gui::CalibrationGuide& guide() const { return tool<gui::CalibrationGuide>(); }
  [[nodiscard]] std::string instruction() const {
    return part<QLabel>("calibration_instruction").text().toStdString();
  }
  [[nodiscard]] std::string quality() const {
    return part<QLabel>("calibration_quality").text().toStdString();
  }
  void begin() {
    panel().come_to_front("sensors");
    connect_to_emulator();
    click("calibrate");
  }
  /// Reads the posture that is shown, and waits for the next.
  void read() {
    const std::string before = instruction();
    click("calibration_capture");
    ASSERT_TRUE(QTest::qWaitFor([&] { return instruction() != before; }, kPatienceMs));
  }
};

TEST_F(CalibrationGuide, LeadsThroughPosturesToACalibrationOfThePerson) {
  begin();
  EXPECT_THAT(instruction(), HasSubstr("flat"));
  QTest::keyClicks(&part<QLineEdit>("calibration_person"), QStringLiteral("Ann"));
  std::uint16_t counts = 80;
  while (part<QPushButton>("calibration_skip").isEnabled()) {
    set_counts(counts);
    QTest::qWait(100);  // until the sensors have moved there
    read();
    ASSERT_FALSE(HasFatalFailure());
    counts = counts == 80 ? 150 : 80;
  }
  EXPECT_THAT(quality(), HasSubstr("sensors calibrated"));
  const std::filesystem::path file = cell().folder() / "ann.yaml";
  guide().save(file);
  EXPECT_EQ(device::read_calibration(file).person, "Ann");
  EXPECT_EQ(panel().session().calibration().person, "Ann");
}

TEST_F(CalibrationGuide, MeasuresRangesAndBonesOfALandmarkSource) {
  const int pose = *device::find_sensor("IndexPIJ");
  device::DeviceEmulatorSettings line;
  line.tcp_port = 0;
  device::LandmarkUnitSettings unit;
  unit.rate = 60.0;
  const device::DeviceEmulator sender(line, device::make_landmark_unit(unit, [pose](double time) {
                                        device::GloveAngles angles{time, {}};
                                        angles.angles.at(static_cast<std::size_t>(pose)) =
                                            0.5 - 0.5 * std::cos(3.0 * time);
                                        return angles;
                                      }));
  panel().come_to_front("sensors");
  connect_to(QStringLiteral("landmarks://") + QString::fromStdString(sender.address()));
  ASSERT_TRUE(waits_for(device::StreamState::kStreaming));
  click("calibrate");
  while (instruction().find("Now move") == std::string::npos) {
    click("calibration_skip");
  }
  read();
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_THAT(quality(), HasSubstr("Bones were measured"));
  const std::filesystem::path file = cell().folder() / "ann.yaml";
  guide().save(file);
  const device::GloveCalibration person = device::read_calibration(file);
  ASSERT_TRUE(person.ranges.at(static_cast<std::size_t>(pose)) && person.bones);
  EXPECT_NEAR(person.ranges.at(static_cast<std::size_t>(pose))->second, 1.0, 0.05);
  EXPECT_NEAR(person.bones->at(2)[1], device::typical_bones().at(2)[1], 1e-4);
}

TEST_F(CalibrationGuide, TakesTheLengthOfTheHandThatIsTyped) {
  begin();
  while (part<QPushButton>("calibration_skip").isEnabled()) {
    click("calibration_skip");
  }
  EXPECT_THAT(quality(), HasSubstr("No posture was read"));
  auto& length = part<QDoubleSpinBox>("hand_length");
  length.setFocus();
  length.selectAll();
  QTest::keyClicks(&length, QStringLiteral("170"));
  QTest::keyClick(&length, Qt::Key_Return);
  auto& bone = part<QDoubleSpinBox>("bone_4_3");
  bone.setFocus();
  bone.selectAll();
  QTest::keyClicks(&bone, QStringLiteral("21.5"));
  QTest::keyClick(&bone, Qt::Key_Return);
  const std::filesystem::path file = cell().folder() / "ann.yaml";
  guide().save(file);
  const auto bones = device::read_calibration(file).bones;
  ASSERT_TRUE(bones);
  EXPECT_NEAR(bones->at(2)[1], device::typical_bones(0.17).at(2)[1], 1e-4);
  EXPECT_NEAR(bones->at(4)[3], 0.0215, 1e-6);
}

TEST_F(CalibrationGuide, AsksAgainForAPostureThatIsNotHeldStill) {
  begin();
  click("calibration_capture");
  std::uint16_t counts = 80;
  EXPECT_TRUE(QTest::qWaitFor(
      [&] {
        set_counts(counts = counts == 80 ? 120 : 80);
        return QString::fromStdString(quality()).contains(QStringLiteral("hold it still"));
      },
      kPatienceMs));
  EXPECT_THAT(instruction(), HasSubstr("flat"));
}

}  // namespace
}  // namespace handway::test
