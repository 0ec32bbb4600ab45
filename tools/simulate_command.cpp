#include "commands.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/grasps/hold_test.h"
#include "handway/planning/paths/path_file.h"
#include "handway/planning/tasks/carried_object.h"
#include "parameter_options.h"
#include "printing.h"
#include "scene_options.h"
#include "task_request.h"
#include "terminal.h"
#include "version.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

namespace handway::tools {
namespace {

using Json = nlohmann::ordered_json;
using planning::CarriedObjectMotion;
using planning::CarryResult;

struct SimulateCommand {
  TaskRequest request;
  std::string what;  ///< A path (CSV), a program of the scene or a task file; empty: its program.
  planning::TimingSettings timing;
  planning::HoldConditions hold;
  std::filesystem::path report;
};

/// An object that was carried in the simulation.
struct Carried {
  std::string object;
  CarryResult result;
  std::vector<std::string> assumptions;
};

bool is_path(const std::string& what) { return std::filesystem::path(what).extension() == ".csv"; }

Carried carry(const CarriedObjectMotion& motion, const planning::HoldConditions& conditions,
              const planning::PluginManager& plugins, const std::stop_token& stop) {
  const auto test = make_hold_test(motion, plugins.hold_test_maker(), stop);
  return {motion.object, test->carry(motion.grasp, motion.motion, conditions, stop, {}),
          test->assumptions()};
}

void print_carried(const Carried& carried) {
  const CarryResult& result = carried.result;
  const planning::HoldSlip& slip = result.squeeze.held ? result.slip : result.squeeze;
  print_out("{}: {}, slip {:.1f} mm, {:.1f} degrees in {:.2f} s\n", carried.object,
            result.held() ? "held" : "lost", geometric::millimetres(slip.shift),
            geometric::degrees(slip.turn), result.time);
  if (!result.held()) {
    print_out(
        "  Carry it more slowly (--speed), or give the object's mass (--payload) for the "
        "squeeze\n");
  }
  for (const planning::LinkForce& force : result.forces) {
    print_out("  {:<32} up to {:>6.2f} N\n", force.link, force.largest);
  }
  if (!result.joint.empty()) {
    print_out("  largest torque: {:.0f} % of the limit, at {}\n", 100.0 * result.torque_share,
              result.joint);
  }
}

Json json_of(const Carried& carried) {
  const CarryResult& result = carried.result;
  const planning::HoldSlip& slip = result.squeeze.held ? result.slip : result.squeeze;
  Json contacts = Json::array();
  for (const planning::LinkForce& force : result.forces) {
    contacts.push_back({{"link", force.link}, {"largest_force_N", force.largest}});
  }
  return {{"object", carried.object},
          {"held", result.held()},
          {"slip_mm", geometric::millimetres(slip.shift)},
          {"slip_deg", geometric::degrees(slip.turn)},
          {"time_s", result.time},
          {"contacts", contacts},
          {"torques", {{"joint", result.joint}, {"largest_share", result.torque_share}}},
          {"assumptions", carried.assumptions}};
}

std::string report_of(const SimulateCommand& command, const std::vector<Carried>& all) {
  Json objects = Json::array();
  bool held = true;
  for (const Carried& carried : all) {
    objects.push_back(json_of(carried));
    held = held && carried.result.held();
  }
  const auto most = [&](auto value) {
    double largest = 0.0;
    for (const Json& object : objects) {
      largest = std::max(largest, object[value].template get<double>());
    }
    return largest;
  };
  const Json report = {{"held", held},
                       {"slip_mm", most("slip_mm")},
                       {"slip_deg", most("slip_deg")},
                       {"contacts", objects.front()["contacts"]},
                       {"torques", objects.front()["torques"]},
                       {"objects", objects},
                       {"friction", command.hold.contact.friction},
                       {"payload_kg", command.hold.mass},
                       {"version", kVersion}};
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

int simulate(const SimulateCommand& command, const std::vector<CarriedObjectMotion>& motions,
             const planning::PluginManager& plugins, const std::stop_token& stop) {
  std::vector<Carried> all;
  bool held = true;
  for (const CarriedObjectMotion& motion : motions) {
    all.push_back(carry(motion, command.hold, plugins, stop));
    if (stop.stop_requested()) {
      print_error("handway: the simulation was interrupted\n");
      return kNoPath;
    }
    print_carried(all.back());
    held = held && all.back().result.held();
  }
  if (!command.report.empty()) {
    geometric::replace_file(command.report, report_of(command, all));
  }
  return held ? kDone : kNoPath;
}

std::vector<CarriedObjectMotion> motion_of_path(SimulateCommand& command,
                                                const planning::PluginManager& plugins,
                                                const std::stop_token& stop) {
  const planning::SceneState loaded = planning::load_scene(command.request.scene, plugins);
  const planning::PlanningProblem problem =
      planning::make_problem(loaded.scene, loaded.basis, {stop}, planning::GoalNeed::kOptional);
  print_warnings(problem);
  return {carried_motion(loaded, read_path(problem, command.what), command.timing, stop)};
}

int run(SimulateCommand& command) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  if (plugins.hold_test_maker() == nullptr) {
    throw geometric::InputError({"handway simulate", "", "no plugin that simulates grasps",
                                 "the plugin simulate_mujoco", "Build Handway with libmujoco-dev"});
  }
  command.hold.contact = command.request.options.grasps.contact;
  command.hold.mass = command.request.options.grasps.payload;
  std::stop_source stop;
  const StopsOnInterrupt guard(stop);
  std::vector<CarriedObjectMotion> motions;
  if (is_path(command.what)) {
    motions = motion_of_path(command, plugins, stop.get_token());
  } else {
    if (!command.what.empty()) {
      command.request.task = command.what;
    }
    const auto [task, plan, files] = plan_requested(command.request, plugins, stop.get_token());
    if (!plan.solved) {
      return print_failure(task, plan);
    }
    motions = carried_motions(plan, command.timing, stop.get_token());
  }
  if (motions.empty()) {
    throw geometric::InputError({command.request.scene.string(), "program",
                                 "no object that is carried", "a program that lifts an object",
                                 ""});
  }
  return simulate(command, motions, plugins, stop.get_token());
}

}  // namespace

void add_simulate_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<SimulateCommand>();
  CLI::App* simulate = app.add_subcommand(
      "simulate", "Simulate whether the hand holds an object along a path or a program");
  add_task_request(*simulate, command->request);
  simulate->add_option("what", command->what,
                       "Path (CSV) of a scene in which the hand carries an object, or a program "
                       "of the scene, or a task file");
  add_parameter_options(*simulate, {find_parameter(parameters_of(command->timing), "speed")});
  add_parameter_options(*simulate, parameters_of(command->hold));
  simulate->add_option("--report", command->report, "File for the report (JSON)");
  simulate->callback([command, &exit_code] { exit_code = run(*command); });
}

}  // namespace handway::tools
