#include "commands.h"
#include "goal_pose_options.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/paths/safety_clearance.h"
#include "numbers.h"
#include "plan_report.h"
#include "printing.h"
#include "scene_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace handway::tools {
namespace {

struct CheckOptions {
  std::filesystem::path scene;
  std::filesystem::path path;
  std::filesystem::path postures;
  double resolution_mm = 1.0;
  double margin_mm = 0.0;
  std::vector<std::string> uprights;
  GoalPoseOptions goal_poses;
  std::vector<std::string> group;
};

void print_likeness(const planning::PathLikeness& likeness) {
  print_out(
      "distance of the hand in normalised joints: mean {:.3f} and at most {:.3f} from its "
      "principal motion directions",
      likeness.to_subspace.mean, likeness.to_subspace.largest);
  if (likeness.to_recorded) {
    print_out(", mean {:.3f} and at most {:.3f} from the nearest recorded posture",
              likeness.to_recorded->mean, likeness.to_recorded->largest);
  }
  print_out("\n");
}

/// Prints where the clearance of a valid path is less than a robot can reliably keep.
void print_shortfall(const planning::PlanningProblem& problem, const planning::Path& path,
                     double margin_mm) {
  if (const auto shortfall =
          planning::path_shortfall(problem, path, geometric::metres(margin_mm))) {
    print_out("warning: after waypoint {:.0f}: {}; plan again with --margin {:g}\n",
              shortfall->place, planning::to_string(*shortfall),
              geometric::millimetres(shortfall->suggested_margin()));
  }
}

int check(const CheckOptions& options) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  planning::SceneState loaded = planning::load_scene(options.scene, plugins);
  add_uprights(options.uprights, loaded);
  set_group(options.group, loaded);
  set_goal_poses(options.goal_poses, loaded);
  const planning::PlanningProblem problem =
      planning::make_problem(loaded.scene, loaded.basis, {}, planning::GoalNeed::kOptional);
  print_warnings(problem);
  const planning::Path path = read_path(problem, options.path);
  const planning::PathCheckResult result =
      planning::check_path(problem, path, geometric::metres(options.resolution_mm));
  for (const std::string& fault : result.faults) {
    print_out("{}\n", fault);
  }
  for (const std::string& warning : result.warnings) {
    print_out("warning: {}\n", warning);
  }
  print_out("{}: {} waypoints, {} configurations checked at {:g} mm or closer, {} in collision{}",
            result.valid() ? "valid" : "NOT VALID", path.waypoints.size(), result.configurations,
            options.resolution_mm, result.collisions,
            loaded.scene->constraints.empty() ? "" : " or violating a constraint");
  if (result.collisions == 0 && !result.closest_pair.empty()) {
    print_out(", smallest clearance {:.3f} mm ({})", geometric::millimetres(result.min_clearance),
              result.closest_pair);
  }
  print_out("\n");
  if (result.valid()) {
    print_shortfall(problem, path, options.margin_mm);
  }
  const bool has_configurations = result.configurations > 0;
  if (const auto likeness =
          has_configurations
              ? hand_likeness(problem, path, recorded_postures(problem, options.postures))
              : std::nullopt) {
    print_likeness(*likeness);
  }
  return result.valid() ? kDone : kNoPath;
}

}  // namespace

void add_check_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command =
      app.add_subcommand("check", "Check a path for collisions on the exact meshes");
  command->add_option("scene", options->scene, "Scene or problem file")->required();
  command->add_option("path", options->path, "Path (CSV)")->required();
  command
      ->add_option("--resolution-mm", options->resolution_mm,
                   "Largest motion of any point of the robot between two checks, mm")
      ->check(positive_number())
      ->check(CLI::Range(1e-4, 1e3))
      ->capture_default_str();
  command
      ->add_option("--margin", options->margin_mm,
                   "Clearance in mm that has to remain if the joints are off by 0.03 degrees; less "
                   "is valid with a warning")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  command->add_option(
      "--postures", options->postures,
      "Recorded postures to compare the hand with (default: those of the hand basis)");
  add_upright_option(*command, options->uprights);
  add_goal_pose_options(*command, options->goal_poses);
  add_group_option(*command, options->group);
  command->callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace handway::tools
