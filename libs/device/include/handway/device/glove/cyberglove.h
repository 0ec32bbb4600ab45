#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace handway::device {

/// Settings of the connection to a CyberGlove.
struct CyberGloveSettings {
  double rate = 100.0;  ///< Requested frames per second, Hz, 0.5 to 480.
  int baud = 115200;    ///< Rate of a serial port, bit/s.
  bool polled = false;  ///< Request every frame instead of streaming.
  bool filter = true;   ///< The interface unit's own low-pass filter.
  /// The device counts as lost after this long without an answer, or without a frame.
  std::chrono::milliseconds timeout{1000};
};

/// Driver of CyberGlove I, II and III (18 or 22 sensors) on a serial port, a Bluetooth serial port,
/// a TCP port or over WiFi, by the interface unit's binary commands. Frames are stamped when their
/// last byte arrives. A CyberGlove III that doesn't answer these is read in its native stream
/// (CyberGlove3Parser), at its own rate, 90 Hz; the stream does not report an unplugged glove.
///
/// connect() stops any activity of the unit, queries state, number of sensors and hand, sets rate
/// and filter, and starts the stream. When the glove is pulled off the unit next() reports it, and
/// restarts the stream once it is back.
class HANDWAY_DEVICE_EXPORT CyberGlove final : public Glove {
 public:
  /// @param address as for open_link().
  /// @throws std::invalid_argument if the rate is out of range.
  explicit CyberGlove(std::string address, const CyberGloveSettings& settings = {});
  ~CyberGlove() override;

 private:
  struct Session;

  GloveInfo do_connect(const std::stop_token& stop) override;
  GloveReading do_next(std::chrono::milliseconds timeout, const std::stop_token& stop) override;
  void do_disconnect() noexcept override;
  [[nodiscard]] ReceptionFaults do_faults() const override;

  void start_sampling();
  GloveReading take_frame(std::chrono::milliseconds timeout, const std::stop_token& stop);
  GloveReading look_for_glove(std::chrono::milliseconds timeout, const std::stop_token& stop);
  void take_bytes(std::span<const std::uint8_t> bytes);
  void poll_when_due(Clock::time_point latest);

  std::string address_;
  CyberGloveSettings settings_;
  std::unique_ptr<Session> session_;  ///< While connected.
  ReceptionFaults faults_;            ///< Faults of former connections.
};

}  // namespace handway::device
