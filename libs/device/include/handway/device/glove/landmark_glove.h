#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove.h"
#include "handway/device/glove/hand_message.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace handway::device {

/// Settings of a glove that hand landmarks stand in for.
struct LandmarkGloveSettings {
  std::optional<bool> left;  ///< The hand to follow; none: the first one seen.
  /// The sender counts as gone after this long without a good line.
  std::chrono::milliseconds timeout{1000};
};

/// Returns whether an address is "udp://[HOST:]PORT", "landmarks://HOST:PORT", "pipe://PATH" or
/// "-", the standard input.
[[nodiscard]] HANDWAY_DEVICE_EXPORT bool is_landmark_address(const std::string& address);

/// A hand seen by a camera, a headset or a Leap Motion, or measured by a glove that another program
/// reads, as a glove: it receives messages of hands (see hand_message.h). Its frames have the
/// angles, of landmarks those between them, as a right hand's; they are stamped when they arrive.
/// The other hand's messages are ignored. A hand with a wrong name is
/// recognized by the bending of its fingers, with a warning in the log. While no hand is seen
/// next() reports it as unplugged. Invalid lines are counted and dropped, as are datagrams that
/// come later than one with a later time.
class HANDWAY_DEVICE_EXPORT LandmarkGlove final : public Glove {
 public:
  /// @param address "udp://PORT" to receive from this computer, "udp://0.0.0.0:PORT" from all (one
  /// line, or one frame of LZ4, per datagram); "landmarks://HOST:PORT" to connect to a sender's TCP
  /// port; "pipe://PATH" to read a named pipe; "-" to read the standard input, whose end is
  /// reported as that of a recording.
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
  void take_line(std::string_view line, Clock::time_point arrival);
  void take_hand(const HandObservation& hand, Clock::time_point arrival);
  void check_sender() const;

  std::string address_;
  LandmarkGloveSettings settings_;
  std::unique_ptr<Session> session_;  ///< While connected.
  ReceptionFaults faults_;
};

}  // namespace handway::device
