#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove_layout.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

/// Postures for the guided calibration of a glove, as YAML:
///
///     poses:
///       - name: flat
///         instruction: "Lay the hand flat on a table."
///         degrees: {IndexMPJ: 0, IndexPIJ: 0}
///       - name: motion
///         motion: 10                # s: the hand moves, and shows how far its joints go
///         instruction: "Open the hand and make a fist, some times."
///         degrees: {IndexMPJ: 75}   # for the picture

namespace handway::device {

/// Instruction to take a posture, with its angles.
struct PoseInstruction {
  std::string name;
  std::string instruction;                   ///< One sentence; may be empty.
  std::array<double, kGloveSensors> angles;  ///< rad; NaN for sensors that the pose leaves open.
  double motion = 0.0;                       ///< s that the hand moves; 0: it is held.
};

/// @throws geometric::InputError with file, line and key for an unknown sensor, a name twice, no
/// poses, or a pose without angles.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::vector<PoseInstruction> read_guided_poses(
    const std::filesystem::path& file);

}  // namespace handway::device
