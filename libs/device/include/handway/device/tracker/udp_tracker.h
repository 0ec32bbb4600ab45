#pragma once

#include "handway/device/export.h"
#include "handway/device/tracker/tracker.h"

#include <chrono>
#include <memory>
#include <string>

namespace handway::device {

struct UdpTrackerSettings {
  /// The source is taken for lost after this long without a good datagram.
  std::chrono::milliseconds timeout{1000};
};

/// Poses that somebody sends as UDP datagrams: see read_pose_datagram(). Samples are stamped when
/// they arrive. A datagram that is older than one of the same sensor before (by its own time, by
/// less than a second; by more, its sender has started again) is dropped.
class HANDWAY_DEVICE_EXPORT UdpTracker final : public Tracker {
 public:
  /// @param address "PORT" to hear senders on this computer, "0.0.0.0:PORT" all, or
  /// "HOST:PORT" with an address of this computer.
  /// @throws geometric::InputError for a wrong address.
  explicit UdpTracker(std::string address, const UdpTrackerSettings& settings = {});
  ~UdpTracker() override;

 private:
  struct Session;

  TrackerInfo do_connect(const std::stop_token& stop) override;
  TrackerReading do_next(std::chrono::milliseconds timeout, const std::stop_token& stop) override;
  void do_disconnect() noexcept override;
  [[nodiscard]] TrackerFaults do_faults() const override { return faults_; }

  void take_datagram(std::chrono::milliseconds timeout);

  std::string address_;
  UdpTrackerSettings settings_;
  std::unique_ptr<Session> session_;  ///< While connected.
  TrackerFaults faults_;
};

}  // namespace handway::device
