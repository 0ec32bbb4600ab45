#pragma once

#include "handway/device/export.h"
#include "handway/device/recordings/recorded_table.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

/// Data sets of LeRobot, version 3.

namespace handway::device {

/// A feature of the frames: columns of the tables.
struct LeRobotColumns {
  std::string feature;               ///< "observation.environment_state".
  std::vector<std::string> columns;  ///< Their names in the tables; at least one.
  bool is_integer = false;           ///< True: int64, else float32.
};

/// Contents of a data set.
struct LeRobotLayout {
  std::string robot;                   ///< Kind of the robot.
  int fps = 50;                        ///< Frames per second, above 0.
  std::vector<std::string> joints;     ///< Columns of `observation.state` and `action`.
  std::vector<LeRobotColumns> others;  ///< Further features.
};

/// Writes a data set of LeRobot, version 3, without pictures: meta/info.json, meta/stats.json,
/// meta/tasks.parquet, meta/episodes/ and data/. The action of a frame is the state of the next
/// one, in the last frame of an episode its own. Features `timestamp`, `frame_index`,
/// `episode_index`, `index` and `task_index` are added. Same episodes, same bytes. Source: LeRobot
/// 0.4, CODEBASE_VERSION v3.0; Apache Parquet, parquet-format 2.11.
class HANDWAY_DEVICE_EXPORT LeRobotWriter {
 public:
  /// Removes the tables and meta/info.json of an earlier data set from the folder.
  /// @throws geometric::OutputError if they can't be removed, or folders not be made.
  LeRobotWriter(std::filesystem::path folder, LeRobotLayout layout);
  ~LeRobotWriter();
  LeRobotWriter(const LeRobotWriter&) = delete;
  LeRobotWriter& operator=(const LeRobotWriter&) = delete;

  /// Adds an episode.
  /// @param episode with the columns of the layout, and a row for each frame.
  /// @param task what is done, a text. @param source of the episode, for messages.
  /// @throws geometric::InputError if it lacks a column, has no row, or times that do not fit the
  /// frames per second; OutputError if a file can't be written.
  void add(const RecordedTable& episode, const std::string& task, const std::string& source);

  /// Writes the rest. @pre there is an episode. @throws geometric::OutputError
  void finish();

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace handway::device
