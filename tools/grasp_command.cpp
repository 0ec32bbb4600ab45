#include "commands.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/grasps/given_grasps.h"
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
#include <iterator>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

namespace handway::tools {
namespace {

using Json = nlohmann::ordered_json;

struct GraspOptions {
  std::filesystem::path scene;
  std::string object;
  planning::PregraspOptions search;
  planning::HoldConditions hold;  ///< Friction and mass are those of the search.
  std::optional<int> test;        ///< Grasps that shall hold; if not given, all that are listed.
  bool margins = false;
  std::vector<std::string> group;
  std::filesystem::path from;  ///< File of grasps to measure; empty: grasps are searched for.
  std::filesystem::path out;
  std::filesystem::path report;
};

// Grasps that shall hold: by default all that are listed.
int wanted(const GraspOptions& options) { return options.test.value_or(options.search.most); }

/// Grasps of a search, simulated as far as that was asked for.
struct TestedGrasps {
  std::vector<planning::TestedGrasp> ranked;
  std::vector<planning::HoldMargins>
      margins;  ///< One for each of the first; none if not asked for.
  std::vector<std::string> assumptions;
};

TestedGrasps test_grasps(const GraspOptions& options, const planning::PluginManager& plugins,
                         const planning::PlanningProblem& problem, planning::Pregrasps grasps,
                         const std::stop_token& stop) {
  const auto test = plugins.hold_test_maker()(problem, options.object, grasps.palm);
  const auto count = static_cast<std::size_t>(wanted(options));
  TestedGrasps tested{planning::rank_by_tests(*test, std::move(grasps.found), count, options.hold,
                                              options.search.threads, stop),
                      {},
                      test->assumptions()};
  if (tested.ranked.size() > static_cast<std::size_t>(options.search.most)) {
    tested.ranked.resize(static_cast<std::size_t>(options.search.most));
  }
  for (std::size_t i = 0; options.margins && i < std::min(count, tested.ranked.size()); ++i) {
    tested.margins.push_back(
        planning::hold_margins(*test, tested.ranked[i].grasp, options.hold, stop));
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
               const std::string& why_none, const TestedGrasps& grasps, double time_s) {
  Json joints = Json::array();
  for (int v = 0; v < problem.model().variable_count(); ++v) {
    joints.push_back(problem.model().variable(v).name);
  }
  Json found = Json::array();
  for (std::size_t i = 0; i < grasps.ranked.size(); ++i) {
    found.push_back(json_of(grasps.ranked[i].grasp));
    if (const auto& hold = grasps.ranked[i].hold) {
      found.back()["hold"] = json_of(*hold);
      if (i < grasps.margins.size()) {
        add_margins(grasps.margins[i], found.back()["hold"]);
      }
    }
  }
  return {{"object", options.object},
          {"reason", why_none},
          {"friction", options.search.contact.friction},
          {"patch_radius_mm", geometric::millimetres(options.search.contact.patch_radius)},
          {"payload_kg", options.search.payload},
          {"seed", options.search.seed},
          {"threads", options.search.threads},
          {"time_s", time_s},
          {"joints", joints},
          {"grasps", found},
          {"hold_assumptions", grasps.assumptions},
          {"version", kVersion}};
}

// The columns of the margins; of a grasp without them, empty.
std::string margin_columns(const TestedGrasps& grasps, std::size_t rank) {
  if (rank >= grasps.margins.size()) {
    return {};
  }
  const planning::HoldMargins& margins = grasps.margins[rank];
  const auto column = [](const std::optional<double>& number, const char* form, double unit) {
    return number ? fmt::format(fmt::runtime(form), *number * unit) : std::string("-");
  };
  return fmt::format(" {:>8} {:>8} {:>8}", column(margins.least_friction, "{:.2f}", 1.0),
                     column(margins.largest_mass, "{:.2f}", 1.0),
                     column(margins.position_error, "{:.0f}", 1e3));
}

// The columns of a simulated grasp; of another one, empty.
std::string hold_columns(const TestedGrasps& grasps, std::size_t rank) {
  const std::optional<planning::HoldResult>& hold = grasps.ranked[rank].hold;
  if (!hold) {
    return {};
  }
  return fmt::format(" {:>6} {:>8}", fmt::format("{}/6", hold->directions_held()),
                     hold->lift->held
                         ? fmt::format("{:.1f}", geometric::millimetres(hold->lift->shift))
                         : "dropped") +
         margin_columns(grasps, rank);
}

std::string hold_titles(const GraspOptions& options) {
  std::string titles;
  if (wanted(options) > 0) {
    titles += fmt::format(" {:>6} {:>8}", "held", "lift, mm");
  }
  if (wanted(options) > 0 && options.margins) {
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

void print_grasps(const TestedGrasps& grasps, const GraspOptions& options) {
  print_out("Friction {}, payload {} kg\n", options.search.contact.friction,
            options.search.payload);
  print_out("{:>4} {:>6} {:>8} {:>8} {:>8} {:>8} {:>10}{}\n", "rank", "score", "epsilon",
            "contacts", "touching", "force, N", "clear, mm", hold_titles(options));
  for (std::size_t i = 0; i < grasps.ranked.size(); ++i) {
    const planning::Pregrasp& grasp = grasps.ranked[i].grasp;
    print_out("{:>4} {:>6.2f} {:>8.3f} {:>8} {:>8} {:>8} {:>10.0f}{}{}\n", i + 1, grasp.score,
              grasp.quality.epsilon, grasp.contacts.size(), touching_fingers(grasp),
              grasp.holding_force ? fmt::format("{:.1f}", *grasp.holding_force) : "-",
              geometric::millimetres(grasp.clearance), hold_columns(grasps, i), remark(grasp));
  }
}

// Grasps are simulated by default where that is possible.
void set_tests(bool can_simulate, GraspOptions& options) {
  if (options.test.value_or(0) > 0 && !can_simulate) {
    throw geometric::InputError({"--test", "", "no plugin that simulates grasps",
                                 "the plugin simulate_mujoco", "Build Handway with libmujoco-dev"});
  }
  if (!options.test && !can_simulate) {
    options.test = 0;
  }
  options.search.spares = 2 * std::min(wanted(options), options.search.most);
}

// Searches for grasps, or measures those of a file: then all are listed.
planning::Pregrasps found_or_given(const planning::PlanningProblem& problem, GraspOptions& options,
                                   const std::stop_token& stop) {
  if (options.from.empty()) {
    return planning::find_pregrasps(problem, options.object, options.search, stop);
  }
  const std::vector<planning::GivenGrasp> given =
      planning::read_given_grasps(options.from, problem, options.object);
  planning::MeasuredGrasps measured =
      planning::measure_given_grasps(problem, options.object, given, options.search, stop);
  for (const std::string& sentence : measured.left_out) {
    print_error("{}\n", sentence);
  }
  if (measured.grasps.found.empty()) {
    measured.grasps.why_none = fmt::format("None of the {} given is possible.", given.size());
  }
  options.search.most = static_cast<int>(given.size());
  return std::move(measured.grasps);
}

int find_grasps(GraspOptions options) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  set_tests(plugins.hold_test_maker() != nullptr, options);
  planning::SceneState loaded = planning::load_scene(options.scene, plugins);
  set_group(options.group, loaded);
  const planning::PlanningProblem problem =
      planning::make_problem(loaded.scene, loaded.basis, {}, planning::GoalNeed::kOptional);
  print_warnings(problem);
  std::stop_source stop;
  planning::Pregrasps found;
  TestedGrasps grasps;
  std::chrono::duration<double> time{};
  {
    const StopsOnInterrupt guard(stop);
    const auto begin = std::chrono::steady_clock::now();
    found = found_or_given(problem, options, stop.get_token());
    time = std::chrono::steady_clock::now() - begin;
    if (wanted(options) > 0 && !found.found.empty()) {
      grasps = test_grasps(options, plugins, problem, found, stop.get_token());
    } else {
      std::ranges::transform(
          found.found, std::back_inserter(grasps.ranked),
          [](const planning::Pregrasp& grasp) { return planning::TestedGrasp{grasp}; });
    }
  }
  if (!options.report.empty()) {
    geometric::replace_file(
        options.report,
        report_of(options, problem, found.why_none, grasps, time.count()).dump(2) + "\n");
  }
  if (grasps.ranked.empty()) {
    print_out("No grasp of {} found. {}\n", options.object,
              stop.stop_requested() ? "The search was interrupted." : found.why_none);
    return kNoPath;
  }
  if (!options.out.empty()) {
    found.found.clear();
    std::ranges::transform(grasps.ranked, std::back_inserter(found.found),
                           &planning::TestedGrasp::grasp);
    geometric::replace_file(
        options.out, planning::grasp_file_text(problem, options.object, options.search, found));
  }
  print_grasps(grasps, options);
  return grasps.ranked.front().grasp.doubt.empty() ? kDone : kNoPath;
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
      ->add_option(
          "--test", options->test,
          "Simulate grasps, six forces and a lift each, until so many hold, and list these "
          "first; 0 simulates none (default: as --count)")
      ->check(CLI::Range(0, 1000));
  command->add_flag("--margins", options->margins,
                    "Also simulate the least friction, the largest mass and the largest position "
                    "error with which these grasps hold");
  add_parameter_options(*command, parameters_of(options->hold));
  add_group_option(*command, options->group);
  command->add_option("--from", options->from,
                      "File of grasps (YAML or JSON) to measure instead of a search");
  command->add_option("--out", options->out, "File for the grasps (YAML)");
  command->add_option("--report", options->report, "File for the report (JSON)");
  command->callback([options, &exit_code] {
    options->hold.contact = options->search.contact;
    options->hold.mass = options->search.payload;
    if (options->margins) {
      options->test = std::max(options->test.value_or(1), 1);
    }
    exit_code = find_grasps(*options);
  });
}

}  // namespace handway::tools
