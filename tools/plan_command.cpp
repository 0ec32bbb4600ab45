#include "commands.h"
#include "goal_pose_options.h"
#include "handway/geometric/collision/narrow_phase/contact.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/limit_violation.h"
#include "handway/planning/core/carried_objects.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/core/request_parameters.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/paths/path_file.h"
#include "handway/planning/queries/collision_remedy.h"
#include "handway/planning/queries/nearest_free.h"
#include "parameter_options.h"
#include "plan_report.h"
#include "printing.h"
#include "scene_options.h"
#include "terminal.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;
using planning::PlanResult;
using planning::PlanStatus;

struct PlanOptions {
  fs::path scene;
  std::string planner;
  planning::PlanRequest request = {.time_limit_s = 300.0};
  std::vector<std::string> settings;
  std::vector<std::string> uprights;
  GoalPoseOptions goal_poses;
  std::vector<std::string> group;
  fs::path out;
  fs::path report;
  fs::path postures;
};

PlanResult plan_until_interrupted(planning::Planner& planner,
                                  const planning::PlanningProblem& problem,
                                  const planning::PlanRequest& request) {
  std::stop_source stop;
  const StopsOnInterrupt guard(stop);
  return planner.plan(problem, request, stop.get_token());
}

int exit_code_of(PlanStatus status) {
  switch (status) {
    case PlanStatus::kSolved:
      return kDone;
    case PlanStatus::kStartInvalid:
    case PlanStatus::kGoalInvalid:
      return kInvalidQuery;
    default:
      return kNoPath;
  }
}

// Prints the pairs that touch at a refused end, and the nearest free configuration.
void print_advice(const planning::PlanningProblem& problem, bool at_start) {
  const geometric::Configuration& q = at_start ? problem.start : problem.goal;
  if (!geometric::configuration_fault(problem.model(), q).empty()) {
    return;
  }
  constexpr std::size_t kMostContacts = 3;
  const std::vector<geometric::Contact> contacts = find_contacts(*problem.checker->clone(), q);
  for (std::size_t i = 0; i < std::min(kMostContacts, contacts.size()); ++i) {
    const geometric::Contact& contact = contacts[i];
    print_error("  {} and {}: {:.1f} mm into each other at ({:.3f}, {:.3f}, {:.3f}) m\n", contact.a,
                contact.b, geometric::millimetres(contact.depth), contact.p_W.x(), contact.p_W.y(),
                contact.p_W.z());
  }
  if (contacts.size() > kMostContacts) {
    print_error("  and {} more\n", contacts.size() - kMostContacts);
  }
  for (const planning::CollisionRemedy& remedy : planning::find_remedies(problem, q, contacts)) {
    print_error("  {}\n", planning::describe_remedy(*problem.scene, remedy));
  }
  const planning::NearestFreeOptions options;
  const planning::NearestFree nearest = find_nearest_free(problem, q, options);
  const char* which = at_start ? "start" : "goal";
  if (nearest.q) {
    print_error("  Nearest free {}: {}\n", which,
                planning::describe_change(problem.model(), q, *nearest.q, 3));
  } else {
    print_error("  No free {} was found within {:.0f}° (slides: {:.0f} mm)\n", which,
                geometric::degrees(options.most_distance),
                geometric::millimetres(options.most_distance));
  }
}

void print_summary(const PlanResult& result, const planning::PlanningProblem& problem) {
  if (result.solved()) {
    print_out("{}\n", result.reason);
    if (result.cost) {
      print_out(
          "  Optimised with {} checks: cost {:.4f}; no path costs less than {:.4f}, at most {:.1f} "
          "% "
          "could be saved\n",
          result.optimize_checks, result.cost->cost, result.cost->least,
          100.0 * result.cost->gap());
    }
    for (const std::string& warning :
         planning::holding_warnings(*problem.scene, result.path.waypoints)) {
      print_out("  warning: {}\n", warning);
    }
    for (const planning::OutOfMargin& near : result.out_of_margin) {
      print_out(
          "  {} and {} are {:.3f} mm apart at the {}: near it their clearance is less than the "
          "margin\n",
          near.pair.a, near.pair.b, geometric::millimetres(near.pair.distance),
          near.at_goal ? "goal" : "start");
    }
    return;
  }
  print_error("handway: {}\n", result.reason);
  for (const std::string& sentence : planning::explain_failure(result)) {
    print_error("  {}\n", sentence);
  }
  const bool is_end_invalid =
      result.status == PlanStatus::kStartInvalid || result.status == PlanStatus::kGoalInvalid;
  if (is_end_invalid && problem.goal_fault.empty()) {
    print_advice(problem, result.status == PlanStatus::kStartInvalid);
  }
  if (!is_end_invalid && !problem.joints.holding.empty()) {
    print_error(
        "  The joints of a hand that carries an object do not move. To move them, add them to "
        "--group.\n");
  }
  if (!is_end_invalid && !problem.joints.fixed_limb_joints.empty()) {
    print_error(
        "  Arms whose goal is their start do not move. If they are in the way, add them to "
        "--group.\n");
  }
}

int plan(PlanOptions options) {
  const auto begin = std::chrono::steady_clock::now();
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  planning::SceneState loaded = planning::load_scene(options.scene, plugins);
  choose_basis(options.settings, loaded);
  add_uprights(options.uprights, loaded);
  set_group(options.group, loaded);
  set_goal_poses(options.goal_poses, loaded);
  const std::unique_ptr<planning::Planner> planner =
      scene_planner(options.planner, loaded.scene->planner, plugins.planners());
  apply_settings(*planner, options.settings);
  const planning::PlanningProblem problem = planning::make_problem(loaded.scene, loaded.basis);
  print_warnings(problem);
  const std::chrono::duration<double> load = std::chrono::steady_clock::now() - begin;

  const planning::PlanRequest& request = options.request;
  const PlanResult result = plan_until_interrupted(*planner, problem, request);

  if (result.solved() && !options.out.empty()) {
    planning::write_path_csv(result.path, problem.model(), options.out);
  }
  if (!options.report.empty()) {
    const auto quality =
        result.solved() ? std::optional(path_quality(problem, result.path)) : std::nullopt;
    const auto recorded = recorded_postures(problem, options.postures);
    geometric::replace_file(options.report,
                            plan_report(*planner, problem, request, result, load.count(),
                                        hand_likeness(problem, result.path, recorded), quality,
                                        measure_motion(problem, result.path, recorded)));
  }
  print_summary(result, problem);
  return exit_code_of(result.status);
}

}  // namespace

void add_plan_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<PlanOptions>();
  CLI::App* command = app.add_subcommand("plan", "Find a collision-free path");
  command->add_option("scene", options->scene, "Scene or problem file")->required();
  command->add_option("--planner", options->planner, "Planner (default: the scene's, else auto)");
  add_seed_option(*command, options->request.seed);
  add_parameter_options(*command, parameters_of(options->request));
  command
      ->add_option("--set", options->settings,
                   "Parameter of the planner, KEY=VALUE; or a hand basis, basis=FILE")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_upright_option(*command, options->uprights);
  add_goal_pose_options(*command, options->goal_poses);
  add_group_option(*command, options->group);
  command->add_option("--out", options->out, "File for the path (CSV)");
  command->add_option("--report", options->report, "File for the report (JSON)");
  command
      ->add_option("--postures", options->postures,
                   "Recorded postures to compare the hand with in the report (default: those of "
                   "the hand basis)")
      ->needs("--report");
  command->callback([options, &exit_code] { exit_code = plan(*options); });
}

}  // namespace handway::tools
