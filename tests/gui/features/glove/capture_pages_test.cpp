#include "features/glove/capture_pages.h"

#include "dropped_file.h"
#include "features/glove/capture_coach.h"
#include "features/glove/pmd_explorer.h"
#include "features/glove/posture_recordings.h"
#include "glove_dock.h"
#include "handway/device/glove/hand_exploration.h"
#include "handway/device/glove/recording.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/postures/posture_table.h"
#include "handway_test/paths.h"
#include "patience.h"
#include "window_test.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QTabBar>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace handway::test {
namespace {

using ::testing::HasSubstr;

class CapturePages : public GloveDock {
 protected:
  [[nodiscard]] gui::PmdPad& pad() const { return part<gui::PmdPad>("pmd_pad"); }

  // Records a motion of both sensors through much of their ranges, the middle finger slower.
  [[nodiscard]] std::filesystem::path recording() const {
    device::Recording recording;
    recording.header.kind = device::RecordingKind::kAngles;
    for (const auto& mapped : pincers_mapping().joints) {
      recording.header.sensors.push_back(mapped.sensor);
    }
    recording.times = Eigen::VectorXd::LinSpaced(600, 0.0, 6.0);
    recording.values.resize(600, 2);
    for (Eigen::Index row = 0; row < 600; ++row) {
      const double time = recording.times[row];
      recording.values.row(row) << 0.3 + 0.4 * std::sin(3.0 * time), 0.3 + 0.2 * std::cos(time);
    }
    const std::filesystem::path file = cell().folder() / "motion.csv";
    device::write_recording(recording, file);
    return file;
  }
  void show_recording() {
    panel().come_to_front("explore");
    panel().capture().show_recordings({QString::fromStdString(recording().string())});
    const auto& source = part<QComboBox>("explorer_source");
    ASSERT_TRUE(QTest::qWaitFor([&] { return source.currentText() == "motion.csv"; }));
    auto& basis = part<QComboBox>("explorer_basis");
    basis.setCurrentIndex(1);
    emit basis.activated(1);
  }
};

TEST_F(CapturePages, ShowARecordingThatIsDroppedOnTheWindow) {
  drop_file(window(), recording());
  const auto& source = part<QComboBox>("explorer_source");
  EXPECT_TRUE(QTest::qWaitFor([&] { return source.currentText() == "motion.csv"; }));
  EXPECT_TRUE(source.isVisible());
}

TEST_F(CapturePages, CountWhereTheHandHasBeen) {
  panel().come_to_front("coach");
  connect_to_emulator();
  const auto& coverage = panel().capture().coach().coverage();
  ASSERT_TRUE(QTest::qWaitFor([&] { return panel().capture().postures().count() > 2; }));
  const double before = coverage.share();
  for (const std::uint16_t counts : {64, 72, 80, 90, 110, 120}) {
    set_counts(counts);
    QTest::qWait(60);
  }
  EXPECT_TRUE(QTest::qWaitFor([&] { return coverage.share() > before + 0.1; }));
  EXPECT_THAT(panel().capture().coach().advice().toStdString(), HasSubstr("Keep moving"));
  click("glove_connect");
  click("capture_restart");
  EXPECT_EQ(panel().capture().postures().count(), 0);
}

TEST_F(CapturePages, MoveTheHandWhereThePadIsPressed) {
  show_recording();
  ASSERT_FALSE(::testing::Test::HasFatalFailure());
  const double before = joint("left");
  const QPointF target(0.05, 0.02);
  QTest::mouseClick(&pad(), Qt::LeftButton, {}, pad().to_pixel(target).toPoint());
  EXPECT_NE(joint("left"), before);
  EXPECT_NEAR(pad().posture().x(), target.x(), 0.01);
  EXPECT_NEAR(pad().posture().y(), target.y(), 0.01);
}

TEST_F(CapturePages, StopFollowingTheGloveWhenThePadIsUsed) {
  show_recording();
  connect_to_emulator();
  ASSERT_TRUE(part<QCheckBox>("glove_follow").isChecked());
  QTest::mouseClick(&pad(), Qt::LeftButton, {}, pad().to_pixel({0.0, 0.0}).toPoint());
  EXPECT_FALSE(part<QCheckBox>("glove_follow").isChecked());
}

TEST_F(CapturePages, SaveABasisThatTheSceneNamesUntilThatIsUndone) {
  const auto before = window().document().loaded().basis;
  ASSERT_TRUE(before);
  show_recording();
  ASSERT_FALSE(::testing::Test::HasFatalFailure());
  const std::filesystem::path file = cell().folder() / "mine.yaml";
  panel().capture().explorer().save(file);
  EXPECT_EQ(sampling::read_postures(cell().folder() / "mine_postures.csv").postures.rows(), 600);
  click("basis_use");
  EXPECT_EQ(window().document().scene()->hand_basis, file);
  const auto used = window().document().loaded().basis;
  EXPECT_EQ(used->directions.size(), 2U);
  EXPECT_TRUE(QTest::qWaitFor([&] {
    return window().document().recorded_hand().state() == gui::RecordedHand::State::kReady;
  }));
  EXPECT_FALSE(part<QPushButton>("basis_use").isEnabled()) << "it is the scene's already";
  window().editor().undo_stack().undo();
  EXPECT_EQ(window().document().loaded().basis, before);
  window().editor().undo_stack().redo();
  EXPECT_EQ(window().document().loaded().basis, used);
}

// Recorded on the robot: no sensor, nothing to map.
TEST_F(CapturePages, ShowRecordingsOfTheHandsOwnJoints) {
  const std::filesystem::path file = cell().folder() / "joint_states.yaml";
  std::ofstream out(file);
  for (int row = 0; row < 100; ++row) {
    out << "name: [left, right]\nposition: [" << 0.2 + 0.1 * std::sin(0.1 * row) << ", "
        << 0.2 + 0.1 * std::cos(0.1 * row) << "]\n---\n";
  }
  out.close();
  panel().come_to_front("explore");
  panel().capture().show_recordings({QString::fromStdString(file.string())});
  const auto& source = part<QComboBox>("explorer_source");
  ASSERT_TRUE(QTest::qWaitFor([&] { return source.currentText() == "joint_states.yaml"; }));
  EXPECT_FALSE(part<QComboBox>("explorer_method").isEnabled()) << "there is nothing to map";
  EXPECT_THAT(part<QLabel>("explorer_errors").text().toStdString(),
              HasSubstr("joint_states.yaml: taken for the robot hand's own joints"));
  auto& basis = part<QComboBox>("explorer_basis");
  basis.setCurrentIndex(1);
  emit basis.activated(1);
  const std::filesystem::path saved = cell().folder() / "own.yaml";
  panel().capture().explorer().save(saved);
  EXPECT_EQ(sampling::read_postures(cell().folder() / "own_postures.csv").postures.rows(), 100);
  emit part<QComboBox>("explorer_source").activated(0);
  EXPECT_TRUE(part<QComboBox>("explorer_method").isEnabled()) << "live, of a person";
}

TEST_F(CapturePages, CompareTheBasisWithAnother) {
  show_recording();
  ASSERT_FALSE(::testing::Test::HasFatalFailure());
  auto& other = part<QComboBox>("explorer_compare");
  other.setCurrentIndex(1);
  emit other.activated(1);
  const auto& text = part<QLabel>("basis_comparison");
  EXPECT_TRUE(QTest::qWaitFor([&] { return text.text().contains(QStringLiteral("Angles")); }));
  EXPECT_THAT(text.text().toStdString(), HasSubstr("Postures of this basis"));
}

/// Pages for the hand that ships with the scene, whose fingers can be retargeted.
class CapturePagesOfAHand : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    open(source_dir() / "scenes" / "can_on_table.yaml");
    panel().come_to_front("explore");
  }
  [[nodiscard]] gui::GlovePanel& panel() const { return *window().findChild<gui::GlovePanel*>(); }
  [[nodiscard]] gui::GloveSession& session() const { return panel().session(); }
  [[nodiscard]] QString errors() const { return part<QLabel>("explorer_errors").text(); }
  [[nodiscard]] bool compares() const {
    return QTest::qWaitFor([&] { return errors().contains(QStringLiteral("<table")); },
                           kPatienceMs);
  }
  /// Records some seconds of an exploring hand. @returns the file.
  [[nodiscard]] QString recording(const char* name, std::uint64_t seed) const {
    device::HandExploration hand(seed);
    device::Recording recording;
    recording.header.kind = device::RecordingKind::kAngles;
    for (int sensor = 0; sensor < device::kGloveSensors; ++sensor) {
      recording.header.sensors.push_back(sensor);
    }
    recording.times = Eigen::VectorXd::LinSpaced(600, 0.0, 60.0);
    recording.values.resize(600, device::kGloveSensors);
    for (Eigen::Index row = 0; row < 600; ++row) {
      const device::GloveAngles angles = hand.at(recording.times[row]);
      recording.values.row(row) =
          Eigen::Map<const Eigen::RowVectorXd>(angles.angles.data(), device::kGloveSensors);
    }
    const std::filesystem::path file = folder_.path() / name;
    device::write_recording(recording, file);
    return QString::fromStdString(file.string());
  }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }
  void choose_retargeting() const {
    auto& method = part<QComboBox>("explorer_method");
    method.setCurrentIndex(1);
    emit method.activated(1);
    ASSERT_TRUE(QTest::qWaitFor([&] { return session().source() != nullptr; }, kPatienceMs));
  }

 private:
  ScratchFolder folder_;
};

