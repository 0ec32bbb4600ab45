#include "handway/planning/extensions/exporter.h"

#include "handway/geometric/formats/obj_writer.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/robot/limit_violation.h"
#include "handway/planning/timing/trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>
#include <vector>

namespace handway::planning {
namespace {

using geometric::InputError;

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw geometric::OutputError(
        {folder.string(), "", error.message(), "a folder to write to", ""});
  }
}

void check_limits(const Motion& motion) {
  const Eigen::Index count = motion.model->variable_count();
  for (const Eigen::VectorXd* limits : {&motion.limits.velocity, &motion.limits.acceleration}) {
    if (limits->size() != count || !limits->allFinite() || !(limits->array() > 0.0).all()) {
      throw InputError({"the motion", "limits", "invalid limits",
                        fmt::format("{} finite numbers above 0", count), ""});
    }
  }
  if (!(motion.speed > 0.0 && motion.speed <= 1.0)) {
    throw InputError(
        {"the motion", "speed", fmt::format("{}", motion.speed), "above 0, at most 1", ""});
  }
}

// Returns the joints outside of arm and hand that the path does not move.
std::vector<int> resting_joints(const Motion& motion) {
  std::vector<int> fixed;
  const auto& waypoints = motion.path.waypoints;
  for (int v = 0; v < motion.model->variable_count(); ++v) {
    if (std::ranges::count(motion.arm, v) + std::ranges::count(motion.hand, v) == 0 &&
        std::ranges::all_of(waypoints, [&](const geometric::Configuration& q) {
          return v < q.size() && q[v] == waypoints.front()[v];
        })) {
      fixed.push_back(v);
    }
  }
  return fixed;
}

void check_waypoints(const Motion& motion, const std::vector<int>& fixed) {
  const geometric::RobotModel& model = *motion.model;
  if (motion.path.waypoints.size() < 2 ||
      motion.waypoint_times.size() != motion.path.waypoints.size()) {
    throw InputError({"the motion", "",
                      fmt::format("{} waypoints with {} times", motion.path.waypoints.size(),
                                  motion.waypoint_times.size()),
                      "at least two, each with its time", ""});
  }
  for (std::size_t w = 0; w < motion.path.waypoints.size(); ++w) {
    const geometric::Configuration& q = motion.path.waypoints[w];
    const double time = motion.waypoint_times[w];
    const std::string source = fmt::format("waypoint {} at {:.4f} s", w + 1, time);
    if (!std::isfinite(time) || (w > 0 && time < motion.waypoint_times[w - 1])) {
      throw InputError({source, "time", fmt::format("{}", time), "times in order", ""});
    }
    geometric::require_configuration(model, q, source, fixed);
  }
}

void check_groups(const Motion& motion) {
  for (const std::vector<int>* group : {&motion.arm, &motion.hand}) {
    for (const int variable : *group) {
      if (variable < 0 || variable >= motion.model->variable_count()) {
        throw InputError({"the motion", "", fmt::format("variable {}", variable),
                          "a variable of the robot", ""});
      }
    }
  }
}

// Refuses a motion whose points are not `period` (s) apart; the last step may be shorter.
void check_period(const Motion& motion, double period, const std::string& format) {
  const auto& points = motion.trajectory.points;
  constexpr double kTolerance = 1e-9;  // s
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double step = points[i].time - points[i - 1].time;
    const bool rests = points[i].position == points[i - 1].position &&
                       points[i].velocity.isZero() && points[i - 1].velocity.isZero();
    if (rests && step > period) {
      continue;  // a stage that waits
    }
    const bool is_last = i + 1 == points.size();
    if (step > period + kTolerance || (!is_last && step < period - kTolerance)) {
      throw InputError({"the motion", "period", fmt::format("points {:g} ms apart", 1e3 * step),
                        fmt::format("points every {:g} ms for {}", 1e3 * period, format),
                        fmt::format("Time it with --period-ms {:g}", 1e3 * period)});
    }
  }
}

void check_stages(const Motion& motion) {
  for (std::size_t i = 0; i < motion.stages.size(); ++i) {
    const std::size_t first = motion.stages[i].first;
    const bool in_order = i == 0 ? first == 0 : first >= motion.stages[i - 1].first;
    if (!in_order || first >= motion.path.waypoints.size()) {
      throw InputError({"the motion", "stage " + motion.stages[i].name,
                        fmt::format("waypoint {}", first + 1), "waypoints in order from the first",
                        ""});
    }
  }
}

}  // namespace

void check_motion(const Motion& motion) {
  if (motion_name(motion.name) != motion.name) {
    throw InputError({"the motion", "name", "\"" + motion.name + "\"",
                      "letters, digits and \"_\", the first a letter", ""});
  }
  if (!motion.model) {
    throw InputError({"the motion", "", "no robot", "one", ""});
  }
  check_limits(motion);
  check_groups(motion);
  const std::vector<int> fixed = resting_joints(motion);
  check_waypoints(motion, fixed);
  check_stages(motion);
  const auto faults = check_trajectory(*motion.model, motion.trajectory, motion.limits, fixed);
  if (!faults.empty()) {
    throw InputError({"the motion", "", faults.front().text,
                      "a motion that keeps the robot's limits",
                      faults.size() == 1 ? "" : fmt::format("{} more faults", faults.size() - 1)});
  }
}

std::vector<ExportedFile> Exporter::files(const Motion& motion,
                                          const ExportOptions& options) const {
  check_motion(motion);
  if (const std::string expected = robot_objection(motion);
      !expected.empty() && !options.any_robot) {
    throw InputError(
        {"robot " + motion.model->name(), "",
         fmt::format("a robot that does not seem to suit {}", name()), expected,
         "If it does, export with --any-robot, or with \"Any robot\" in the workbench"});
  }
  if (const double period = point_period(); period > 0.0) {
    check_period(motion, period, name());
  }
  return do_export(motion, options);
}

std::vector<std::string> Exporter::warnings(const Motion& motion) const {
  std::vector<std::string> warnings;
  for (const geometric::OutputStep& output : outputs_of(motion)) {
    if (const std::string objection = output_objection(output); !objection.empty()) {
      warnings.push_back(fmt::format("{} does not set the output {} to {}: {}.", name(),
                                     output.name, value_text(output), objection));
    }
  }
  return warnings;
}

TimingSettings Exporter::settings_for(TimingSettings settings) const {
  settings.blend = settings.blend && !stops_at_waypoints();
  settings.period = point_period() > 0.0 ? point_period() : settings.period;
  return settings;
}

std::vector<std::filesystem::path> Exporter::write(const Motion& motion,
                                                   const std::filesystem::path& folder,
                                                   const ExportOptions& options) const {
  return write_files(files(motion, options), folder);
}

std::vector<std::filesystem::path> write_files(const std::vector<ExportedFile>& files,
                                               const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> written;
  for (const ExportedFile& file : files) {
    const std::filesystem::path place = folder / file.name;
    make_folder(place.parent_path());
    geometric::replace_file(place, file.content);
    written.push_back(place);
  }
  return written;
}

std::vector<std::filesystem::path> SceneExporter::write(const geometric::Scene& scene,
                                                        const std::filesystem::path& folder) const {
  if (scene.robots.empty()) {
    throw geometric::InputError(
        {scene.file.string(), "robots", "a scene without a robot", "at least one", ""});
  }
  make_folder(folder);
  const std::string stem = scene.file.empty() ? scene.name : scene.file.stem().string();
  return do_write(scene, folder, geometric::file_name_of(stem.empty() ? "scene" : stem));
}

}  // namespace handway::planning
