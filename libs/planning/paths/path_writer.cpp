#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/table_text.h"
#include "handway/planning/core/objective.h"
#include "handway/planning/paths/path_file.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>

namespace handway::planning {

using geometric::RobotModel;

std::string csv_time(double time) {
  constexpr double kPerSecond = 1e9;
  return fmt::format("{}", std::round(time * kPerSecond) / kPerSecond);
}

std::string to_csv(const Path& path, const RobotModel& model) {
  std::string text = "time";
  for (int i = 1; i < model.link_count(); ++i) {
    if (model.mimic_mapping(i).variable >= 0) {
      text.append(",").append(geometric::csv_cell(model.joint(i).name));
    }
  }
  double time = 0.0;
  for (std::size_t w = 0; w < path.waypoints.size(); ++w) {
    if (w > 0) {
      time += least_duration(model, path.waypoints[w - 1], path.waypoints[w]);
    }
    text += '\n';
    text += csv_time(time);
    for (const geometric::JointValue& joint : geometric::joint_values(model, path.waypoints[w])) {
      text += fmt::format(",{}", joint.value);
    }
  }
  return text + "\n";
}

void write_path_csv(const Path& path, const RobotModel& model, const std::filesystem::path& file) {
  geometric::replace_file(file, to_csv(path, model));
}

}  // namespace handway::planning