TEST_F(CapturePagesOfAHand, CompareBothMethodsOnARecording) {
  panel().capture().show_recordings({recording("motion.csv", 1)});
  ASSERT_TRUE(compares());
  EXPECT_THAT(errors().toStdString(), HasSubstr("Joint mapping"));
  EXPECT_THAT(errors().toStdString(), HasSubstr("Fingertip retargeting"));
}

TEST_F(CapturePagesOfAHand, SayWhatTheTableOfAnotherProgramWasTakenFor) {
  device::Recording motion = device::read_recording(recording("own.csv", 1).toStdString());
  const std::filesystem::path file = folder() / "spreadsheet.csv";
  {
    std::ofstream out(file);
    for (const int sensor : motion.header.sensors) {
      out << device::cyberglove_sensors()[static_cast<std::size_t>(sensor)].name << ',';
    }
    out << "subject\n"
        << (motion.values / geometric::kDegree)
               .format(Eigen::IOFormat(6, Eigen::DontAlignCols, ",", ",anna\n"))
        << ",anna\n";
  }
  panel().capture().show_recordings({QString::fromStdString(file.string())});
  ASSERT_TRUE(compares());
  EXPECT_THAT(errors().toStdString(), HasSubstr("<p>spreadsheet.csv: taken for degrees"));
  EXPECT_THAT(errors().toStdString(), HasSubstr("passed over: subject"));
}

