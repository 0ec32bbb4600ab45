#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_model.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace handway::geometric {

/// Reader of robots in another format than URDF; provided by plugins.
struct RobotReader {
  std::string name;  ///< "an SDF model (.sdf)"
  /// Tests the name and the first bytes; must not throw on any readable file.
  std::function<bool(const std::filesystem::path&)> can_read;
  /// @throws InputError naming file, element, the value found and the expected one.
  std::function<RobotDescription(const std::filesystem::path&)> read;
};

/// Registers a format, which load_robot() reads from now on. May be called from any thread.
HANDWAY_GEOMETRIC_EXPORT void register_robot_reader(RobotReader reader);

/// Returns whether load_robot() reads the file: URDF, xacro, or a format that is registered.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool is_robot_file(const std::filesystem::path& file);

/// Reads a robot file (`.urdf`, with the `.srdf` beside it) and makes the model. A `.xacro` file is
/// first turned into URDF by the program `xacro`. The SRDF of its name (`x.srdf` for
/// `x.urdf.xacro`) is read as well; so are SRDFs of files of other formats. If no SRDF disables any
/// collision, adjacent links and links that overlap (sample_overlapping_links()) are allowed to
/// touch. A missing group "arm" or "hand" is taken from propose_groups(). The description has a
/// warning about both for robots without an SRDF.
/// @param arguments of a xacro file. Those of $HANDWAY_XACRO come first.
/// @throws InputError if the file can't be read, has no valid robot or does not take the arguments.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::shared_ptr<const RobotModel> load_robot(
    const std::filesystem::path& file, const XacroArguments& arguments = {});

}  // namespace handway::geometric
