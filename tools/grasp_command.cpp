#include "commands.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/grasps/grasp_file.h"
#include "handway/planning/grasps/pregrasp_search.h"
#include "numbers.h"
#include "printing.h"
#include "scene_options.h"
#include "terminal.h"
#include "version.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <filesystem>
#include <memory>
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
  std::vector<std::string> group;
  std::filesystem::path out;
  std::filesystem::path report;
};

Json list_of(const Eigen::VectorXd& v) { return std::vector<double>(v.begin(), v.end()); }

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
          {"holding_force", grasp.holding_force ? Json(*grasp.holding_force) : Json(nullptr)},
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
               const planning::Pregrasps& grasps, double time_s) {
  Json joints = Json::array();
  for (int v = 0; v < problem.model().variable_count(); ++v) {
    joints.push_back(problem.model().variable(v).name);
  }
  Json found = Json::array();
  for (const planning::Pregrasp& grasp : grasps.found) {
    found.push_back(json_of(grasp));
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
          {"version", kVersion}};
}

void print_grasps(const planning::Pregrasps& grasps, const planning::PregraspOptions& search) {
  print_out("Friction {}, {} kg\n", search.contact.friction, search.payload);
  print_out("{:>4} {:>6} {:>8} {:>8} {:>8} {:>8} {:>10}\n", "rank", "score", "epsilon", "contacts",
            "touching", "force, N", "clear, mm");
  int rank = 0;
  for (const planning::Pregrasp& grasp : grasps.found) {
    print_out("{:>4} {:>6.2f} {:>8.3f} {:>8} {:>8} {:>8} {:>10.0f}{}\n", ++rank, grasp.score,
              grasp.quality.epsilon, grasp.contacts.size(), touching_fingers(grasp),
              grasp.holding_force ? fmt::format("{:.1f}", *grasp.holding_force) : "-",
              geometric::millimetres(grasp.clearance),
              grasp.doubt.empty() ? std::string() : fmt::format("  {}", grasp.doubt));
  }
}

int find_grasps(const GraspOptions& options) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  planning::LoadedScene loaded = planning::load_scene(options.scene, plugins);
  set_group(options.group, loaded);
  const planning::PlanningProblem problem = planning::make_problem(loaded.scene, loaded.basis);
  print_warnings(problem);
  std::stop_source stop;
  planning::Pregrasps grasps;
  const auto begin = std::chrono::steady_clock::now();
  {
    const StopsOnInterrupt guard(stop);
    grasps = planning::find_pregrasps(problem, options.object, options.search, stop.get_token());
  }
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  if (!options.report.empty()) {
    geometric::replace_file(options.report,
                            report_of(options, problem, grasps, time.count()).dump(2) + "\n");
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
  print_grasps(grasps, options.search);
  return grasps.found.front().doubt.empty() ? kDone : kNoPath;
}

}  // namespace

void add_grasp_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<GraspOptions>();
  CLI::App* command =
      app.add_subcommand("grasp", "Find grasps of an object, ranked by how they hold");
  command->add_option("scene", options->scene, "Scene or problem file")->required();
  command->add_option("object", options->object, "Object of the scene, not held by the robot")
      ->required();
  command->add_option("--count", options->search.most, "Grasps to give at most")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      ->add_option("--friction", options->search.contact.friction,
                   "Coefficient of friction between hand and object")
      ->check(CLI::Range(0.01, 10.0))
      ->capture_default_str();
  command->add_option("--payload", options->search.payload, "Mass of the object, kg")
      ->check(CLI::Range(0.0, 1e4))
      ->capture_default_str();
  command->add_option("--seed", options->search.seed, "Seed of all random choices")
      ->check(not_negative())
      ->capture_default_str();
  command
      ->add_option("--threads", options->search.threads, "Threads; the grasps do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  add_group_option(*command, options->group);
  command->add_option("--out", options->out, "Write the grasps here (YAML)");
  command->add_option("--report", options->report, "Write a report here (JSON)");
  command->callback([options, &exit_code] { exit_code = find_grasps(*options); });
}

}  // namespace handway::tools
