#include "bench_table.h"

#include "handway/geometric/io/plural.h"
#include "handway/geometric/math/units.h"
#include "printing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace handway::tools {
namespace {

constexpr double kMega = 1e6;

// Three significant digits or a whole number; "-" for missing and infinite values.
report::Number shown(double value) {
  return {.value = std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN(),
          .digits = report::Digits::kThree};
}

report::Number milliseconds(double seconds) { return shown(1e3 * seconds); }

report::Number whole_percent(double share) { return report::fixed(100.0 * share, 0); }

std::string solved_text(const PlanBench& bench) {
  return fmt::format("{}/{}", solved_count(bench), bench.results.size());
}

// The source of the recorded motions that a planner's motions were compared with; `other` if none.
std::string recordings_of(const PlanBench& bench, const std::string& other) {
  const auto compared = std::ranges::find_if(bench.motions, [](const auto& motion) {
    return motion && motion->likeness.components.has_value();
  });
  return compared != bench.motions.end() ? (*compared)->recordings : other;
}

std::vector<report::Cell> motion_cells(const SceneBench& scene, const PlanBench& bench,
                                       bool several_checkers) {
  const MotionMedians m = motion_medians(bench);
  return {scene.name(),
          several_checkers ? fmt::format("{}, {}", bench.planner, bench.checker) : bench.planner,
          shown(m.duration),
          shown(m.hand_log_dimensionless_jerk),
          shown(m.palm_log_dimensionless_jerk),
          shown(m.hand_spectral_arc_length),
          shown(m.palm_spectral_arc_length),
          shown(m.arm_deviation),
          shown(geometric::millimetres(m.palm_deviation)),
          shown(m.component_error),
          shown(m.recorded_error),
          shown(m.warped_distance),
          shown(m.largest_warped_distance)};
}

std::size_t name_width(const std::vector<std::filesystem::path>& files) {
  std::size_t width = 0;
  for (const std::filesystem::path& file : files) {
    width = std::max(width, file.stem().string().size());
  }
  return width;
}

// Adds columns of numbers to those of names. Their widths are those of the widest usual numbers:
// the rows become known one after the other.
report::TextTable table_of(std::vector<report::TextTable::Layout> layout,
                           const std::vector<std::pair<report::Column, std::size_t>>& numbers) {
  for (const auto& [column, width] : numbers) {
    layout.push_back({column, width});
  }
  return report::TextTable(std::move(layout));
}

}  // namespace

BenchTable::BenchTable(const BenchSettings& settings,
                       const std::vector<std::filesystem::path>& files)
    : settings_(settings),
      collisions_(table_of({{"scene", name_width(files), false}}, {{{"load", "ms"}, 7},
                                                                   {{"memory", "MB"}, 9},
                                                                   {{"collide", "%"}, 9},
                                                                   {"config", 6},
                                                                   {"FCL", 6},
                                                                   {"ratio", 5},
                                                                   {"FCL broad", 9},
                                                                   {"ratio", 5},
                                                                   {{"free", "%"}, 6},
                                                                   {"edge", 6},
                                                                   {"FCL", 6},
                                                                   {"ratio", 5}})),
      plans_(table_of(
          {{"scene", name_width(files), false}, {"planner", 18, false}, {"checker", 14, false}},
          {{"solved", 8},
           {"median", 8},
           {"p95", 8},
           {"p99", 8},
           {"ratio", 6},
           {"checks", 9},
           {"samples", 9},
           {"nodes", 6},
           {"length", 7},
           {"to PMDs", 7},
           {{"memory", "MB"}, 9}})),
      motions_(table_of({{"scene", name_width(files), false}, {"planner", 18, false}},
                        {{{"time", "s"}, 7},
                         {"LDLJ hand", 9},
                         {"palm", 6},
                         {"SPARC hand", 10},
                         {"palm", 6},
                         {"arm", 6},
                         {{"palm", "mm"}, 8},
                         {{"fPCA", "rad"}, 9},
                         {{"recorded", "rad"}, 13},
                         {"DTW", 6},
                         {"largest", 7}})),
      variants_(table_of({{"problem", name_width(files), false}, {"planner", 18, false}},
                         {{"solved", 8},
                          {"median", 8},
                          {"p95", 8},
                          {"checks", 9},
                          {"samples", 9},
                          {"nodes", 6}})) {}

void BenchTable::begin_collisions() const {
  print_out(
      "Collision checks, µs: configurations near the motion from start to goal; edges of a tenth "
      "of its length.\n{}",
      collisions_.header());
  std::fflush(stdout);
}

void BenchTable::add_collision(const SceneBench& scene) const {
  const CollisionBench& bench = scene.collision;
  print_out("{}", collisions_.row(
                      {scene.name(), milliseconds(scene.load_s),
                       shown(static_cast<double>(scene.memory) / kMega),
                       whole_percent(bench.in_collision), shown(bench.fast.configuration_us),
                       shown(bench.fcl.configuration_us),
                       shown(bench.fcl.configuration_us / bench.fast.configuration_us),
                       shown(bench.fcl_broadphase_configuration_us),
                       shown(bench.fcl_broadphase_configuration_us / bench.fast.configuration_us),
                       bench.edges > 0 ? whole_percent(bench.edges_free) : report::Number{},
                       shown(bench.fast.edge_us), shown(bench.fcl.edge_us),
                       shown(bench.fcl.edge_us / bench.fast.edge_us)}));
  if (bench.disagreements > 0) {
    print_out("  FAULT: the checkers disagree on {} of {} configurations\n", bench.disagreements,
              bench.configurations);
  }
  std::fflush(stdout);
}