TEST_F(CapturePagesOfAHand, MakeThePosturesOfARecordingByFingertips) {
  panel().capture().show_recordings({recording("motion.csv", 1)});
  ASSERT_TRUE(compares());
  choose_retargeting();
  const auto& retargeter = *session().retargeter();
  EXPECT_FALSE(std::ranges::count(retargeter.joints(), "joint_1")) << "the arm has no part in it";
  ASSERT_TRUE(compares());
  EXPECT_EQ(part<QComboBox>("explorer_source").currentText(), QStringLiteral("motion.csv"));
  const std::filesystem::path file = folder() / "by_fingertips.yaml";
  part<QComboBox>("explorer_basis").setCurrentIndex(1);
  emit part<QComboBox>("explorer_basis").activated(1);
  panel().capture().explorer().save(file);
  EXPECT_EQ(sampling::read_pmd_basis(file).joints, retargeter.joints());
}

TEST_F(CapturePagesOfAHand, FollowTheGloveByFingertips) {
  choose_retargeting();
  panel().connect_to(gui::GloveSession::emulator_name());
  EXPECT_TRUE(
      QTest::qWaitFor([&] { return panel().capture().postures().count() > 20; }, kPatienceMs));
  EXPECT_EQ(panel().capture().postures().joints(), session().retargeter()->joints());
  EXPECT_TRUE(compares());
}

TEST_F(CapturePagesOfAHand, ReportHowGoodABasisOfSeveralPersonsIs) {
  panel().capture().show_recordings({recording("anna.csv", 1), recording("ben.csv", 2)});
  part<QTabBar>("explorer_views").setCurrentIndex(1);
  const gui::BasisReportView& report = panel().capture().explorer().report();
  ASSERT_TRUE(QTest::qWaitFor([&] { return report.text().contains(QStringLiteral("ben.csv")); },
                              kPatienceMs));
  EXPECT_THAT(report.text().toStdString(), HasSubstr("anna.csv"));
  EXPECT_THAT(report.text().toStdString(), HasSubstr("a new person (estimate)"));
  EXPECT_THAT(report.text().toStdString(), HasSubstr(" for 5 mm: "));
  EXPECT_EQ(part<QComboBox>("explorer_source").currentText(), QStringLiteral("anna.csv + ben.csv"));
}

TEST_F(CapturePages, RefuseABasisOfAnotherHand) {
  EXPECT_THROW(panel().capture().explorer().open(source_dir() / "resources/bases/sah_auro.yaml"),
               geometric::InputError);
}

TEST_F(CapturePages, SayWhatIsWrongWithARecording) {
  panel().capture().show_recordings({QString::fromStdString(cell().broken().string())});
  EXPECT_TRUE(QTest::qWaitFor(
      [&] { return part<QLabel>("glove_error").text().contains(QStringLiteral("broken.yaml")); }));
}

}  // namespace
}  // namespace handway::test
