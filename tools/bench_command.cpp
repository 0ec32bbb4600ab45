#include "bench_report.h"
#include "bench_table.h"
#include "campaign_command.h"
#include "collision_bench.h"
#include "commands.h"
#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/resources.h"
#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "machine.h"
#include "motion_bench_maker.h"
#include "numbers.h"
#include "plan_bench.h"
#include "printing.h"
#include "scene_options.h"
#include "scene_variants.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <system_error>
#include <vector>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> shipped_scenes() {
  std::vector<fs::path> scenes;
  std::error_code ignored;  // no folder: no scenes
  const fs::path folder = geometric::resource_dir().parent_path() / "scenes";
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".yaml") {
      scenes.push_back(entry.path());
    }
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

std::vector<fs::path> published_problems(const fs::path& folder) {
  std::vector<fs::path> problems;
  for (const std::string name : {"_TwoCanb", "_CanBox", "_ShelfCan2", "-shelfT2"}) {
    const fs::path file = folder / "auro" / ("TX90_RHand_ICRA10_5PMD" + name + "_new.xml");
    if (fs::exists(file)) {
      problems.push_back(file);
    }
  }
  if (problems.empty()) {
    throw geometric::InputError({"HANDWAY_REFERENCE_DIR", "", "\"" + folder.string() + "\"",
                                 "a folder with the published problems in \"auro\"",
                                 "Correct the variable or unset it"});
  }
  return problems;
}

/// Returns the default scenes of `handway bench`: the scenes that ship, by name; and, if
/// $HANDWAY_REFERENCE_DIR is set, the published problems 1 to 4.
/// @throws InputError if that folder has none of them.
std::vector<fs::path> bench_scenes() {
  std::vector<fs::path> scenes = shipped_scenes();
  if (const char* reference = std::getenv("HANDWAY_REFERENCE_DIR")) {
    const std::vector<fs::path> problems = published_problems(reference);
    scenes.insert(scenes.end(), problems.begin(), problems.end());
  }
  return scenes;
}

struct BenchOptions {
  std::vector<fs::path> scenes;
  std::vector<std::string> planners;
  BenchSettings settings;
  VariantSettings variants;
  std::vector<std::string> sets;   ///< KEY=VALUE
  std::vector<std::string> group;  ///< Moving joints; empty: the scenes'.
  bool checks_only = false;
  fs::path postures;  ///< Recorded postures to compare hands with; empty: those of the bases.
  fs::path write;     ///< Folder for variants; empty: they are run.
  fs::path out;
  bool resume = false;
  int jobs = 0;
  fs::path motion_bench_maker;  ///< Folder of its sets; empty: scenes or a campaign.
  fs::path paths;               ///< Paths of other planners; empty: none.
};

/// A scene to run planners on.
struct BenchScene {
  planning::SceneState loaded;
  std::vector<std::string> settings;  ///< Settings of the scene's own planner.
};

BenchScene load(const fs::path& file, const BenchOptions& options,
                const planning::PluginManager& plugins) {
  BenchScene scene{planning::load_scene(file, plugins), options.sets};
  choose_basis(scene.settings, scene.loaded);
  set_group(options.group, scene.loaded);
  return scene;
}

SceneBench bench_checks(const fs::path& file, const BenchOptions& options,
                        const planning::PluginManager& plugins) {
  reset_peak_memory();
  const auto begin = std::chrono::steady_clock::now();
  const planning::SceneState loaded = load(file, options, plugins).loaded;
  const planning::PlanningProblem problem = planning::make_problem(loaded.scene, loaded.basis);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  SceneBench bench;
  bench.file = file;
  bench.load_s = elapsed.count();
  bench.memory = peak_memory();
  bench.collision = bench_collision(problem.checker->shared_world(), problem.start, problem.goal);
  return bench;
}

