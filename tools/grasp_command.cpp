#include "commands.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/grasps/grasp_file.h"
#include "handway/planning/grasps/hold_test.h"
#include "handway/planning/grasps/pregrasp_search.h"
#include "numbers.h"
#include "parameter_options.h"
#include "printing.h"
#include "scene_options.h"
#include "terminal.h"
#include "version.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

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

using Json = nlohmann::ordered_json;

struct GraspOptions {
  std::filesystem::path scene;
  std::string object;
  planning::PregraspOptions search;
  planning::HoldConditions hold;  ///< Friction and mass are those of the search.
  int test = 0;                   ///< Grasps to simulate at most.
  bool margins = false;
  std::vector<std::string> group;
  std::filesystem::path out;
  std::filesystem::path report;
};

/// A simulated grasp.
struct TestedGrasp {
  planning::HoldResult result;
  planning::HoldMargins margins;  ///< Empty unless they are asked for.
};

/// The first grasps of a search, simulated.
struct TestedGrasps {
  std::vector<TestedGrasp> tested;
  std::vector<std::string> assumptions;
};

TestedGrasps test_grasps(const GraspOptions& options, const planning::PluginManager& plugins,
                         const planning::PlanningProblem& problem,
                         const planning::Pregrasps& grasps, const std::stop_token& stop) {
  const auto test = plugins.hold_test_maker()(problem, options.object, grasps.palm);
  TestedGrasps tested{{}, test->assumptions()};
  const auto results =
      planning::test_grasps(*test, grasps.found, static_cast<std::size_t>(options.test),
                            options.hold, options.search.threads, stop);
  for (std::size_t i = 0; i < results.size(); ++i) {
    tested.tested.push_back(
        {results[i], options.margins
                         ? planning::hold_margins(*test, grasps.found[i], options.hold, stop)
                         : planning::HoldMargins{}});
  }
  return tested;
}

Json list_of(const Eigen::VectorXd& v) { return std::vector<double>(v.begin(), v.end()); }

Json json_of(const planning::HoldSlip& slip) {
  return {{"held", slip.held},
          {"slip_mm", geometric::millimetres(slip.shift)},
          {"slip_deg", geometric::degrees(slip.turn)}};
}

Json number_or_null(const std::optional<double>& number) {
  return number ? Json(*number) : Json(nullptr);
}

Json json_of(const TestedGrasp& tested, bool margins) {
  Json directions = Json::array();
  for (const planning::HoldSlip& slip : tested.result.directions) {
    directions.push_back(json_of(slip));
  }
  Json hold = {{"held", tested.result.held()},
               {"squeeze", json_of(tested.result.squeeze)},
               {"directions", directions},
               {"lift", json_of(*tested.result.lift)}};
  if (margins) {
    hold["least_friction"] = number_or_null(tested.margins.least_friction);
    hold["largest_mass"] = number_or_null(tested.margins.largest_mass);
    const auto& error = tested.margins.position_error;
    hold["position_error_mm"] = error ? Json(geometric::millimetres(*error)) : Json(nullptr);
  }
  return hold;
}

Json json_of(const planning::Pregrasp& grasp) {
  Json contacts = Json::array();
  for (const planning::HandContact& contact : grasp.contacts) {
    contacts.push_back({{"finger", contact.finger},
                        {"link", contact.link},
                        {"point", list_of(contact.contact.p_O)},
                        {"normal", list_of(contact.contact.normal_O)},
                        {"distance_mm", geometric::millimetres(contact.distance)}});
  }
  return {{"score", grasp.score},
          {"epsilon", grasp.quality.epsilon},
          {"volume", grasp.quality.volume},
          {"weakest", list_of(grasp.quality.weakest)},
          {"holding_force", number_or_null(grasp.holding_force)},
          {"doubt", grasp.doubt},
          {"fingers", grasp.fingers},
          {"enclosure", grasp.enclosure},
          {"clearance_mm", geometric::millimetres(grasp.clearance)},
          {"subspace_distance", grasp.subspace_distance},
          {"arm_travel", grasp.arm_travel},
          {"pregrasp", list_of(grasp.q)},
          {"grasp", list_of(grasp.closed)},
          {"squeeze", list_of(grasp.squeezed)},
          {"contacts", contacts}};
}

Json report_of(const GraspOptions& options, const planning::PlanningProblem& problem,
               const planning::Pregrasps& grasps, const TestedGrasps& tests, double time_s) {
  Json joints = Json::array();
  for (int v = 0; v < problem.model().variable_count(); ++v) {
    joints.push_back(problem.model().variable(v).name);
  }
  Json found = Json::array();
  for (std::size_t i = 0; i < grasps.found.size(); ++i) {
    found.push_back(json_of(grasps.found[i]));
    if (i < tests.tested.size()) {
      found.back()["hold"] = json_of(tests.tested[i], options.margins);
    }
  }
  return {{"object", options.object},
          {"reason", grasps.why_none},
          {"friction", options.search.contact.friction},
          {"patch_radius_mm", geometric::millimetres(options.search.contact.patch_radius)},
          {"payload_kg", options.search.payload},
          {"seed", options.search.seed},
          {"threads", options.search.threads},
          {"time_s", time_s},
          {"joints", joints},
          {"grasps", found},
          {"hold_assumptions", tests.assumptions},
          {"version", kVersion}};
}

