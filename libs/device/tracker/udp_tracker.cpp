#include "handway/device/tracker/udp_tracker.h"

#include "core/ports.h"
#include "handway/device/core/device_error.h"
#include "handway/device/core/line_protocol.h"
#include "handway/device/glove/hand_message.h"
#include "polhemus_items.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <string_view>
#include <vector>

namespace handway::device {
namespace {

using PoseJson = nlohmann::ordered_json;

constexpr int kLastSensor = 255;

template <int Count>
std::optional<Eigen::Matrix<double, Count, 1>> numbers(const PoseJson& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array() || found->size() != Count) {
    return std::nullopt;
  }
  Eigen::Matrix<double, Count, 1> values;
  Eigen::Index k = 0;
  for (const PoseJson& value : *found) {
    if (!value.is_number()) {
      return std::nullopt;
    }
    values[k++] = value.get<double>();
  }
  return values;
}

// Reads sensor, time and button. @returns whether they are valid.
bool read_rest(const PoseJson& object, TrackerSample& sample) {
  const auto time = object.find("time");
  if (time == object.end() || !time->is_number() || !std::isfinite(time->get<double>())) {
    return false;
  }
  sample.time = time->get<double>();
  sample.sensor = 0;
  if (const auto sensor = object.find("sensor"); sensor != object.end()) {
    if (!sensor->is_number_unsigned() || sensor->get<std::uint64_t>() > kLastSensor) {
      return false;
    }
    sample.sensor = sensor->get<int>();
  }
  if (const auto button = object.find("button"); button != object.end()) {
    if (!button->is_boolean()) {
      return false;
    }
    sample.button = button->get<bool>();
  }
  return true;
}

}  // namespace

std::optional<TrackerSample> read_pose_datagram(std::span<const std::uint8_t> datagram) {
  if (datagram.size() > kLongestPoseDatagram) {
    return std::nullopt;
  }
  const PoseJson object = PoseJson::parse(datagram.begin(), datagram.end(), nullptr, false);
  if (!object.is_object()) {
    return std::nullopt;
  }
  const auto position = numbers<3>(object, "position");
  const auto xyzw = numbers<4>(object, "quaternion");
  TrackerSample sample;
  if (!position || !xyzw || !read_rest(object, sample)) {
    return std::nullopt;
  }
  const auto X_ST =
      pose_from_quaternion(*position, {(*xyzw)[3], (*xyzw)[0], (*xyzw)[1], (*xyzw)[2]});
  if (!X_ST) {
    return std::nullopt;
  }
  sample.X_ST = *X_ST;
  return sample;
}

std::string write_pose_datagram(const TrackerSample& sample) {
  const Eigen::Vector3d p = sample.X_ST.translation();
  const Eigen::Quaterniond q(sample.X_ST.linear());
  PoseJson object{{"sensor", sample.sensor},
                  {"time", sample.time},
                  {"position", {p.x(), p.y(), p.z()}},
                  {"quaternion", {q.x(), q.y(), q.z(), q.w()}}};
  if (sample.button) {
    object["button"] = *sample.button;
  }
  return object.dump();
}

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kDatagramWait{20};
// Step back by which the sender's clock must have been reset, not datagrams overtaken, s.
constexpr double kRestart = 1.0;
constexpr std::size_t kLongestDatagramOfHands = 65507;  // of UDP

/// A sample with its sender's time, if it has one.
struct SentSample {
  TrackerSample sample;
  bool has_time = true;
};

std::string_view trimmed_end(std::string_view text) {
  while (text.ends_with('\n') || text.ends_with('\r')) {
    text.remove_suffix(1);
  }
  return text;
}

/// Poses of the wrists of a message of hands: of the right one as sensor 0, of the left one as 1.
/// @throws LineProtocolError for another message, or if no hand has a pose.
std::vector<SentSample> read_wrists(std::span<const std::uint8_t> datagram) {
  const std::string_view text(reinterpret_cast<const char*>(datagram.data()), datagram.size());
  const HandMessage message = read_hand_message(trimmed_end(text));
  std::vector<SentSample> samples;
  for (const HandObservation& hand : message.hands) {
    if (hand.is_seen() && !hand.X_SH) {
      throw LineProtocolError(name_of(message.wire) + " without the pose of the wrist");
    }
    if (hand.X_SH) {
      samples.push_back(
          {{hand.time.value_or(0.0), hand.left ? 1 : 0, *hand.X_SH, {}}, hand.time.has_value()});
    }
  }
  return samples;
}

