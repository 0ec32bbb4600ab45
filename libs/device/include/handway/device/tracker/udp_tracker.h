#pragma once

#include "handway/device/export.h"
#include "handway/device/tracker/tracker.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace handway::device {

/// Length of the longest datagram accepted, bytes.
inline constexpr std::size_t kLongestPoseDatagram = 1024;

/// Reads a pose from a UDP datagram: one JSON object in UTF-8 with
///
///     {"sensor": 0, "time": 12.345, "position": [x, y, z], "quaternion": [x, y, z, w],
///      "button": false}
///
/// position in m, quaternion of unit length within 1e-3 with its scalar last, as in VRPN; time in
/// s on the sender's clock; sensor from 0 to 255 (default 0); button may be left out; other keys
/// are ignored.
/// @returns the sample, its time that of the sender; nothing if the datagram is anything else.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::optional<TrackerSample> read_pose_datagram(
    std::span<const std::uint8_t> datagram);

/// @pre the sample's numbers are finite.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string write_pose_datagram(const TrackerSample& sample);

/// Settings of a tracker that sends datagrams.
struct UdpTrackerSettings {
  /// The source counts as lost after this long without a good datagram.
  std::chrono::milliseconds timeout{1000};
};

/// Poses received as UDP datagrams: see read_pose_datagram(). Messages of hands with the pose of
/// the wrist (see hand_message.h) are poses, too: of the right hand as sensor 0, of the left hand
/// as sensor 1. Samples are stamped when they arrive. A datagram that is older than one of the same
/// sensor before (by its own time, by less than a second; by more, its sender has restarted) is
/// dropped.
class HANDWAY_DEVICE_EXPORT UdpTracker final : public Tracker {
 public:
  /// @param address "PORT" to receive from this computer, "0.0.0.0:PORT" from all, or "HOST:PORT"
  /// with an address of this computer.
  /// @throws geometric::InputError for a wrong address.
  explicit UdpTracker(std::string address, const UdpTrackerSettings& settings = {});
  ~UdpTracker() override;

 private:
  struct Session;

  TrackerInfo do_connect(const std::stop_token& stop) override;
  TrackerReading do_next(std::chrono::milliseconds timeout, const std::stop_token& stop) override;
  void do_disconnect() noexcept override;
  [[nodiscard]] ReceptionFaults do_faults() const override { return faults_; }

  void take_datagram(std::chrono::milliseconds timeout);
  void take_sample(TrackerSample sample, bool has_time, Clock::time_point arrival);

  std::string address_;
  UdpTrackerSettings settings_;
  std::unique_ptr<Session> session_;  ///< While connected.
  ReceptionFaults faults_;
};

}  // namespace handway::device
