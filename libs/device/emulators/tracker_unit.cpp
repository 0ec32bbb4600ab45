#include "emulators/tracker_unit.h"

#include "handway/geometric/math/units.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace handway::device {
namespace {

// Longest delay that a unit catches up with, s.
constexpr double kLongestDelay = 0.25;
// Longest command: longer bytes are noise.
constexpr std::size_t kLongestCommand = 80;

}  // namespace

TrackerUnit::TrackerUnit(const TrackerUnitSettings& settings, TrackerSignal signal,
                         int most_sensors)
    : settings_(settings), signal_(std::move(signal)) {
  if (settings.sensors < 1 || settings.sensors > most_sensors) {
    throw std::invalid_argument("this tracker has 1 to " + std::to_string(most_sensors) +
                                " sensors");
  }
  if (!(settings.rate > 0.0 && std::isfinite(settings.rate))) {
    throw std::invalid_argument("a rate has to be above 0");
  }
}

DeviceUnit::Bytes TrackerUnit::receive(std::span<const std::uint8_t> bytes, double now) {
  Bytes out;
  for (const std::uint8_t byte : bytes) {
    command_ += static_cast<char>(byte);
    if (is_whole(command_)) {
      const Bytes answer = obey(command_, now);
      out.insert(out.end(), answer.begin(), answer.end());
      command_.clear();
    } else if (command_.size() > kLongestCommand) {
      command_.clear();
    }
  }
  return out;
}

std::vector<DeviceUnit::Bytes> TrackerUnit::advance(double now) {
  std::vector<Bytes> records;
  if (!streaming_) {
    return records;
  }
  next_frame_ = std::max(next_frame_, now - kLongestDelay);
  for (; next_frame_ <= now; next_frame_ += period_) {
    for (int sensor = 1; plugged_ && sensor <= settings_.sensors; ++sensor) {
      records.push_back(record(next_frame_, sensor));
    }
  }
  return records;
}

DeviceUnit::Bytes TrackerUnit::frame(double now) {
  Bytes bytes;
  for (int sensor = 1; plugged_ && sensor <= settings_.sensors; ++sensor) {
    const Bytes one = record(now, sensor);
    bytes.insert(bytes.end(), one.begin(), one.end());
  }
  return bytes;
}

std::optional<double> TrackerUnit::next_due() const {
  return streaming_ ? std::optional(next_frame_) : std::nullopt;
}

void TrackerUnit::begin_stream(double now, double frames_per_second) {
  streaming_ = true;
  period_ = 1.0 / frames_per_second;
  next_frame_ = now + period_;
}

bool TrackerUnit::pressed(double time, int sensor) const {
  return settings_.button && sensor == 1 && std::fmod(time, 2.0) >= 1.0;
}

void append_u16(DeviceUnit::Bytes& bytes, std::uint16_t value) {
  bytes.push_back(static_cast<std::uint8_t>(value));
  bytes.push_back(static_cast<std::uint8_t>(value >> 8U));
}

void append_u32(DeviceUnit::Bytes& bytes, std::uint32_t value) {
  append_u16(bytes, static_cast<std::uint16_t>(value));
  append_u16(bytes, static_cast<std::uint16_t>(value >> 16U));
}

void append_float(DeviceUnit::Bytes& bytes, double value) {
  append_u32(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

void append_text(DeviceUnit::Bytes& bytes, std::string_view text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
}

Eigen::Vector3d azimuth_elevation_roll(const Eigen::Matrix3d& R) {
  return geometric::rpy_from_rotation(R).reverse() / geometric::kDegree;
}

Eigen::Vector4d scalar_first(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  const Eigen::Vector4d wxyz(q.w(), q.x(), q.y(), q.z());
  return q.w() < 0.0 ? Eigen::Vector4d(-wxyz) : wxyz;
}

std::vector<int> comma_list(std::string_view text) {
  std::vector<int> numbers;
  const char* at = text.data();
  const char* end = at + text.size();
  while (at < end) {
    int value = 0;
    const auto [stop, error] = std::from_chars(at, end, value);
    if (error != std::errc()) {
      break;
    }
    numbers.push_back(value);
    if (stop == end || *stop != ',') {
      break;
    }
    at = stop + 1;
  }
  return numbers;
}

}  // namespace handway::device