/// The samples of a datagram. @throws LineProtocolError if it is neither a pose nor of hands.
std::vector<SentSample> read_tracker_datagram(std::span<const std::uint8_t> datagram) {
  if (const auto pose = read_pose_datagram(datagram)) {
    return {{*pose}};
  }
  return read_wrists(datagram);
}

}  // namespace

struct UdpTracker::Session {
  UdpReceiver receiver;
  std::vector<std::uint8_t> datagram = std::vector<std::uint8_t>(kLongestDatagramOfHands);
  std::string problem = {};                ///< Problem of the last bad datagram.
  std::deque<TrackerSample> samples = {};  ///< Arrived and not yet taken.
  std::map<int, double> sent = {};         ///< Sender's time of each sensor's last sample.
  Clock::time_point last_sign = Clock::now();
};

UdpTracker::UdpTracker(std::string address, const UdpTrackerSettings& settings)
    : address_(std::move(address)), settings_(settings) {
  (void)parse_udp_address(address_);  // Refuses wrong ones.
}

UdpTracker::~UdpTracker() { disconnect(); }

void UdpTracker::take_datagram(milliseconds timeout) {
  const std::span<std::uint8_t> bytes(session_->datagram);
  const auto length = session_->receiver.receive(bytes, timeout);
  if (!length) {
    return;
  }
  const auto arrival = Clock::now();
  try {
    for (const SentSample& sent : read_tracker_datagram(bytes.first(*length))) {
      take_sample(sent.sample, sent.has_time, arrival);
    }
    session_->last_sign = arrival;
  } catch (const LineProtocolError& error) {
    ++faults_.resynchronisations;
    faults_.dropped_bytes += *length;
    session_->problem = error.what();
  }
}

void UdpTracker::take_sample(TrackerSample sample, bool has_time, Clock::time_point arrival) {
  if (has_time) {
    const auto [last, first] = session_->sent.try_emplace(sample.sensor, sample.time);
    const double late = last->second - sample.time;
    if (!first && late > 0.0 && late < kRestart) {
      ++faults_.doubtful;
      return;
    }
    last->second = sample.time;
  }
  sample.time = since_begin(arrival);
  session_->samples.push_back(sample);
}

TrackerInfo UdpTracker::do_connect(const std::stop_token& stop) {
  session_.reset();  // Its port is needed.
  session_ = std::make_unique<Session>(Session{UdpReceiver(address_, parse_udp_address(address_))});
  const auto end = Clock::now() + settings_.timeout;
  while (session_->samples.empty() && Clock::now() < end && !stop.stop_requested()) {
    take_datagram(kDatagramWait);
  }
  if (session_->samples.empty()) {
    const std::string last =
        session_->problem.empty() ? "" : " (the last datagram: " + session_->problem + ")";
    session_.reset();
    throw DeviceError({address_, "",
                       "no pose for " + std::to_string(settings_.timeout.count()) + " ms" + last,
                       "datagrams with poses",
                       "Look whether the sender runs, and sends to this computer and port."});
  }
  return {address_, "UDP datagrams"};
}

TrackerReading UdpTracker::do_next(milliseconds timeout, const std::stop_token& stop) {
  const auto end = Clock::now() + timeout;
  while (session_->samples.empty() && !stop.stop_requested()) {
    const auto now = Clock::now();
    const auto left = std::chrono::ceil<milliseconds>(end - now);
    take_datagram(std::clamp(left, milliseconds(0), kDatagramWait));
    if (!session_->samples.empty()) {
      break;
    }
    if (now - session_->last_sign > settings_.timeout) {
      throw DeviceError({address_, "", "no pose any more", "datagrams with poses",
                         "Look whether the sender still runs."});
    }
    if (now >= end) {
      return {};
    }
  }
  if (session_->samples.empty()) {
    return {};
  }
  const TrackerSample sample = session_->samples.front();
  session_->samples.pop_front();
  return {SampleEvent::kSample, sample};
}

void UdpTracker::do_disconnect() noexcept { session_.reset(); }

}  // namespace handway::device
