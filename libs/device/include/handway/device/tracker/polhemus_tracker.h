#pragma once

#include "handway/device/export.h"
#include "handway/device/tracker/polhemus_parser.h"
#include "handway/device/tracker/tracker.h"

#include <chrono>
#include <memory>
#include <string>

namespace handway::device {

/// Protocol family of a Polhemus tracker.
enum class PolhemusModel {
  kFastrak,
  kLiberty,  ///< Includes Patriot and Latus.
};

/// Settings of the connection to a Polhemus tracker.
struct PolhemusSettings {
  PolhemusModel model = PolhemusModel::kFastrak;
  int baud = 115200;    ///< Rate of a serial port, bit/s.
  bool ascii = false;   ///< Text records instead of binary ones; Fastrak only.
  bool button = false;  ///< Request the switch of a stylus, too.
  /// The device counts as lost after this long without an answer, or without a record.
  std::chrono::milliseconds timeout{1000};
};

/// Driver of Polhemus trackers on a serial port or a TCP port. Samples are stamped when their last
/// byte arrives. Records that the device marks as distorted or out of range are dropped and counted
/// in ReceptionFaults::doubtful.
///
/// connect() stops any activity of the unit, queries its state, sets units and output list of every
/// station, and starts the continuous output. When no record comes the unit is queried again: if it
/// answers, its sensors are unplugged; if not, the connection is lost.
class HANDWAY_DEVICE_EXPORT PolhemusTracker final : public Tracker {
 public:
  /// @param address as for open_link().
  /// @throws std::invalid_argument for a Liberty in ASCII.
  explicit PolhemusTracker(std::string address, const PolhemusSettings& settings = {});
  ~PolhemusTracker() override;

 private:
  struct Session;

  TrackerInfo do_connect(const std::stop_token& stop) override;
  TrackerReading do_next(std::chrono::milliseconds timeout, const std::stop_token& stop) override;
  void do_disconnect() noexcept override;
  [[nodiscard]] ReceptionFaults do_faults() const override;

  void take_records(std::chrono::milliseconds timeout);
  void take(const PolhemusRecord& record, Clock::time_point arrival);
  void wait_for_answer(const std::stop_token& stop);
  bool look_for_life(Clock::time_point now);

  std::string address_;
  PolhemusSettings settings_;
  std::unique_ptr<Session> session_;  ///< While connected.
  ReceptionFaults faults_;            ///< Faults of former connections.
};

}  // namespace handway::device
