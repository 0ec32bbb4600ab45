#include "handway/device/glove/recording.h"

#include "features/glove/record_bar.h"
#include "glove_dock.h"

#include <QFileDialog>
#include <QStandardPaths>

namespace handway::test {
namespace {

class GloveRecording : public GloveDock {
 protected:
  void SetUp() override {
    QStandardPaths::setTestModeEnabled(true);
    GloveDock::SetUp();
  }
  void TearDown() override {
    QStandardPaths::setTestModeEnabled(false);
    GloveDock::TearDown();
  }

  [[nodiscard]] std::size_t rows() const { return panel().session().link().tap().rows(); }
  [[nodiscard]] QFileDialog* dialog() const {
    return window().findChild<QFileDialog*>(QStringLiteral("record_name"));
  }
};

TEST_F(GloveRecording, KeepsEveryRowUnderTheNameThatIsGivenAfterwards) {
  connect_to_emulator();
  click("record");
  ASSERT_TRUE(QTest::qWaitFor([&] { return rows() >= 30; }));
  click("record");
  ASSERT_NE(dialog(), nullptr);
  dialog()->reject();
  const std::size_t written = rows();
  const std::filesystem::path file = cell().folder() / "mine.csv";
  panel().record_bar().keep_as(file);
  const device::Recording recording = device::read_recording(file);
  EXPECT_EQ(static_cast<std::size_t>(recording.values.rows()), written);
  EXPECT_EQ(recording.header.kind, device::RecordingKind::kCounts);
  EXPECT_EQ(recording.times[0], 0.0);
  EXPECT_TRUE((recording.values.array() == 100.0).all());
}

TEST_F(GloveRecording, StaysWhereItIsWithoutAName) {
  connect_to_emulator();
  click("record");
  ASSERT_TRUE(QTest::qWaitFor([&] { return rows() >= 5; }));
  click("record");
  dialog()->reject();
  const std::filesystem::path file = panel().record_bar().file();
  EXPECT_TRUE(std::filesystem::exists(file));
  EXPECT_GE(device::read_recording(file).values.rows(), 5);
  std::filesystem::remove(file);
}

TEST_F(GloveRecording, LosesNothingWhenTheGloveGoesAway) {
  connect_to_emulator();
  click("record");
  ASSERT_TRUE(QTest::qWaitFor([&] { return rows() >= 10; }));
  unplug();
  ASSERT_TRUE(waits_for(device::StreamState::kLost));
  const std::filesystem::path file = panel().record_bar().file();
  EXPECT_EQ(static_cast<std::size_t>(device::read_recording(file).values.rows()), rows());
  click("record");
  dialog()->reject();
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace handway::test
