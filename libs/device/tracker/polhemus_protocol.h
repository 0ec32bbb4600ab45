#pragma once

#include "handway/device/tracker/polhemus_record.h"
#include "handway/device/tracker/polhemus_tracker.h"

#include <memory>
#include <span>
#include <string_view>

namespace handway::device {

/// What one model of tracker wants to hear, and how its records are read.
class PolhemusProtocol {
 public:
  virtual ~PolhemusProtocol() = default;
  PolhemusProtocol(const PolhemusProtocol&) = delete;
  PolhemusProtocol& operator=(const PolhemusProtocol&) = delete;

  [[nodiscard]] virtual std::string_view name() const = 0;
  /// Ends what it is doing.
  [[nodiscard]] virtual std::string stop_command() const = 0;
  /// Asks for a reply, whatever it is doing.
  [[nodiscard]] virtual std::string probe_command() const = 0;
  /// Sets it up; between two of them it needs a pause.
  [[nodiscard]] virtual std::vector<std::string> set_up_commands() const = 0;
  [[nodiscard]] virtual std::string start_command() const = 0;

  virtual std::vector<PolhemusRecord> parse(std::span<const std::uint8_t> bytes) = 0;
  /// Forgets the beginning of an incomplete record.
  virtual void reset() = 0;
  /// `doubtful` is left at 0.
  [[nodiscard]] virtual TrackerFaults faults() const = 0;

 protected:
  PolhemusProtocol() = default;
};

[[nodiscard]] std::unique_ptr<PolhemusProtocol> make_polhemus_protocol(
    const PolhemusSettings& settings);

}  // namespace handway::device
