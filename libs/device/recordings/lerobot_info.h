#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace handway::device {

/// A feature of a LeRobot data set: a column of its tables, or a film beside them.
struct LeRobotFeature {
  std::string name;                ///< "observation.state".
  std::string type;                ///< "float32", "image", "video", "string".
  std::vector<std::size_t> shape;  ///< Sizes of one frame.
  std::vector<std::string> names;  ///< Names of the numbers of a frame; may be empty.

  /// Numbers of a frame.
  [[nodiscard]] std::size_t width() const;
  /// Returns whether frames are numbers, not pictures or texts.
  [[nodiscard]] bool has_numbers() const;
};

/// The file meta/info.json of a LeRobot data set.
struct LeRobotInfo {
  double rate = 0.0;  ///< Frames per second; 0: unknown.
  std::vector<LeRobotFeature> features;

  /// Returns the feature of that name; nullptr if there is none.
  [[nodiscard]] const LeRobotFeature* find(std::string_view name) const;
};

/// Reads a file meta/info.json of version 2 or 3. Names of a feature are a list, an object of
/// lists ({"motors": [...]}), or an object of indices ({"x": 0, "y": 1}).
/// @throws InputError if it is missing or is not such a file.
[[nodiscard]] LeRobotInfo read_lerobot_info(const std::filesystem::path& file);

}  // namespace handway::device
