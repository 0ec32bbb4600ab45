#include "dataset_lerobot.h"

#include "handway/device/recordings/lerobot_writer.h"
#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <vector>

namespace handway::tools {
namespace {

using EntryJson = nlohmann::ordered_json;

constexpr const char* kStageColumn = "stage";

// Joints come first in the tables, then the pose of the palm.
device::LeRobotLayout layout_of(const device::RecordedTable& table, const std::string& robot,
                                int fps) {
  device::LeRobotLayout layout;
  layout.robot = robot;
  layout.fps = fps;
  const auto palm = std::ranges::find(table.names, "palm.x");
  layout.joints.assign(table.names.begin(), palm);
  device::LeRobotColumns poses{"observation.environment_state", {}, false};
  std::copy_if(palm, table.names.end(), std::back_inserter(poses.columns),
               [](const std::string& name) { return name != kStageColumn; });
  layout.others = {poses, {kStageColumn, {kStageColumn}, true}};
  return layout;
}

// The text of an episode's task: its own, or that of all.
std::string task_text(const EntryJson& settings, const EntryJson& entry) {
  const EntryJson& steps = entry.contains("steps") ? entry["steps"] : settings["steps"];
  std::string text;
  for (const EntryJson& step : steps) {
    text.append(text.empty() ? "" : ", ").append(step.get<std::string>());
  }
  return text;
}

}  // namespace

int frames_per_second(double period) {
  constexpr double kRounding = 1e-6;
  const double rate = 1.0 / period;
  if (std::abs(rate - std::round(rate)) > kRounding * rate) {
    throw geometric::InputError({"--period-ms", "", fmt::format("{:g} frames per second", rate),
                                 "a whole number of frames per second, as LeRobot needs it",
                                 "Choose a period such as 20 or 40 ms"});
  }
  return static_cast<int>(std::lround(rate));
}

void write_lerobot_dataset(const std::filesystem::path& folder, const EntryJson& settings,
                           const std::map<int, EntryJson>& entries, int fps) {
  std::unique_ptr<device::LeRobotWriter> writer;
  for (const auto& [index, entry] : entries) {
    if (!entry.value("solved", false)) {
      continue;
    }
    const std::filesystem::path file = folder / entry.value("file", std::string());
    const device::RecordedTable table = device::read_recorded_table(file);
    if (!writer) {
      writer = std::make_unique<device::LeRobotWriter>(
          folder, layout_of(table, settings["robot"].get<std::string>(), fps));
    }
    writer->add(table, task_text(settings, entry), file.string());
  }
  if (writer) {
    writer->finish();
  }
}

}  // namespace handway::tools
