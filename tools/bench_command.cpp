#include "bench_command.h"

#include "bench_report.h"
#include "bench_scenes.h"
#include "bench_table.h"
#include "campaign_command.h"
#include "exit_codes.h"
#include "handway/geometric/collision/make_checker.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/planning/campaigns/campaign_reader.h"
#include "handway/planning/core/plugin.h"
#include "number_options.h"
#include "peak_memory.h"
#include "scene_planner.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;

struct BenchOptions {
  std::vector<fs::path> scenes;
  std::vector<std::string> planners;
  BenchSettings settings;
  bool checks_only = false;
  fs::path out;
  bool resume = false;
  int jobs = 0;
};

SceneBench bench_checks(const fs::path& file, const planning::Extensions& extensions) {
  reset_peak_memory();
  const auto begin = std::chrono::steady_clock::now();
  const planning::LoadedScene loaded = planning::load_scene(file, extensions);
  const planning::PlanningProblem problem = planning::make_problem(loaded.scene, loaded.basis);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  SceneBench bench;
  bench.file = file;
  bench.load_s = elapsed.count();
  bench.memory = peak_memory();
  bench.collision = bench_collision(problem.checker->shared_world(), problem.start, problem.goal);
  return bench;
}

// The scene's own planner, then those asked for; none twice.
std::vector<std::unique_ptr<planning::Planner>> planners_for(
    const BenchOptions& options, const geometric::PlannerChoice& choice,
    const planning::PlannerRegistry& registry) {
  std::vector<std::unique_ptr<planning::Planner>> planners;
  planners.push_back(scene_planner("", choice, registry));
  for (const std::string& asked : options.planners) {
    for (const std::string& name : asked == "all" ? registry.names() : std::vector{asked}) {
      if (std::ranges::none_of(planners, [&](const auto& p) { return p->name() == name; })) {
        planners.push_back(scene_planner(name, choice, registry));
      }
    }
  }
  return planners;
}

const std::map<std::string, geometric::CheckerKind>& checker_kinds() {
  using enum geometric::CheckerKind;
  static const std::map<std::string, geometric::CheckerKind> kKinds{
      {"fast", kFast}, {"fcl", kFcl}, {"fcl-broadphase", kFclBroadphase}};
  return kKinds;
}

void bench_plans(SceneBench& bench, const BenchOptions& options,
                 const planning::Extensions& extensions, const BenchTable& table) {
  const planning::LoadedScene loaded = planning::load_scene(bench.file, extensions);
  planning::PlanRequest request;
  request.threads = options.settings.threads;
  request.time_limit_s = options.settings.time_limit_s;
  // Kept while they run, so that what is made of meshes is not read again for each.
  const planning::PlanningProblem kept = planning::make_problem(loaded.scene, loaded.basis);
  for (const auto& planner : planners_for(options, loaded.scene->planner, extensions.planners())) {
    for (const std::string& checker : options.settings.checkers) {
      const geometric::CheckerKind kind = checker_kinds().at(checker);
      const auto make_problem = [&] {
        planning::PlanningProblem problem = planning::make_problem(loaded.scene, loaded.basis);
        if (kind != geometric::CheckerKind::kFast) {
          problem.checker = make_collision_checker(problem.checker->shared_world(), kind);
        }
        return problem;
      };
      bench.plans.push_back(bench_planner(*planner, make_problem, request, options.settings.seeds,
                                          options.settings.check_paths));
      bench.plans.back().checker = checker;
      table.add_plan(bench, bench.plans.size() - 1);
    }
  }
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw geometric::InputError(
        {folder.string(), "", error.message(), "a folder to write to", "Choose another --out"});
  }
}

bool query_is_valid(const SceneBench& bench) {
  return std::ranges::all_of(bench.plans, [](const PlanBench& plan) {
    return plan.results.empty() ||
           (plan.results.front().status != planning::PlanStatus::kStartInvalid &&
            plan.results.front().status != planning::PlanStatus::kGoalInvalid);
  });
}

