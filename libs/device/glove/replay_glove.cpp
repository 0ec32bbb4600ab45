#include "handway/device/glove/replay_glove.h"

#include "glove/recording_player.h"
#include "handway/device/glove/glove_layout.h"
#include "recording_player.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <thread>

namespace handway::device {

namespace {

using std::chrono::milliseconds;

constexpr double kStopSlice = 0.02;  // s, after which a request to stop is seen.

int sensors_of(const RecordingHeader& header) {
  const auto has = [&](int sensor) { return column_of(header, sensor) >= 0; };
  const std::span<const int> always = cyberglove_wired(18);
  for (const int sensor : cyberglove_wired(kGloveSensors)) {
    if (std::ranges::find(always, sensor) == always.end() && has(sensor)) {
      return kGloveSensors;
    }
  }
  return 18;
}

}  // namespace

struct ReplayGlove::Player : RecordingPlayer {
  using RecordingPlayer::RecordingPlayer;
};

ReplayGlove::ReplayGlove(const Recording& recording, std::string name,
                         const ReplaySettings& settings)
    : player_(std::make_unique<const Player>(recording, typical_calibration())),
      name_(std::move(name)),
      settings_(settings),
      sensors_(sensors_of(recording.header)) {
  if (recording.header.kind == RecordingKind::kAngles) {
    angle_sensors_ = recording.header.sensors;
  }
  if (!(settings.speed > 0.0)) {
    throw std::invalid_argument("a recording plays at a speed above 0");
  }
}

ReplayGlove::~ReplayGlove() = default;

GloveInfo ReplayGlove::do_connect(const std::stop_token& /*stop*/) {
  begin_ = now();
  next_ = 0;
  GloveInfo info;
  info.device = name_;
  info.model = "recording";
  info.sensors = sensors_;
  info.angle_sensors = angle_sensors_;
  info.rate = std::isinf(settings_.speed) ? 0.0 : settings_.speed / player_->period();
  return info;
}

GloveReading ReplayGlove::do_next(milliseconds timeout, const std::stop_token& stop) {
  if (next_ == player_->size()) {
    if (!settings_.loop) {
      return {SampleEvent::kEnd, {}};
    }
    begin_ += player_->duration() / settings_.speed;
    next_ = 0;
  }
  GloveFrame frame = player_->frame(next_);
  frame.time = std::isinf(settings_.speed) ? now() : begin_ + frame.time / settings_.speed;
  const double end = now() + std::chrono::duration<double>(timeout).count();
  while (now() < frame.time) {
    const double left = std::min(frame.time, end) - now();
    if (left <= 0.0 || stop.stop_requested()) {
      return {};
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left, kStopSlice)));
  }
  ++next_;
  for (const int sensor : cyberglove_wired(sensors_)) {
    std::uint16_t& count = frame.counts[static_cast<std::size_t>(sensor)];
    count = count == 0 ? to_count(kMidScale) : count;
  }
  return {SampleEvent::kSample, frame};
}

}  // namespace handway::device
