#pragma once

namespace handway::device {

/// Fault that an emulated controller injects once.
enum class FaultKind {
  kNone,
  kLate,        ///< All messages come 0.6 s late.
  kLost,        ///< The connection breaks.
  kRefused,     ///< It refuses commands.
  kEstop,       ///< The emergency stop is pressed.
  kJointLimit,  ///< A joint's range ends at its position.
  kSlow,        ///< It moves at half the pace: the monitor speed is at 50 %.
};

/// A fault of an emulated robot and the time at which it occurs.
struct InjectedFault {
  FaultKind kind = FaultKind::kNone;
  double after = 0.0;  ///< s from the beginning of a motion.
};

}  // namespace handway::device
