#pragma once

#include "handway/device/emulators/device_emulator.h"
#include "handway/device/export.h"
#include "handway/device/glove/glove_layout.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace handway::device {

/// Counts of an emulated glove's sensors at a time: s, never falling from call to call.
using GloveSignal = std::function<std::array<std::uint16_t, kGloveSensors>(double time)>;

/// Properties of an emulated CyberGlove interface unit.
struct CyberGloveUnitSettings {
  int sensors = kGloveSensors;  ///< 18 or 22.
  bool right_hand = true;
  double rate = 100.0;      ///< Until the host sets another, Hz.
  double top_rate = 480.0;  ///< Faster is refused with "es"; the limit of 115200 bit/s.
};

/// The interface unit of an emulated CyberGlove, in binary and in ASCII commands.
class HANDWAY_DEVICE_EXPORT CyberGloveUnit final : public DeviceUnit {
 public:
  /// @throws std::invalid_argument unless it has 18 or 22 sensors, and a rate above 0.
  CyberGloveUnit(const CyberGloveUnitSettings& settings, GloveSignal signal);

  [[nodiscard]] Bytes receive(std::span<const std::uint8_t> bytes, double now) override;
  [[nodiscard]] std::vector<Bytes> advance(double now) override;
  [[nodiscard]] std::optional<double> next_due() const override;
  /// Unplugs the glove from the unit, or plugs it in again.
  void set_plugged(bool plugged) override { plugged_ = plugged; }

  [[nodiscard]] bool streaming() const { return streaming_.has_value(); }

 private:
  enum class Form { kBinary, kText };

  void reset_registers();
  void take(std::uint8_t byte, double now, Bytes& out);
  void take_binary(double now, Bytes& out);
  void take_text(double now, Bytes& out);
  void query(char letter, Form form, Bytes& out) const;
  void set(char letter, const Bytes& arguments, Form form, Bytes& out);
  void begin_stream(Form form, double now);
  [[nodiscard]] double period() const;
  [[nodiscard]] Bytes record(Form form, char letter, double time) const;
  [[nodiscard]] Bytes query_data(char letter) const;

  CyberGloveUnitSettings settings_;
  GloveSignal signal_;
  std::map<char, Bytes> registers_;
  Bytes command_;  ///< Taken so far, incomplete.
  double command_time_ = 0.0;
  std::optional<Form> streaming_;
  double next_record_ = 0.0;
  std::optional<double> restarted_at_;  ///< Ignores input until then.
  bool plugged_ = true;
};

/// An emulated CyberGlove III on USB, in its native stream (see CyberGlove3Parser): 90 records a
/// second after "1eu" and "1S", until 03 or "!!!". It sends no answers, as none are documented.
class HANDWAY_DEVICE_EXPORT CyberGlove3Unit final : public DeviceUnit {
 public:
  explicit CyberGlove3Unit(GloveSignal signal) : signal_(std::move(signal)) {}

  [[nodiscard]] Bytes receive(std::span<const std::uint8_t> bytes, double now) override;
  [[nodiscard]] std::vector<Bytes> advance(double now) override;
  [[nodiscard]] std::optional<double> next_due() const override;
  /// Sets whether the sensor is plugged in; unplugged, it sends nothing.
  void set_plugged(bool plugged) override { plugged_ = plugged; }

 private:
  void take_command(double now);
  [[nodiscard]] Bytes record(double time);

  GloveSignal signal_;
  std::string command_;  ///< Taken so far, incomplete.
  bool usb_ = false;
  bool plugged_ = true;
  std::optional<double> next_record_;  ///< While it streams.
};

/// A CyberGlove on a port.
struct GloveEmulatorSettings : DeviceEmulatorSettings {
  CyberGloveUnitSettings unit;
};

/// An emulated CyberGlove that programs can't distinguish from hardware: its interface unit on a
/// pseudo-terminal or a TCP port, run by a thread of its own. One host at a time; over TCP a new
/// connection replaces the last, as with serial-to-network converters.
class HANDWAY_DEVICE_EXPORT GloveEmulator {
 public:
  /// Opens the port and starts.
  /// @throws DeviceError if the port is taken or not allowed; std::invalid_argument for invalid
  /// settings.
  GloveEmulator(const GloveEmulatorSettings& settings, GloveSignal signal);

  /// Address for a driver: "/dev/pts/4" or "localhost:5555".
  [[nodiscard]] const std::string& address() const { return emulator_.address(); }

  /// Unplugs the glove from its unit, or plugs it in again.
  void set_plugged(bool plugged) { emulator_.set_plugged(plugged); }

  /// Number of records sent, lost and damaged ones included.
  [[nodiscard]] std::uint64_t records() const { return emulator_.records(); }
  /// Number of records lost or damaged.
  [[nodiscard]] std::uint64_t faults() const { return emulator_.faults(); }

 private:
  DeviceEmulator emulator_;
};

}  // namespace handway::device
