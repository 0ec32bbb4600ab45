#include "counting_signal.h"
#include "handway/device/emulators/glove_emulator.h"
#include "handway/device/glove/cyberglove.h"
#include "handway/device/glove/glove.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mutex>
#include <thread>

namespace handway::device {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test::counting_signal;
using test::on_tcp;
using testing::HasSubstr;

/// Records the events of a stream.
class GloveListener {
 public:
  GloveStreamHandlers handlers() {
    GloveStreamHandlers all;
    all.on_sample = [this](const GloveFrame& frame) {
      const std::lock_guard lock(mutex_);
      frames_.push_back(frame);
    };
    all.on_state = [this](StreamState state) {
      const std::lock_guard lock(mutex_);
      states_.push_back(state);
    };
    return all;
  }

  [[nodiscard]] std::vector<GloveFrame> frames() const {
    const std::lock_guard lock(mutex_);
    return frames_;
  }
  [[nodiscard]] std::vector<StreamState> states() const {
    const std::lock_guard lock(mutex_);
    return states_;
  }
  /// Waits until so many frames came in all.
  void wait_for(std::size_t count) const {
    const auto end = std::chrono::steady_clock::now() + seconds(10);
    while (frames().size() < count && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(milliseconds(5));
    }
    ASSERT_GE(frames().size(), count);
  }

 private:
  mutable std::mutex mutex_;
  std::vector<GloveFrame> frames_;
  std::vector<StreamState> states_;
};

TEST(GloveStream, HandsOverEveryFrameInOrder) {
  const GloveEmulator emulator(on_tcp(), counting_signal());
  GloveListener listener;
  GloveStream stream(std::make_unique<CyberGlove>(emulator.address()), {}, listener.handlers());
  listener.wait_for(120);
  const StreamStatistics statistics = stream.statistics();
  EXPECT_NEAR(statistics.rate, 100.0, 15.0);
  EXPECT_GT(statistics.latency, 0.0);
  EXPECT_EQ(statistics.resynchronisations, 0U);
  EXPECT_EQ(stream.info().sensors, 22);
  stream.request_stop();
  ASSERT_TRUE(stream.wait(seconds(1)));
  EXPECT_EQ(stream.state(), StreamState::kStopped);
  const auto frames = listener.frames();
  for (std::size_t k = 1; k < frames.size(); ++k) {
    ASSERT_EQ(frames[k].counts[0], frames[k - 1].counts[0] % 255 + 1);
  }
}

TEST(GloveStream, ConnectsAgainWhenTheDeviceComesBack) {
  auto emulator = std::make_unique<GloveEmulator>(on_tcp(), counting_signal());
  const std::string address = emulator->address();
  const auto port = static_cast<std::uint16_t>(std::stoi(address.substr(address.find(':') + 1)));
  GloveListener listener;
  const GloveStream stream(std::make_unique<CyberGlove>(address), {}, listener.handlers());
  listener.wait_for(10);
  emulator.reset();
  std::this_thread::sleep_for(milliseconds(300));
  EXPECT_EQ(stream.state(), StreamState::kLost);
  EXPECT_THAT(stream.error(), HasSubstr(address));
  const std::size_t before = listener.frames().size();
  emulator = std::make_unique<GloveEmulator>(on_tcp(port), counting_signal());
  listener.wait_for(before + 10);
  EXPECT_EQ(stream.state(), StreamState::kStreaming);
  EXPECT_EQ(stream.statistics().reconnects, 1U);
  EXPECT_GE(stream.statistics().dropouts, 1U);
  const auto frames = listener.frames();
  for (std::size_t k = 1; k < frames.size(); ++k) {
    ASSERT_GE(frames[k].time, frames[k - 1].time) << "time goes on from one connection to the next";
  }
}

TEST(GloveStream, TellsItsStates) {
  GloveEmulator emulator(on_tcp(), counting_signal());
  GloveListener listener;
  GloveStream stream(std::make_unique<CyberGlove>(emulator.address()), {}, listener.handlers());
  listener.wait_for(5);
  emulator.set_plugged(false);
  for (int k = 0; k < 200 && stream.state() != StreamState::kUnplugged; ++k) {
    std::this_thread::sleep_for(milliseconds(10));
  }
  const std::size_t before = listener.frames().size();
  emulator.set_plugged(true);
  listener.wait_for(before + 3);
  stream.request_stop();
  ASSERT_TRUE(stream.wait(seconds(1)));
  using enum StreamState;
  EXPECT_THAT(listener.states(),
              testing::ElementsAre(kStreaming, kUnplugged, kStreaming, kStopped));
}

TEST(GloveStream, FailsWithTheReasonWhenThereIsNoDevice) {
  const GloveStream stream(std::make_unique<CyberGlove>("/dev/no-such-device"), {}, {});
  ASSERT_TRUE(stream.wait(seconds(2)));
  EXPECT_EQ(stream.state(), StreamState::kFailed);
  EXPECT_THAT(stream.error(), HasSubstr("/dev/no-such-device"));
}

TEST(GloveStream, WaitsForADeviceThatIsNotThereYet) {
  StreamSettings settings;
  settings.wait_for_device = true;
  std::string address;
  std::uint16_t port = 0;
  {
    const GloveEmulator finds_a_free_port(on_tcp(), counting_signal());
    address = finds_a_free_port.address();
    port = static_cast<std::uint16_t>(std::stoi(address.substr(address.find(':') + 1)));
  }
  GloveListener listener;
  const GloveStream stream(std::make_unique<CyberGlove>(address), settings, listener.handlers());
  std::this_thread::sleep_for(milliseconds(150));
  EXPECT_EQ(stream.state(), StreamState::kConnecting);
  const GloveEmulator emulator(on_tcp(port), counting_signal());
  listener.wait_for(5);
}

TEST(GloveStream, EndsWithin200MillisecondsWhateverItDoes) {
  StreamSettings settings;
  settings.wait_for_device = true;
  auto stream = std::make_unique<GloveStream>(std::make_unique<CyberGlove>("/dev/none"), settings,
                                              GloveStreamHandlers{});
  std::this_thread::sleep_for(milliseconds(500));
  const auto begin = std::chrono::steady_clock::now();
  stream.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, milliseconds(200));
}

}  // namespace
}  // namespace handway::device
