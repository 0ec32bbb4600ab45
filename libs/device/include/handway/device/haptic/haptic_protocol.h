#pragma once

#include "handway/device/core/line_protocol.h"
#include "handway/device/export.h"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <string_view>

/// @file
/// Handway's own protocol for haptic devices, version 1. Makers' devices are driven by makers'
/// libraries: a program beside the library has to implement this one.
///
/// Lines of ASCII words over TCP, each ended by a line feed. Metres, newtons, seconds, in the
/// device's own frame (right-handed, origin in the middle of its workspace).
///
///     host             device
///     hello 1          hello 1 FORCE X Y Z    strongest force; half of its workspace's edges
///                      state T X Y Z VX VY VZ BUTTON   every 1 to 10 ms; BUTTON 0 or 1
///     force FX FY FZ   (none)                 the answer to a state
///                      fault REASON           it gives no force any more
///
/// The device gives no force before the first "force", after 0.05 s without one, when the
/// connection breaks, and never more than FORCE.
namespace handway::device {

/// Default TCP port of a haptic device's server.
inline constexpr std::uint16_t kHapticPort = 11200;
/// Version of the protocol that both sides report.
inline constexpr int kHapticProtocolVersion = 1;
inline constexpr double kHapticLongestSilence = 0.05;  ///< s without "force"

/// Abilities of a device.
struct HapticAbilities {
  double force = 0.0;                                   ///< Strongest, N.
  Eigen::Vector3d workspace = Eigen::Vector3d::Zero();  ///< From the middle to its faces, m.
};

/// State of the handle.
struct HapticSample {
  double time = 0.0;                                   ///< s, on the device's clock.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s
  bool button = false;

  bool operator==(const HapticSample&) const = default;
};

/// Formats the line "hello …", with its line feed.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string hello_line(const HapticAbilities& abilities);
/// Formats the line "state …", with its line feed.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string state_line(const HapticSample& sample);
/// Formats the line "force …", with its line feed.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string force_line(const Eigen::Vector3d& force);

/// Reads the line "hello …".
/// @param line without its line feed.
/// @throws LineProtocolError for another line, or invalid numbers.
[[nodiscard]] HANDWAY_DEVICE_EXPORT HapticAbilities parse_haptic_hello(std::string_view line);
/// Reads the line "state …", as parse_haptic_hello().
[[nodiscard]] HANDWAY_DEVICE_EXPORT HapticSample parse_haptic_state(std::string_view line);
/// Reads the line "force …", as parse_haptic_hello().
[[nodiscard]] HANDWAY_DEVICE_EXPORT Eigen::Vector3d parse_haptic_force(std::string_view line);

}  // namespace handway::device
