#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/planning/export.h"
#include "handway/planning/timing/time_path.h"
#include "handway/planning/timing/timing_settings.h"

#include <filesystem>
#include <optional>
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
  /// Number of the controller's digital output that closes the hand when it is on. Programs for an
  /// arm set it in stages that close or open the hand; formats without outputs ignore it. Without a
  /// number the hand is driven by another controller.
  std::optional<int> gripper_output = {};
  double gripper_time = 0.5;  ///< s, least wait after the output is set.
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
  /// Returns the time between points that the program needs, s; 0: any. The motion has to be timed
  /// with this period.
  [[nodiscard]] virtual double point_period() const { return 0.0; }
  /// Returns the settings with which a motion for the format is timed: without arcs if it stops at
  /// waypoints, and with the period that it needs.
  [[nodiscard]] TimingSettings settings_for(TimingSettings settings) const;
  /// Robots that the format is for, if the motion's robot seems to be another one; else empty.
  [[nodiscard]] virtual std::string robot_objection(const Motion& /*motion*/) const { return {}; }
  /// Reason why the format can't set an output of a program; empty if it can.
  [[nodiscard]] virtual std::string output_objection(
      const geometric::OutputStep& /*output*/) const {
    return "the format has no outputs";
  }
  /// Returns warnings about parts of a motion that the files lack, a sentence each: the outputs
  /// with an output_objection().
  [[nodiscard]] std::vector<std::string> warnings(const Motion& motion) const;

  /// Makes the files for a motion without writing them.
  /// @throws InputError naming joint, time and value if the motion can't run (see
  /// check_trajectory()), or the data that the format needs and the motion lacks, the right robot
  /// and period included.
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
  [[nodiscard]] virtual std::vector<ExportedFile> do_export(const Motion& motion,
                                                            const ExportOptions& options) const = 0;
};

/// Writes each file as a whole; creates missing folders.
/// @returns the files written. @throws InputError for a file that can't be written.
HANDWAY_PLANNING_EXPORT std::vector<std::filesystem::path> write_files(
    const std::vector<ExportedFile>& files, const std::filesystem::path& folder);

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
