/// Tests what memory the window keeps of scenes that were open before.
#include "handway_test/paths.h"
#include "window_test.h"

#include <QProcess>

#include <algorithm>
#include <sstream>

namespace handway::test {
namespace {

constexpr int kPatience = 600000;  // ms

/// The memory that a window has for itself after it has opened and planned scenes, MB.
double memory_after(const QStringList& scenes) {
  const ScratchFolder home;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  for (const char* name : {"HOME", "XDG_DATA_HOME", "XDG_CONFIG_HOME"}) {
    environment.insert(QLatin1String(name), QString::fromStdString(home.path().string()));
  }
  QProcess window;
  window.setProcessEnvironment(environment);
  window.setProcessChannelMode(QProcess::ForwardedErrorChannel);
  window.start(QStringLiteral(HANDWAY_WINDOW_MEMORY), scenes);
  EXPECT_TRUE(window.waitForFinished(kPatience));
  EXPECT_EQ(window.exitCode(), 0);
  return window.readAllStandardOutput().trimmed().toDouble();
}

TEST(WindowMemory, IsThatOfTheLargestSceneAfterTwenty) {
  HANDWAY_NEED_DISPLAY();
  QStringList scenes;
  double largest = 0.0;
  for (const auto& entry : std::filesystem::directory_iterator(source_dir() / "scenes")) {
    scenes << QString::fromStdString(entry.path().string());
    largest = std::max(largest, memory_after({scenes.back()}));
  }
  QStringList twenty;
  while (twenty.size() < 20) {
    twenty << scenes[twenty.size() % scenes.size()];
  }
  const double after_twenty = memory_after(twenty);
  ASSERT_GT(largest, 0.0);
  RecordProperty("largest_MB", std::to_string(largest));
  RecordProperty("after_twenty_MB", std::to_string(after_twenty));
  EXPECT_LE(after_twenty, 1.1 * largest) << "MB";
}

}  // namespace
}  // namespace handway::test
