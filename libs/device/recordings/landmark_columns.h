#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace handway::device {

/// A column (from 0) for each coordinate: x, y and z of the wrist, then of the next landmark.
using LandmarkColumns = std::array<std::size_t, 63>;

/// The columns of 21 landmarks by the names of a header ("x0", "12_y", "INDEX_FINGER_TIP_z",
/// "landmark_3_x"); of two hands those of the first. Nothing if some are missing.
[[nodiscard]] std::optional<LandmarkColumns> landmark_columns(
    const std::vector<std::string>& names);

}  // namespace handway::device
