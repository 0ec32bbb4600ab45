#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/planning/export.h"
#include "handway/planning/timing/time_path.h"

#include <filesystem>
#include <string>
#include <vector>

namespace handway::planning {

/// A file made by an exporter.
struct ExportedFile {
  std::filesystem::path name;  ///< Relative to the destination folder.
  std::string content;
};

/// Options of exporting a motion.
struct ExportOptions {
  /// Export in spite of robot_objection().
  bool any_robot = false;
};

/// Writes motions in the format of a controller or another program.
///
/// The public functions check; derived classes make the files' contents.
class HANDWAY_PLANNING_EXPORT Exporter {
 public:
  virtual ~Exporter() = default;
  /// Its word on the command line: "csv".
  [[nodiscard]] virtual std::string name() const = 0;
  /// One line for display.
  [[nodiscard]] virtual std::string description() const = 0;
  /// Returns whether the program that executes the files stops at every waypoint, so that the
  /// motion has to be timed without arcs.
  [[nodiscard]] virtual bool stops_at_waypoints() const { return false; }
  /// Robots that the format is for, if the motion's robot seems to be another one; else empty.
  [[nodiscard]] virtual std::string robot_objection(const Motion& /*motion*/) const { return {}; }

  /// Makes the files for a motion without writing them.
  /// @throws InputError naming joint, time and value if the motion can't run (see
  /// check_trajectory()), or the data that the format needs and the motion lacks, the right robot
  /// included.
  [[nodiscard]] std::vector<ExportedFile> files(const Motion& motion,
                                                const ExportOptions& options = {}) const;

  /// Makes all files first, then writes each as a whole; creates a missing `folder`.
  /// @returns the files written.
  /// @throws InputError as files(), or if a file can't be written.
  [[nodiscard]] std::vector<std::filesystem::path> write(const Motion& motion,
                                                         const std::filesystem::path& folder,
                                                         const ExportOptions& options = {}) const;

 protected:
  /// The derived class's files; the motion is checked.
  [[nodiscard]] virtual std::vector<ExportedFile> do_export(const Motion& motion) const = 0;
};

/// Throws the errors of Exporter::files() for a motion that no format can hold.
HANDWAY_PLANNING_EXPORT void check_motion(const Motion& motion);

/// Writes scenes in the format of another program.
///
/// The public function checks; derived classes write.
class HANDWAY_PLANNING_EXPORT SceneExporter {
 public:
  virtual ~SceneExporter() = default;
  /// Its word on the command line: "gltf".
  [[nodiscard]] virtual std::string name() const = 0;
  /// One line for display.
  [[nodiscard]] virtual std::string description() const = 0;

  /// Writes the scene into `folder`, which is created if missing; each file is replaced whole.
  /// @returns the files written.
  /// @throws InputError for a scene without a robot, contents that the format can't hold, or a file
  /// that can't be written.
  [[nodiscard]] std::vector<std::filesystem::path> write(const geometric::Scene& scene,
                                                         const std::filesystem::path& folder) const;

 protected:
  /// The derived class's writer. @param stem for names of files: that of the scene's file, or of
  /// its name.
  [[nodiscard]] virtual std::vector<std::filesystem::path> do_write(
      const geometric::Scene& scene, const std::filesystem::path& folder,
      const std::string& stem) const = 0;
};

}  // namespace handway::planning