int bench(const BenchOptions& options) {
  planning::Extensions extensions;
  extensions.load_plugins(planning::plugin_directory());
  for (const std::string& name : options.planners) {
    if (name != "all") {
      static_cast<void>(extensions.planners().create(name));  // refuses an unknown one at once
    }
  }
  if (!options.out.empty()) {
    make_folder(options.out);
  }
  const std::vector<fs::path> files = options.scenes.empty() ? bench_scenes() : options.scenes;
  const BenchTable table(options.settings, files);
  std::vector<SceneBench> scenes;
  for (const fs::path& file : files) {
    scenes.push_back(bench_checks(file, extensions));
    if (scenes.size() == 1) {  // a file that can't be read leaves no table
      table.begin_collisions();
    }
    table.add_collision(scenes.back());
  }
  if (!options.checks_only) {
    table.begin_plans();
    for (SceneBench& scene : scenes) {
      bench_plans(scene, options, extensions, table);
    }
  }
  if (!options.out.empty()) {
    geometric::replace_file(options.out / "bench.csv", bench_csv(options.settings, scenes));
    geometric::replace_file(options.out / "bench.json", bench_json(options.settings, scenes));
  }
  return std::ranges::all_of(scenes, query_is_valid) ? kDone : kInvalidQuery;
}

// A campaign says itself what is run; it goes with none of the options that say so here.
int bench_campaign(const BenchOptions& options, const CLI::App& command) {
  if (options.scenes.size() > 1) {
    throw CLI::ValidationError("CAMPAIGN", "a campaign is run by itself, without other files");
  }
  for (const char* option : {"--planner", "--seeds", "--threads", "--time-limit", "--checker",
                             "--check-paths", "--checks"}) {
    if (command.count(option) > 0) {
      throw CLI::ValidationError(option, "is for scenes; a campaign has it in its file");
    }
  }
  return run_campaign_file({options.scenes.front(), options.out, options.resume, options.jobs});
}

int bench_or_campaign(const BenchOptions& options, const CLI::App& command) {
  if (std::ranges::any_of(options.scenes, planning::is_campaign)) {
    return bench_campaign(options, command);
  }
  for (const char* option : {"--resume", "--jobs"}) {
    if (command.count(option) > 0) {
      throw CLI::ValidationError(option, "is for campaigns only");
    }
  }
  return bench(options);
}

}  // namespace

void add_bench_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command = app.add_subcommand("bench", "Measure collision checks and planners");
  command->add_option("scenes", options->scenes,
                      "Scene or problem files (default: the scenes that ship and, if "
                      "HANDWAY_REFERENCE_DIR is set, the published problems); or one campaign");
  command
      ->add_option("--planner", options->planners,
                   "A planner to compare with the scene's own; \"all\": every one there is")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--seeds", options->settings.seeds, "Runs of each planner: seeds 1 to this")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--threads", options->settings.threads, "Threads of a run")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command
      ->add_option("--time-limit", options->settings.time_limit_s, "Seconds before a run gives up")
      ->check(positive_number())
      ->capture_default_str();
  command
      ->add_option("--checker", options->settings.checkers,
                   "Collision checker that planners use: the everyday one, FCL pair by pair, or "
                   "FCL behind its broad phase")
      ->check(CLI::IsMember(checker_kinds()))
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->capture_default_str();
  command->add_flag("--check-paths", options->settings.check_paths,
                    "Check every path again, with FCL at configurations 1 mm apart");
  command->add_flag("--checks", options->checks_only, "Measure collision checks only");
  command->add_option("--out", options->out,
                      "Folder for bench.csv and bench.json, or for a campaign's runs and report");
  command->add_flag("--resume", options->resume, "Go on with a campaign whose runs are in --out");
  command->add_option("--jobs", options->jobs, "Runs of a campaign at a time (default: one a core)")
      ->check(CLI::Range(1, 1024));
  command->callback(
      [options, command, &exit_code] { exit_code = bench_or_campaign(*options, *command); });
}

}  // namespace handway::tools
