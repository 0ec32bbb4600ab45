#pragma once

#include "handway/device/glove/mano_hand.h"
#include "handway/device/glove/recording.h"
#include "handway/geometric/io/table_times.h"
#include "recordings/array_file.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

/// Recordings of the parameters of MANO, as data sets and trackers of hands write them.

namespace handway::device {

/// A posture in one frame.
struct ManoFrame {
  std::optional<double> time;  ///< Time in the file's unit.
  ManoPose pose;               ///< NaN: missing.
};

/// A hand by the names in a file.
enum class ManoSide { kUnnamed, kLeft, kRight };

/// Returns the side that a name names: "left_hand_pose", "right/pose", "rhand_pose".
[[nodiscard]] ManoSide side_in_name(std::string_view name);

/// Returns whether a variable, a key or a column is called like parameters of MANO: "hand_pose",
/// "mano_pose", "poses", "fullpose", "theta".
[[nodiscard]] bool is_mano_name(std::string_view name);

/// Returns whether that many numbers are a posture: 45, or 48 with the orientation of the wrist
/// first.
[[nodiscard]] bool is_mano_count(std::size_t count);

/// Returns the posture of 45 or 48 numbers.
[[nodiscard]] ManoPose mano_pose(std::span<const double> numbers);

/// Makes a recording of the angles between the landmarks of the postures.
/// @param side unnamed: that for which the fingers bend towards the palm; a warning reports it.
/// @param rest joints of the person's hand; nothing: usual_mano_joints().
/// @throws InputError if no frame is complete, or a rotation is no angle in rad.
[[nodiscard]] Recording recording_of_mano(const std::filesystem::path& file,
                                          const std::vector<ManoFrame>& frames, ManoSide side,
                                          const std::optional<ManoJoints>& rest = {},
                                          const geometric::TimeUnit& time_unit = {});

/// Returns whether a variable has parameters of MANO by its name and its shape: n x 45, n x 48,
/// n x 15 x 3, n x 16 x 3, or n x 15 x 3 x 3 and n x 16 x 3 x 3 of rotation matrices; or
/// coefficients of the model's principal components.
[[nodiscard]] bool has_mano_poses(const ArrayFile& arrays, const RecordingVariable& variable);

/// Makes a recording of such a variable. Arrays of the model in the same file are used, if they are
/// there: `hands_mean` and `hands_components`, as in the model's own file, and `J`, its joints.
/// @throws InputError as recording_of_mano(); or if coefficients have no components.
[[nodiscard]] Recording recording_of_mano(const ArrayFile& arrays, const Series& series);

}  // namespace handway::device
