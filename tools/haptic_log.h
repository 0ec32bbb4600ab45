#pragma once

#include "handway/execution/guidance/guidance_run.h"
#include "handway/geometric/robot/robot_model.h"

#include <filesystem>
#include <fstream>

namespace handway::tools {

/// A guidance as CSV, a row for each sample of the device: `time` (s), `progress` (m of the tool's
/// way), `place` (a waypoint's index with the share of the way to the next), `button`,
/// `deviation` (m of the hand), `force.x`, `force.y`, `force.z` (N, in the device's frame), then
/// the robot's joints as they were led (rad). Rows are written as they come.
class HapticLog {
 public:
  /// @param file empty: nothing is written. @throws InputError if it can't be written.
  HapticLog(const std::filesystem::path& file, const geometric::RobotModel& model);

  void add(const execution::GuidanceSample& sample);
  /// False if a row could not be written.
  [[nodiscard]] bool good() const { return !out_.is_open() || out_.good(); }

 private:
  std::ofstream out_;
};

}  // namespace handway::tools
