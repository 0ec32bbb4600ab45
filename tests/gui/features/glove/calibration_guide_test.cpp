#include "features/glove/calibration_guide.h"

#include "glove_dock.h"
#include "handway/device/glove/glove_calibration.h"
#include "patience.h"

#include <QLabel>
#include <QLineEdit>
#include <QPushButton>

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
