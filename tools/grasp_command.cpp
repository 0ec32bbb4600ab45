#include "commands.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/grasps/grasp_file.h"
#include "handway/planning/grasps/grasp_list.h"
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
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <ranges>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::tools {
namespace {

using Json = nlohmann::ordered_json;

struct GraspOptions {
  std::filesystem::path scene;
  std::string object;
  planning::GraspRequest request;
  bool margins = false;
  std::vector<std::string> group;
  std::filesystem::path out;
  std::filesystem::path report;
};

using Margins = std::vector<planning::HoldMargins>;

// The margins of the grasps that shall hold, from the first; none if not asked for.
Margins margins_of(const GraspOptions& options, const planning::GraspList& list,
                   const std::stop_token& stop) {
  Margins margins;
  if (!options.margins || !list.test) {
    return margins;
  }
  const auto holding = static_cast<std::size_t>(options.request.holding.value_or(1));
  for (const auto& [grasp, hold] : list.grasps | std::views::take(holding)) {
    margins.push_back(
        planning::hold_margins(*list.test, grasp, conditions_of(options.request), stop));
  }
  return margins;
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

Json json_of(const planning::HoldResult& result) {
  Json directions = Json::array();
  for (const planning::HoldSlip& slip : result.directions) {
    directions.push_back(json_of(slip));
  }
  return {{"held", result.held()},
          {"squeeze", json_of(result.squeeze)},
          {"directions", directions},
          {"lift", json_of(*result.lift)}};
}

void add_margins(const planning::HoldMargins& margins, Json& hold) {
  hold["least_friction"] = number_or_null(margins.least_friction);
  hold["largest_mass"] = number_or_null(margins.largest_mass);
  const auto& error = margins.position_error;
  hold["position_error_mm"] = error ? Json(geometric::millimetres(*error)) : Json(nullptr);
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
          {"source", grasp.source},
          {"contacts", contacts}};
}

Json report_of(const GraspOptions& options, const planning::PlanningProblem& problem,
               const planning::GraspList& list, const Margins& margins) {
  const planning::PregraspOptions& search = options.request.search;
  Json joints = Json::array();
  for (int v = 0; v < problem.model().variable_count(); ++v) {
    joints.push_back(problem.model().variable(v).name);
  }
  Json found = Json::array();
  for (std::size_t i = 0; i < list.grasps.size(); ++i) {
    found.push_back(json_of(list.grasps[i].grasp));
    if (const auto& hold = list.grasps[i].hold) {
      found.back()["hold"] = json_of(*hold);
      if (i < margins.size()) {
        add_margins(margins[i], found.back()["hold"]);
      }
    }
  }
  const auto assumptions = list.test ? list.test->assumptions() : std::vector<std::string>();
  return {{"object", options.object},
          {"reason", list.why_none},
          {"friction", search.contact.friction},
          {"patch_radius_mm", geometric::millimetres(search.contact.patch_radius)},
          {"payload_kg", search.payload},
          {"seed", search.seed},
          {"threads", search.threads},
          {"time_s", list.search_time},
          {"joints", joints},
          {"grasps", found},
          {"hold_assumptions", assumptions},
          {"version", kVersion}};
}

// The columns of margins.
std::string margin_columns(const planning::HoldMargins& margins) {
  const auto column = [](const std::optional<double>& number, const char* form, double unit) {
    return number ? fmt::format(fmt::runtime(form), *number * unit) : std::string("-");
  };
  return fmt::format(" {:>8} {:>8} {:>8}", column(margins.least_friction, "{:.2f}", 1.0),
                     column(margins.largest_mass, "{:.2f}", 1.0),
                     column(margins.position_error, "{:.0f}", 1e3));
}

// The columns of a simulated grasp; of another one, empty.
std::string hold_columns(const std::optional<planning::HoldResult>& hold) {
  if (!hold) {
    return {};
  }
  return fmt::format(" {:>6} {:>8}", fmt::format("{}/6", hold->directions_held()),
                     hold->lift->held
                         ? fmt::format("{:.1f}", geometric::millimetres(hold->lift->shift))
                         : "dropped");
}

std::string hold_titles(const planning::GraspList& list, const Margins& margins) {
  std::string titles;
  if (list.test) {
    titles += fmt::format(" {:>6} {:>8}", "held", "lift, mm");
  }
  if (!margins.empty()) {
    titles += fmt::format(" {:>8} {:>8} {:>8}", "friction", "mass, kg", "off, mm");
  }
  return titles;
}

// The source and the doubt of a grasp, as far as it has them.
std::string remark(const planning::Pregrasp& grasp) {
  std::string text;
  for (const std::string& part : {grasp.source, grasp.doubt}) {
    text += part.empty() ? std::string() : "  " + part;
  }
  return text;
}

void print_grasps(const planning::GraspList& list, const Margins& margins,
                  const planning::PregraspOptions& search) {
  print_out("Friction {}, payload {} kg\n", search.contact.friction, search.payload);
  print_out("{:>4} {:>6} {:>8} {:>8} {:>8} {:>8} {:>10}{}\n", "rank", "score", "epsilon",
            "contacts", "touching", "force, N", "clear, mm", hold_titles(list, margins));
  for (std::size_t i = 0; i < list.grasps.size(); ++i) {
    const planning::Pregrasp& grasp = list.grasps[i].grasp;
    print_out("{:>4} {:>6.2f} {:>8.3f} {:>8} {:>8} {:>8} {:>10.0f}{}{}{}\n", i + 1, grasp.score,
              grasp.quality.epsilon, grasp.contacts.size(), touching_fingers(grasp),
              grasp.holding_force ? fmt::format("{:.1f}", *grasp.holding_force) : "-",
              geometric::millimetres(grasp.clearance), hold_columns(list.grasps[i].hold),
              i < margins.size() ? margin_columns(margins[i]) : "", remark(grasp));
  }
}

void write_grasps(const GraspOptions& options, const planning::PlanningProblem& problem,
                  const planning::GraspList& list) {
  planning::Pregrasps listed{{}, "", list.palm};
  std::ranges::transform(list.grasps, std::back_inserter(listed.found),
                         &planning::TestedGrasp::grasp);
  geometric::replace_file(options.out, planning::grasp_file_text(problem, options.object,
                                                                 options.request.search, listed));
}

int find_grasps(const GraspOptions& options) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  if (options.request.holding.value_or(0) > 0 && plugins.hold_test_maker() == nullptr) {
    throw geometric::InputError({"--test", "", "no plugin that simulates grasps",
                                 "the plugin simulate_mujoco", "Build Handway with libmujoco-dev"});
  }
  planning::SceneState loaded = planning::load_scene(options.scene, plugins);
  set_group(options.group, loaded);
  const planning::PlanningProblem problem =
      planning::make_problem(loaded.scene, loaded.basis, {}, planning::GoalNeed::kOptional);
  print_warnings(problem);
  std::stop_source stop;
  planning::GraspList list;
  Margins margins;
  {
    const StopsOnInterrupt guard(stop);
    list = planning::list_grasps(problem, options.object, options.request,
                                 plugins.hold_test_maker(), stop.get_token());
    margins = margins_of(options, list, stop.get_token());
  }
  for (const std::string& sentence : list.left_out) {
    print_error("{}\n", sentence);
  }
  if (!options.report.empty()) {
    geometric::replace_file(options.report,
                            report_of(options, problem, list, margins).dump(2) + "\n");
  }
  if (list.grasps.empty()) {
    print_out("No grasp of {} found. {}\n", options.object,
              stop.stop_requested() ? "The search was interrupted." : list.why_none);
    return kNoPath;
  }
  if (!options.out.empty()) {
    write_grasps(options, problem, list);
  }
  print_grasps(list, margins, options.request.search);
  return list.grasps.front().grasp.doubt.empty() ? kDone : kNoPath;
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
  add_parameter_options(*command, parameters_of(options->request.search));
  add_seed_option(*command, options->request.search.seed);
  add_threads_option(*command, options->request.search.threads, "which grasps are found");
  command
      ->add_option(
          "--test", options->request.holding,
          "Simulate grasps, six forces and a lift each, until so many hold, and list these "
          "first; 0 simulates none (default: as --count)")
      ->check(CLI::Range(0, 1000));
  command->add_flag("--margins", options->margins,
                    "Also simulate the least friction, the largest mass and the largest position "
                    "error with which these grasps hold");
  add_parameter_options(*command, parameters_of(options->request.hold));
  add_group_option(*command, options->group);
  command->add_option("--from", options->request.from,
                      "File of grasps (YAML or JSON) to measure instead of a search");
  command->add_option("--out", options->out, "File for the grasps (YAML)");
  command->add_option("--report", options->report, "File for the report (JSON)");
  command->callback([options, &exit_code] {
    if (options->margins) {
      options->request.holding = std::max(options->request.holding.value_or(1), 1);
    }
    exit_code = find_grasps(*options);
  });
}

}  // namespace handway::tools