void BenchTable::begin_plans() const {
  print_out(
      "\nPlans: {}, {}, limit {:g} s; planning and smoothing in ms (a run without a path counts as "
      "infinite).\n{}",
      geometric::plural(settings_.seeds, "seed"), geometric::plural(settings_.threads, "thread"),
      settings_.time_limit_s, plans_.header());
  std::fflush(stdout);
}

void BenchTable::add_plan(const SceneBench& scene, std::size_t i) const {
  const PlanBench& bench = scene.plans[i];
  print_out("{}", plans_.row({scene.name(), bench.planner, bench.checker, solved_text(bench),
                              milliseconds(time_quantile(bench, 0.5)),
                              milliseconds(time_quantile(bench, 0.95)),
                              milliseconds(time_quantile(bench, 0.99)), shown(time_ratio(scene, i)),
                              shown(median_checks(bench)), shown(median_samples(bench)),
                              shown(median_path_nodes(bench)), shown(median_length(bench)),
                              shown(median_to_subspace(bench)),
                              shown(static_cast<double>(bench.memory) / kMega)}));
  const auto failed = std::ranges::find_if(
      bench.results, [](const planning::PlanResult& result) { return !result.solved(); });
  if (!bench.problem.empty()) {
    print_out("  not run: {}\n", bench.problem);
  } else if (failed != bench.results.end()) {
    print_out("  {}\n", failed->reason);
  }
  if (settings_.check_paths) {
    add_faults(bench);
  }
  std::fflush(stdout);
}

void BenchTable::add_motions(const std::vector<SceneBench>& scenes) const {
  std::string rows;
  std::string recordings;
  for (const SceneBench& scene : scenes) {
    for (const PlanBench& bench : scene.plans) {
      if (solved_count(bench) > 0) {
        rows += motions_.row(motion_cells(scene, bench, settings_.checkers.size() > 1));
        recordings = recordings_of(bench, recordings);
      }
    }
  }
  if (rows.empty()) {
    return;
  }
  print_out(
      "\nMotions: medians of the paths found, timed with limited jerk. Smoothness (nearer to 0: "
      "smoother), deviation from the straight motion, error by components of recorded motions, "
      "distance between seeds.\n{}{}",
      motions_.header(), rows);
  if (!recordings.empty()) {
    print_out("  Recorded motions: {}\n", recordings);
  }
}

void BenchTable::begin_variants(const VariantSettings& variants) const {
  print_out(
      "{} variants of each problem, seed {}; {} each, {}, limit {:g} s{}; planning and smoothing "
      "in "
      "ms (a run without a path counts as infinite).\n{}",
      variants.count, variants.seed, geometric::plural(settings_.seeds, "seed"),
      geometric::plural(settings_.threads, "thread"), settings_.time_limit_s,
      variants.others_time_limit_s == settings_.time_limit_s
          ? ""
          : fmt::format(", for other planners {:g} s", variants.others_time_limit_s),
      variants_.header());
  std::fflush(stdout);
}

void BenchTable::add_variants(const VariantBench& bench) const {
  for (const PlanBench& plan : merged_plans(bench)) {
    if (plan.results.empty() && plan.problem.empty()) {
      continue;  // nothing was left for it
    }
    print_out("{}",
              variants_.row({bench.name(), plan.planner, solved_text(plan),
                             milliseconds(time_quantile(plan, 0.5)),
                             milliseconds(time_quantile(plan, 0.95)), shown(median_checks(plan)),
                             shown(median_samples(plan)), shown(median_path_nodes(plan))}));
    if (!plan.problem.empty()) {
      print_out("  not run: {}\n", plan.problem);
    }
    if (settings_.check_paths) {
      add_faults(plan);
    }
  }
  for (const VariantRuns& runs : bench.variants) {
    if (!runs.variant.scene) {
      print_out("  variant {}: no free start and goal in {} samples\n", runs.variant.number,
                runs.variant.draws);
    }
  }
  for (const MissedPair& pair : summary_of(bench).missed) {
    std::string others;
    for (const auto& [planner, time_s] : pair.solved_by) {
      others +=
          fmt::format("{}{} in {:.3g} s", others.empty() ? "solved by " : ", ", planner, time_s);
    }
    print_out("  missed: variant {}, seed {}; {}\n", pair.variant, pair.seed,
              others.empty() ? "solved by no planner" : others);
  }
  std::fflush(stdout);
}

void BenchTable::add_summary(const VariantSummary& summary) const {
  print_out(
      "\n{} pairs of variant and seed, {} solved by any planner; of these the scene's own planner "
      "solves {} ({:.1f} %)\n",
      summary.pairs, summary.solved_by_any, summary.solved_by_default,
      summary.solved_by_any > 0 ? 100.0 * summary.default_share() : 0.0);
}

void BenchTable::add_faults(const PlanBench& bench) const {
  const int faulty = faulty_count(bench);
  print_out("  {} of {} paths valid at 1 mm\n", solved_count(bench) - faulty, solved_count(bench));
  for (std::size_t i = 0; i < bench.path_faults.size(); ++i) {
    if (!bench.path_faults[i].empty()) {
      print_out("  FAULT: seed {}: {}\n", bench.seeds[i], bench.path_faults[i].front());
    }
  }
}

}  // namespace handway::tools