// The columns of a simulated grasp; of another one, empty.
std::string hold_columns(const TestedGrasps& tests, std::size_t grasp, bool margins) {
  if (grasp >= tests.tested.size()) {
    return {};
  }
  const auto& [result, margin] = tests.tested[grasp];
  std::string text = fmt::format(
      " {:>6} {:>8}", fmt::format("{}/6", result.directions_held()),
      result.lift->held ? fmt::format("{:.1f}", geometric::millimetres(result.lift->shift))
                        : "dropped");
  if (margins) {
    const auto column = [](const std::optional<double>& number, const char* form, double unit) {
      return number ? fmt::format(fmt::runtime(form), *number * unit) : std::string("-");
    };
    text += fmt::format(" {:>8} {:>8} {:>8}", column(margin.least_friction, "{:.2f}", 1.0),
                        column(margin.largest_mass, "{:.2f}", 1.0),
                        column(margin.position_error, "{:.0f}", 1e3));
  }
  return text;
}

std::string hold_titles(const GraspOptions& options) {
  std::string titles;
  if (options.test > 0) {
    titles += fmt::format(" {:>6} {:>8}", "held", "lift, mm");
  }
  if (options.test > 0 && options.margins) {
    titles += fmt::format(" {:>8} {:>8} {:>8}", "friction", "mass, kg", "off, mm");
  }
  return titles;
}

void print_grasps(const planning::Pregrasps& grasps, const TestedGrasps& tests,
                  const GraspOptions& options) {
  print_out("Friction {}, payload {} kg\n", options.search.contact.friction,
            options.search.payload);
  print_out("{:>4} {:>6} {:>8} {:>8} {:>8} {:>8} {:>10}{}\n", "rank", "score", "epsilon",
            "contacts", "touching", "force, N", "clear, mm", hold_titles(options));
  for (std::size_t i = 0; i < grasps.found.size(); ++i) {
    const planning::Pregrasp& grasp = grasps.found[i];
    print_out("{:>4} {:>6.2f} {:>8.3f} {:>8} {:>8} {:>8} {:>10.0f}{}{}\n", i + 1, grasp.score,
              grasp.quality.epsilon, grasp.contacts.size(), touching_fingers(grasp),
              grasp.holding_force ? fmt::format("{:.1f}", *grasp.holding_force) : "-",
              geometric::millimetres(grasp.clearance), hold_columns(tests, i, options.margins),
              grasp.doubt.empty() ? std::string() : fmt::format("  {}", grasp.doubt));
  }
}

int find_grasps(const GraspOptions& options) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  if (options.test > 0 && plugins.hold_test_maker() == nullptr) {
    throw geometric::InputError({"--test", "", "no plugin that simulates grasps",
                                 "the plugin simulate_mujoco", "Build Handway with libmujoco-dev"});
  }
  planning::SceneState loaded = planning::load_scene(options.scene, plugins);
  set_group(options.group, loaded);
  const planning::PlanningProblem problem =
      planning::make_problem(loaded.scene, loaded.basis, {}, planning::GoalNeed::kOptional);
  print_warnings(problem);
  std::stop_source stop;
  planning::Pregrasps grasps;
  TestedGrasps tests;
  std::chrono::duration<double> time{};
  {
    const StopsOnInterrupt guard(stop);
    const auto begin = std::chrono::steady_clock::now();
    grasps = planning::find_pregrasps(problem, options.object, options.search, stop.get_token());
    time = std::chrono::steady_clock::now() - begin;
    if (options.test > 0 && !grasps.found.empty()) {
      tests = test_grasps(options, plugins, problem, grasps, stop.get_token());
    }
  }
  if (!options.report.empty()) {
    geometric::replace_file(
        options.report, report_of(options, problem, grasps, tests, time.count()).dump(2) + "\n");
  }
  if (grasps.found.empty()) {
    print_out("No grasp of {} found. {}\n", options.object,
              stop.stop_requested() ? "The search was interrupted." : grasps.why_none);
    return kNoPath;
  }
  if (!options.out.empty()) {
    geometric::replace_file(
        options.out, planning::grasp_file_text(problem, options.object, options.search, grasps));
  }
  print_grasps(grasps, tests, options);
  return grasps.found.front().doubt.empty() ? kDone : kNoPath;
}

}  // namespace

void add_grasp_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<GraspOptions>();
  CLI::App* command = app.add_subcommand("grasp", "Find grasps of an object, the best first");
  command->add_option("scene", options->scene, "Scene or problem file")->required();
  command
      ->add_option("object", options->object,
                   "Object of the scene that the robot does not hold yet")
      ->required();
  add_parameter_options(*command, parameters_of(options->search));
  add_seed_option(*command, options->search.seed);
  add_threads_option(*command, options->search.threads, "which grasps are found");
  command
      ->add_option("--test", options->test,
                   "Number of the best grasps to simulate: six forces, then a lift")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command->add_flag("--margins", options->margins,
                    "Also simulate the least friction, the largest mass and the largest position "
                    "error with which these grasps hold");
  add_parameter_options(*command, parameters_of(options->hold));
  add_group_option(*command, options->group);
  command->add_option("--out", options->out, "File for the grasps (YAML)");
  command->add_option("--report", options->report, "File for the report (JSON)");
  command->callback([options, &exit_code] {
    options->hold.contact = options->search.contact;
    options->hold.mass = options->search.payload;
    options->test = options->margins ? std::max(options->test, 1) : options->test;
    exit_code = find_grasps(*options);
  });
}

}  // namespace handway::tools
