#pragma once

#include "handway/device/core/joint_trajectory.h"
#include "handway/device/core/line_protocol.h"
#include "handway/device/export.h"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <string_view>

/// @file
/// Handway's own protocol for a hand, version 1. The SAH's control board is driven by its maker's
/// library and has no public protocol on a wire: a program beside that library has to implement
/// this one.
///
/// Lines of ASCII words over TCP, each ended by a line feed. Angles in rad, times in s.
///
///     host                                hand
///     hello 1                             hello 1 JOINTS
///     trajectory N, then N times          ok trajectory
///       point T Q1 … QJOINTS
///     start                               ok start
///     pause T    (hold at T, not before)  ok pause
///     resume                              ok resume
///     stop                                ok stop
///     alive      (at least every 0.1 s)
///
/// Instead of "ok WORD" the hand may answer "error WORD" and a reason. From "hello" on it reports
/// "state T PHASE Q1 … QJOINTS" every 10 ms: T of the motion's time, PHASE one of `idle ready
/// running paused done stopped error`; after `error` comes a line "fault" and a reason. While it
/// moves, it stops after 0.25 s without a message, or if the connection breaks.
namespace handway::device {

/// Default TCP port of a hand's controller.
inline constexpr std::uint16_t kHandPort = 11100;
/// Version of the protocol that both sides report.
inline constexpr int kHandProtocolVersion = 1;
inline constexpr double kHandStatePeriod = 0.01;     ///< s
inline constexpr double kHandAlivePeriod = 0.1;      ///< s
inline constexpr double kHandLongestSilence = 0.25;  ///< s

/// "state …" as a value.
struct HandState {
  double time = 0.0;  ///< s of the motion's time.
  std::string phase;
  Eigen::VectorXd position;  ///< rad

  bool operator==(const HandState&) const = default;
};

/// Formats a state as a line of the protocol, with its line feed.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string to_line(const HandState& state);
/// @param line without its line feed. @throws LineProtocolError
[[nodiscard]] HANDWAY_DEVICE_EXPORT HandState parse_hand_state(std::string_view line,
                                                               Eigen::Index joints);

/// "trajectory N" and its points, as the lines of a host.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string to_lines(const JointTrajectory& trajectory);

}  // namespace handway::device