// Returns the scene's own planner, then the requested ones, without duplicates.
std::vector<std::unique_ptr<planning::Planner>> planners_for(
    const BenchOptions& options, const BenchScene& scene,
    const planning::PlannerRegistry& registry) {
  const geometric::PlannerRequest& choice = scene.loaded.scene->planner;
  std::vector<std::unique_ptr<planning::Planner>> planners;
  planners.push_back(scene_planner("", choice, registry));
  apply_settings(*planners.front(), scene.settings);
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

std::vector<std::uint64_t> all_seeds(const BenchOptions& options) {
  std::vector<std::uint64_t> seeds(static_cast<std::size_t>(options.settings.seeds));
  std::iota(seeds.begin(), seeds.end(), 1);
  return seeds;
}

PlanBench bench_plan(planning::Planner& planner, const planning::SceneState& loaded,
                     const std::string& checker, double time_limit_s, const BenchOptions& options,
                     const std::vector<std::uint64_t>& seeds,
                     const std::shared_ptr<const sampling::RecordedPostures>& recorded) {
  planning::PlanRequest request;
  request.threads = options.settings.threads;
  request.time_limit_s = time_limit_s;
  const geometric::CheckerKind kind = checker_kinds().at(checker);
  const auto make_problem = [&] {
    planning::PlanningProblem problem = planning::make_problem(loaded.scene, loaded.basis);
    if (kind != geometric::CheckerKind::kFast) {
      problem.checker = make_collision_checker(problem.checker->shared_world(), kind);
    }
    return problem;
  };
  PlanBench bench =
      bench_planner(planner, make_problem, request, seeds, options.settings.check_paths, recorded);
  bench.checker = checker;
  return bench;
}

void bench_plans(SceneBench& bench, const BenchOptions& options,
                 const planning::PluginManager& plugins, const BenchTable& table) {
  const BenchScene scene = load(bench.file, options, plugins);
  // Kept while they run, so that the meshes' volumes are not read again for each.
  const planning::PlanningProblem kept =
      planning::make_problem(scene.loaded.scene, scene.loaded.basis);
  const auto recorded = kept.basis ? recorded_postures(kept, options.postures) : nullptr;
  for (const auto& planner : planners_for(options, scene, plugins.planners())) {
    for (const std::string& checker : options.settings.checkers) {
      bench.plans.push_back(bench_plan(*planner, scene.loaded, checker,
                                       options.settings.time_limit_s, options, all_seeds(options),
                                       recorded));
      table.add_plan(bench, bench.plans.size() - 1);
    }
  }
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw geometric::OutputError(
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

// Refuses an unknown planner and a folder that is not writable at the start.
planning::PluginManager checked_extensions(const BenchOptions& options) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  for (const std::string& name : options.planners) {
    if (name != "all") {
      static_cast<void>(plugins.planners().create(name));
    }
  }
  if (!options.out.empty()) {
    make_folder(options.out);
  }
  return plugins;
}

int bench(const BenchOptions& options) {
  const planning::PluginManager plugins = checked_extensions(options);
  const std::vector<fs::path> files = options.scenes.empty() ? bench_scenes() : options.scenes;
  const BenchTable table(options.settings, files);
  std::vector<SceneBench> scenes;
  for (const fs::path& file : files) {
    scenes.push_back(bench_checks(file, options, plugins));
    if (scenes.size() == 1) {  // a file that can't be read leaves no table
      table.begin_collisions();
    }
    table.add_collision(scenes.back());
  }
  if (!options.checks_only) {
    table.begin_plans();
    for (SceneBench& scene : scenes) {
      bench_plans(scene, options, plugins, table);
    }
    table.add_motions(scenes);
  }
  if (!options.out.empty()) {
    geometric::replace_file(options.out / "bench.csv", bench_csv(options.settings, scenes));
    geometric::replace_file(options.out / "bench.json", bench_json(options.settings, scenes));
  }
  return std::ranges::all_of(scenes, query_is_valid) ? kDone : kInvalidQuery;
}

std::vector<PlanBench> bench_variant(const BenchScene& scene, const BenchOptions& options,
                                     const planning::PluginManager& plugins) {
  const std::string& checker = options.settings.checkers.front();
  const planning::PlanningProblem kept =
      planning::make_problem(scene.loaded.scene, scene.loaded.basis);
  const auto recorded = kept.basis ? recorded_postures(kept, options.postures) : nullptr;
  std::vector<PlanBench> plans;
  for (const auto& planner : planners_for(options, scene, plugins.planners())) {
    const bool is_default = plans.empty();
    plans.push_back(bench_plan(
        *planner, scene.loaded, checker,
        is_default ? options.settings.time_limit_s : options.variants.others_time_limit_s, options,
        is_default || !options.variants.only_missed ? all_seeds(options)
                                                    : unsolved_seeds(plans.front()),
        recorded));
  }
  return plans;
}

// The variants of a file; `use` is called with each one found.
template <typename Use>
VariantBench make_variants(const fs::path& file, const BenchOptions& options,
                           const planning::PluginManager& plugins, const Use& use) {
  planning::SceneState loaded = planning::load_scene(file, plugins);
  set_group(options.group, loaded);
  const planning::PlanningProblem problem = planning::make_problem(loaded.scene, loaded.basis);
  const VariantGenerator generator(problem);
  VariantBench bench{file, fmt::format("{}", fmt::join(generator.target(), ", ")), {}};
  for (int number = 1; number <= options.variants.count; ++number) {
    bench.variants.push_back({generator.make(number, options.variants.seed), {}});
    if (bench.variants.back().variant.scene) {
      use(bench.variants.back());
    }
  }
  return bench;
}

int bench_variants(const BenchOptions& options) {
  const planning::PluginManager plugins = checked_extensions(options);
  const std::vector<fs::path> files = options.scenes.empty() ? bench_scenes() : options.scenes;
  const BenchTable table(options.settings, files);
  std::vector<VariantBench> benches;
  VariantSummary total;
  for (const fs::path& file : files) {
    BenchScene scene = load(file, options, plugins);
    if (benches.empty()) {  // a file that can't be read leaves no table
      table.begin_variants(options.variants);
    }
    benches.push_back(make_variants(file, options, plugins, [&](VariantRuns& runs) {
      scene.loaded.scene = runs.variant.scene;
      runs.plans = bench_variant(scene, options, plugins);
    }));
    table.add_variants(benches.back());
    total += summary_of(benches.back());
  }
  table.add_summary(total);
  if (!options.out.empty()) {
    geometric::replace_file(options.out / "variants.json",
                            variants_json(options.settings, options.variants, benches));
  }
  return kDone;
}

// Writes variants as scene files; the basis of an imported problem, which has no file, goes beside
// them.
int write_variants(const BenchOptions& options) {
  const planning::PluginManager plugins = checked_extensions(options);
  make_folder(options.write);
  for (const fs::path& file : options.scenes.empty() ? bench_scenes() : options.scenes) {
    const BenchScene source = load(file, options, plugins);
    const std::string stem = file.stem().string();
    fs::path basis = source.loaded.scene->hand_basis;
    if (source.loaded.basis && basis.empty()) {
      basis = fs::absolute(options.write / (stem + "_hand.yaml"));
      sampling::write_pmd_basis(*source.loaded.basis, basis);
    }
    const VariantBench bench = make_variants(file, options, plugins, [&](const VariantRuns& runs) {
      geometric::Scene scene = *runs.variant.scene;
      scene.hand_basis = basis;
      const fs::path target = options.write / fmt::format("{}_seed{}_variant{:02}.yaml", stem,
                                                          runs.variant.seed, runs.variant.number);
      geometric::write_scene(scene, target);
      print_out("{}\n", target.string());
    });
    for (const VariantRuns& runs : bench.variants) {
      if (!runs.variant.scene) {
        print_out("{}, variant {}: no free start and goal in {} samples\n", stem,
                  runs.variant.number, runs.variant.draws);
      }
    }
  }
  return kDone;
}

void refuse(std::initializer_list<const char*> names, const CLI::App& command,
            const std::string& reason) {
  for (const char* name : names) {
    if (command.count(name) > 0) {
      throw CLI::ValidationError(name, reason);
    }
  }
}

// A campaign defines the runs itself; options that would define them are refused.
int bench_campaign(const BenchOptions& options, const CLI::App& command) {
  if (options.scenes.size() > 1) {
    throw CLI::ValidationError("CAMPAIGN", "a campaign can't be combined with other files");
  }
  refuse({"--planner", "--seeds", "--threads", "--time-limit", "--checker", "--check-paths",
          "--checks", "--set", "--group", "--variants", "--postures"},
         command, "applies to scenes; for a campaign, set it in the campaign file");
  return run_campaign_file(
      {options.scenes.front(), options.out, options.resume, options.paths, options.jobs});
}

int bench_motion_bench_maker(const BenchOptions& options, const CLI::App& command) {
  refuse({"scenes", "--checker", "--checks", "--set", "--group", "--postures", "--variants",
          "--variant-seed", "--write", "--only-missed", "--others-limit"},
         command, "can't be combined with --motionbenchmaker");
  return run_in_team([&](planning::ProcessTeam* team) {
    planning::PluginManager plugins;
    plugins.load_plugins(planning::plugin_directory());
    planning::Campaign campaign = motion_bench_maker_campaign(options.motion_bench_maker,
                                                              options.planners, plugins.planners());
    campaign.seeds = all_seeds(options);
    campaign.threads = options.settings.threads;
    campaign.time_limit_s = options.settings.time_limit_s;
    campaign.check_paths = options.settings.check_paths;
    CampaignSession session;
    session.folder = options.out.empty() ? fs::path("motionbenchmaker") : options.out;
    session.resume = options.resume;
    session.paths = options.paths;
    session.jobs = options.jobs;
    return run_campaign(campaign, plugins, session, team);
  });
}

int bench_or_campaign(BenchOptions& options, const CLI::App& command) {
  if (!options.motion_bench_maker.empty()) {
    if (command.count("--seeds") == 0) {
      options.settings.seeds = 1;
    }
    return bench_motion_bench_maker(options, command);
  }
  if (std::ranges::any_of(options.scenes, planning::is_campaign)) {
    return bench_campaign(options, command);
  }
  refuse({"--resume", "--jobs", "--paths"}, command, "applies to campaigns only");
  if (options.variants.count == 0) {
    refuse({"--variant-seed", "--write", "--only-missed", "--others-limit"}, command,
           "needs --variants");
    return bench(options);
  }
  refuse({"--checks"}, command, "can't be combined with --variants");
  if (options.settings.checkers.size() > 1) {
    throw CLI::ValidationError("--checker", "variants are run with one checker only");
  }
  if (!options.write.empty()) {
    refuse({"--planner", "--seeds", "--threads", "--time-limit", "--checker", "--check-paths",
            "--only-missed", "--others-limit", "--set", "--out", "--postures"},
           command, "can't be combined with --write, which runs no planner");
    return write_variants(options);
  }
  if (command.count("--others-limit") == 0) {
    options.variants.others_time_limit_s = options.settings.time_limit_s;
  }
  return bench_variants(options);
}

void add_variant_options(CLI::App& command, BenchOptions& options) {
  VariantSettings& variants = options.variants;
  command
      .add_option(
          "--variants", variants.count,
          "Run this number of harder variants of each problem instead (12 if no number is given)")
      ->expected(0, 1)
      ->default_str("12")
      ->check(CLI::Range(1, 10000));
  command.add_option("--variant-seed", variants.seed, "Seed of the variants")
      ->check(not_negative())
      ->capture_default_str();
  command.add_flag("--only-missed", variants.only_missed,
                   "Run the other planners only on variants and seeds that the scene's own planner "
                   "did not solve");
  command
      .add_option(
          "--others-limit", variants.others_time_limit_s,
          "Seconds before a run of another planner on a variant gives up (default: --time-limit)")
      ->check(positive_number());
  command.add_option("--write", options.write,
                     "Write the variants as scene files to this folder, without running a planner");
}

}  // namespace

void add_bench_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command =
      app.add_subcommand("bench", "Measure the times of collision checks and planners");
  command->add_option(
      "scenes", options->scenes,
      "Scene or problem files (default: the scenes that ship and, if HANDWAY_REFERENCE_DIR is set, "
      "the published problems); or one campaign file");
  command
      ->add_option("--planner", options->planners,
                   "Planner to compare with the scene's own; \"all\": every planner, including "
                   "those of plugins")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      ->add_option("--seeds", options->settings.seeds,
                   "Runs of each planner on each scene, with seeds from 1 to this number")
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
                   "Collision checker of the planners. fast: the default checker; fcl: FCL on "
                   "every pair of bodies; fcl-broadphase: FCL behind its broad phase")
      ->check(CLI::IsMember(checker_kinds()))
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->capture_default_str();
  command->add_flag("--check-paths", options->settings.check_paths,
                    "Check every path with FCL at configurations 1 mm apart");
  command->add_flag("--checks", options->checks_only,
                    "Measure collision checks only, without plans");
  command->add_option("--out", options->out,
                      "Folder for bench.csv and bench.json, or for a campaign's runs and report");
  command
      ->add_option("--set", options->sets,
                   "Parameter of the scene's own planner, KEY=VALUE; or a hand basis, basis=FILE")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--postures", options->postures,
                      "Recorded postures to compare hands with (default: those of the hand bases)");
  add_group_option(*command, options->group);
  add_variant_options(*command, *options);
  command->add_option("--motionbenchmaker", options->motion_bench_maker,
                      "Run all problems of MotionBenchMaker below this folder as a campaign");
  command->add_option("--paths", options->paths,
                      "Check paths of other planners on the problems of a campaign: a table "
                      "(.csv), or a folder with a file for each path");
  command->add_flag("--resume", options->resume, "Continue the campaign whose runs are in --out");
  command
      ->add_option("--jobs", options->jobs,
                   "Simultaneous runs of a campaign (default: one per core)")
      ->check(CLI::Range(1, 1024));
  command->callback(
      [options, command, &exit_code] { exit_code = bench_or_campaign(*options, *command); });
}

}  // namespace handway::tools
