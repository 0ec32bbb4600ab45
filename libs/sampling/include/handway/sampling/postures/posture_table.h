#pragma once

#include "handway/sampling/export.h"

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

namespace handway::sampling {

/// Postures that a hand was seen to take.
struct PostureTable {
  std::string hand;                 ///< Robot that the joints belong to.
  std::string source;               ///< Where the postures come from.
  std::vector<std::string> joints;  ///< Of the columns.
  Eigen::MatrixXd postures;         ///< Normalised joints, shape [postures, joints].
};

/// Posture tables as CSV files: lines that begin with `#` say what the rows are, then comes a
/// header and a row for each posture, joints normalised to [0, 1].
///
///     # handway postures 1
///     # hand: sah_right
///     # source: where the postures come from
///     thumb_base,thumb_abduction,…
///     0.5561,0.5561,…
///
/// @throws geometric::InputError with file, line and what is wrong with it: no such file, another
/// first line, no hand, no header or a joint twice in it, a row of another length, a value that
/// is no number within 1e-6 of [0, 1], no rows.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT PostureTable read_postures(const std::filesystem::path& file);

/// Replaces the file whole. Values are rounded to four decimals, a hundredth of a degree for a
/// joint that turns by 100°.
/// @throws geometric::InputError if the file can't be written.
/// @throws std::invalid_argument unless there is a name for every column.
HANDWAY_SAMPLING_EXPORT void write_postures(const PostureTable& table,
                                            const std::filesystem::path& file);

}  // namespace handway::sampling
