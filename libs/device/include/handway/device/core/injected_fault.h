#pragma once

namespace handway::device {

/// What an emulated controller does wrong, once, to order.
enum class FaultKind {
  kNone,
  kLate,        ///< All that it sends comes 0.6 s late.
  kLost,        ///< The connection breaks.
  kRefused,     ///< It refuses commands.
  kEstop,       ///< Somebody presses the emergency stop.
  kJointLimit,  ///< A joint's range ends where the joint is.
  kSlow,        ///< It moves at half the pace: the monitor speed is at 50 %.
  // Lies: it goes on accepting, and reports what is not so.
  kTimeBack,  ///< Its clock runs back by 10 s. An arm's protocol has no clock.
  kTimeJump,  ///< Its clock jumps ahead by 1e9 s.
  kPhases,    ///< The phase or status that it reports changes with every message.
  kIdle,      ///< It stands still, and says at the end that it is done.
  kDance,     ///< The joints that it reports swing about where they are.
};

struct InjectedFault {
  FaultKind kind = FaultKind::kNone;
  double after = 0.0;  ///< s from the beginning of a motion.
};

}  // namespace handway::device
