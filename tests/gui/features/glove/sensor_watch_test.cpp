#include "features/glove/glove_sources.h"
#include "features/glove/sensor_bars.h"

#include <gtest/gtest.h>
#include <handway_test/paths.h>

#include <filesystem>
#include <fstream>

namespace handway::test {
namespace {

using gui::SensorWatch;
using Verdict = SensorWatch::Verdict;

device::GloveFrame frame_at(double time) {
  device::GloveFrame frame;
  frame.time = time;
  for (std::size_t i = 0; i < frame.counts.size(); ++i) {
    frame.counts.at(i) = static_cast<std::uint16_t>(100 + static_cast<int>(10.0 * time) % 40);
  }
  return frame;
}

TEST(SensorWatch, FindsASensorThatDoesNotMove) {
  SensorWatch watch;
  for (double time = 0.0; time < 6.0; time += 0.02) {
    device::GloveFrame frame = frame_at(time);
    frame.counts[7] = 90;
    watch.take(frame);
  }
  EXPECT_EQ(watch.sensors()[7].verdict, Verdict::kDead);
  EXPECT_EQ(watch.sensors()[6].verdict, Verdict::kGood);
}

TEST(SensorWatch, DoesNotBlameSensorsOfAHandThatRests) {
  SensorWatch watch;
  for (double time = 0.0; time < 9.0; time += 0.02) {
    device::GloveFrame frame;
    frame.time = time;
    frame.counts.fill(90);
    watch.take(frame);
  }
  EXPECT_EQ(watch.sensors()[7].verdict, Verdict::kGood);
}

TEST(SensorWatch, FindsASensorAtTheEndOfItsRange) {
  SensorWatch watch;
  for (double time = 0.0; time < 2.0; time += 0.02) {
    device::GloveFrame frame = frame_at(time);
    frame.counts[3] = 255;
    watch.take(frame);
  }
  EXPECT_EQ(watch.sensors()[3].verdict, Verdict::kSaturated);
}

TEST(SensorWatch, KnowsSensorsThatTheGloveLacks) {
  SensorWatch watch;
  device::GloveFrame frame = frame_at(0.0);
  frame.counts[6] = 0;
  watch.take(frame);
  EXPECT_EQ(watch.sensors()[6].verdict, Verdict::kMissing);
}

TEST(GlovePorts, NamesAnAdapterOnceAndByItsName) {
  const ScratchFolder folder;
  namespace fs = std::filesystem;
  for (const char* name : {"ttyUSB0", "ttyACM1", "rfcomm0", "ttyS0"}) {
    std::ofstream(folder.path() / name) << "";
  }
  fs::create_directories(folder.path() / "serial/by-id");
  fs::create_symlink(folder.path() / "ttyUSB0",
                     folder.path() / "serial/by-id/usb-FTDI_Serial_A5-if00-port0");
  const auto ports = gui::find_glove_ports(QString::fromStdString(folder.path().string()));
  ASSERT_EQ(ports.size(), 3);
  EXPECT_EQ(ports[0].label, QStringLiteral("FTDI Serial A5  (ttyUSB0)"));
  EXPECT_TRUE(ports[0].path.endsWith(QStringLiteral("by-id/usb-FTDI_Serial_A5-if00-port0")));
}

}  // namespace
}  // namespace handway::test
