#include "handway/device/tracker/udp_tracker.h"

#include "core/udp_receiver.h"
#include "handway/device/core/device_error.h"
#include "handway/device/tracker/pose_datagram.h"

#include <algorithm>
#include <array>
#include <deque>
#include <map>

namespace handway::device {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kSlice{20};
// Datagrams don't overtake each other by so much: the sender's clock was set back, s.
constexpr double kRestart = 1.0;

}  // namespace

struct UdpTracker::Session {
  UdpReceiver receiver;
  std::deque<TrackerSample> samples;  ///< Arrived and not yet taken.
  std::map<int, double> sent;         ///< By sensor, the sender's time of the last sample.
  Clock::time_point last_sign = Clock::now();
};

UdpTracker::UdpTracker(std::string address, const UdpTrackerSettings& settings)
    : address_(std::move(address)), settings_(settings) {
  (void)parse_udp_address(address_);  // Refuses wrong ones.
}

UdpTracker::~UdpTracker() { disconnect(); }

void UdpTracker::take_datagram(milliseconds timeout) {
  std::array<std::uint8_t, kLongestPoseDatagram> bytes{};
  const auto length = session_->receiver.receive(bytes, timeout);
  if (!length) {
    return;
  }
  const auto arrival = Clock::now();
  auto sample =
      *length <= bytes.size() ? read_pose_datagram(std::span(bytes).first(*length)) : std::nullopt;
  if (!sample) {
    ++faults_.resynchronisations;
    faults_.dropped_bytes += *length;
    return;
  }
  session_->last_sign = arrival;
  const auto [last, first] = session_->sent.try_emplace(sample->sensor, sample->time);
  const double late = last->second - sample->time;
  if (!first && late > 0.0 && late < kRestart) {
    ++faults_.doubtful;
    return;
  }
  last->second = sample->time;
  sample->time = since_begin(arrival);
  session_->samples.push_back(*sample);
}

TrackerInfo UdpTracker::do_connect(const std::stop_token& stop) {
  session_.reset();  // Its port is needed.
  session_ = std::make_unique<Session>(
      Session{UdpReceiver(address_, parse_udp_address(address_)), {}, {}});
  const auto end = Clock::now() + settings_.timeout;
  while (session_->samples.empty() && Clock::now() < end && !stop.stop_requested()) {
    take_datagram(kSlice);
  }
  if (session_->samples.empty()) {
    session_.reset();
    throw DeviceError({address_, "",
                       "no pose for " + std::to_string(settings_.timeout.count()) + " ms",
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
    take_datagram(std::clamp(left, milliseconds(0), kSlice));
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
  return {TrackerEvent::kSample, sample};
}

void UdpTracker::do_disconnect() noexcept { session_.reset(); }

}  // namespace handway::device
