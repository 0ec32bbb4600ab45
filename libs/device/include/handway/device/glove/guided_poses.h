#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove_frame.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

/// Postures that a person is asked to take while a glove is calibrated, as YAML:
///
///     poses:
///       - name: flat
///         instruction: "Lay the hand flat on a table."
///         degrees: {IndexMPJ: 0, IndexPIJ: 0}
namespace handway::device {

/// What to ask for, and the angles that follow.
struct PoseInstruction {
  std::string name;
  std::string instruction;                   ///< One sentence; may be empty.
  std::array<double, kGloveSensors> angles;  ///< rad; NaN for sensors that the pose leaves open.
};

/// @throws geometric::InputError with file, line and key for an unknown sensor, a name twice, no
/// poses, or a pose without angles.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::vector<PoseInstruction> read_guided_poses(
    const std::filesystem::path& file);

}  // namespace handway::device
