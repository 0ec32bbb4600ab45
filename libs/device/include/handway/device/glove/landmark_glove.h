#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>

namespace handway::device {

/// Settings of a glove that hand landmarks stand in for.
struct LandmarkGloveSettings {
  std::optional<bool> left;  ///< The hand to follow; none: the first one seen.
  /// The sender counts as gone after this long without a good line.
  std::chrono::milliseconds timeout{1000};
};

/// "udp://[HOST:]PORT" or "landmarks://HOST:PORT".
[[nodiscard]] HANDWAY_DEVICE_EXPORT bool is_landmark_address(const std::string& address);

/// A hand seen by a camera, a headset or a Leap Motion, as a glove: it receives lines of landmarks
/// (see landmark_line.h). Its frames have the angles between the landmarks, as a right hand's; they
/// are stamped when they arrive. The other hand's lines are ignored. A hand with a wrong name is
/// recognized by the bending of its fingers, with a warning in the log. While no hand is seen
/// next() reports it as unplugged. Invalid lines are counted and dropped, as are datagrams that
/// come later than one with a later time.
class HANDWAY_DEVICE_EXPORT LandmarkGlove final : public Glove {
 public:
  /// @param address "udp://PORT" to receive from this computer, "udp://0.0.0.0:PORT" from all (one
  /// line per datagram); "landmarks://HOST:PORT" to connect to a sender's TCP port.
  /// @throws geometric::InputError for a wrong address.
  explicit LandmarkGlove(std::string address, const LandmarkGloveSettings& settings = {});
  ~LandmarkGlove() override;

 private:
  struct Session;

  GloveInfo do_connect(const std::stop_token& stop) override;
  GloveReading do_next(std::chrono::milliseconds timeout, const std::stop_token& stop) override;
  void do_disconnect() noexcept override;
  [[nodiscard]] ReceptionFaults do_faults() const override { return faults_; }

  void take_lines(std::chrono::milliseconds timeout);
  void take_line(const std::string& line, Clock::time_point arrival);
  void check_sender() const;

  std::string address_;
  LandmarkGloveSettings settings_;
  std::unique_ptr<Session> session_;  ///< While connected.
  ReceptionFaults faults_;
};

}  // namespace handway::device
