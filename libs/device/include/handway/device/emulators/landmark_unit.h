#pragma once

#include "handway/device/emulators/device_emulator.h"
#include "handway/device/export.h"
#include "handway/device/glove/glove.h"
#include "handway/device/glove/hand_message.h"
#include "handway/device/glove/recording.h"

#include <cstdint>
#include <functional>
#include <memory>

namespace handway::device {

/// Angles of a hand over time (s, never falling).
using HandSignal = std::function<GloveAngles(double time)>;

/// Repeats a recording forever. @throws geometric::InputError if it holds counts.
[[nodiscard]] HANDWAY_DEVICE_EXPORT HandSignal recorded_hand(const Recording& recording);

/// Properties of an emulated sender of a hand.
struct LandmarkUnitSettings {
  HandWire wire = HandWire::kLandmarks;  ///< Format of its messages.
  double rate = 30.0;                    ///< Messages a second, Hz.
  bool left = false;                     ///< A left hand.
  bool wrong_label =
      false;           ///< Lines name the other hand, as senders do that see a mirrored picture.
  double noise = 0.0;  ///< Standard deviation of each coordinate, m.
  std::uint64_t seed = 1;
};

/// Makes a unit that sends a hand that moves as `signal` and rotates before a camera; unplugged, it
/// sends no hand. Angles of Manus have neither noise nor a pose. The unit ignores input.
/// @throws std::invalid_argument for a rate that is not positive.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::unique_ptr<DeviceUnit> make_landmark_unit(
    const LandmarkUnitSettings& settings, HandSignal signal);

}  // namespace handway::device
