#include "bench_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace handway::tools {
namespace {

constexpr double kMega = 1e6;

// Three significant digits or a whole number; "-" for what does not exist.
std::string shown(double value) {
  if (!std::isfinite(value)) {
    return "-";
  }
  return std::abs(value) < 100.0 ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", value);
}

std::string milliseconds(double seconds) { return shown(1e3 * seconds); }

}  // namespace

BenchTable::BenchTable(const BenchSettings& settings,
                       const std::vector<std::filesystem::path>& files)
    : settings_(settings), width_(5) {
  for (const std::filesystem::path& file : files) {
    width_ = std::max(width_, static_cast<int>(file.stem().string().size()));
  }
}

void BenchTable::begin_collisions() const {
  fmt::print(
      "Collision, \u00b5s: a configuration near the way from start to goal; an edge of a tenth of "
      "it.\n"
      "{:<{}} {:>7} {:>9} | {:>9} {:>6} {:>6} {:>5} {:>9} {:>5} | {:>6} {:>6} {:>6} {:>5}\n",
      "scene", width_, "load ms", "memory MB", "collide %", "config", "FCL", "ratio", "FCL broad",
      "ratio", "free %", "edge", "FCL", "ratio");
  std::fflush(stdout);
}

void BenchTable::add_collision(const SceneBench& scene) const {
  const CollisionBench& bench = scene.collision;
  fmt::print(
      "{:<{}} {:>7} {:>9} | {:>9.0f} {:>6} {:>6} {:>5} {:>9} {:>5} | {:>6} {:>6} {:>6} {:>5}\n",
      scene.name(), width_, milliseconds(scene.load_s),
      shown(static_cast<double>(scene.memory) / kMega), 100.0 * bench.in_collision,
      shown(bench.fast.configuration_us), shown(bench.fcl.configuration_us),
      shown(bench.fcl.configuration_us / bench.fast.configuration_us),
      shown(bench.fcl_broadphase_configuration_us),
      shown(bench.fcl_broadphase_configuration_us / bench.fast.configuration_us),
      bench.edges > 0 ? fmt::format("{:.0f}", 100.0 * bench.edges_free) : "-",
      shown(bench.fast.edge_us), shown(bench.fcl.edge_us),
      shown(bench.fcl.edge_us / bench.fast.edge_us));
  if (bench.disagreements > 0) {
    fmt::print("  FAULT: the checkers disagree on {} of {} configurations\n", bench.disagreements,
               bench.configurations);
  }
  std::fflush(stdout);
}

void BenchTable::begin_plans() const {
  fmt::print(
      "\nPlans: {} seed{}, {} thread{}, limit {:g} s; planning and smoothing in ms (a run without "
      "a path counts as endless).\n"
      "{:<{}} {:<18} {:<14} {:>8} {:>8} {:>8} {:>8} {:>6} {:>9} {:>9} {:>6} {:>7} {:>7} {:>9}\n",
      settings_.seeds, settings_.seeds == 1 ? "" : "s", settings_.threads,
      settings_.threads == 1 ? "" : "s", settings_.time_limit_s, "scene", width_, "planner",
      "checker", "solved", "median", "p95", "p99", "ratio", "checks", "samples", "nodes", "length",
      "to PMDs", "memory MB");
  std::fflush(stdout);
}

void BenchTable::add_plan(const SceneBench& scene, std::size_t i) const {
  const PlanBench& bench = scene.plans[i];
  fmt::print(
      "{:<{}} {:<18} {:<14} {:>8} {:>8} {:>8} {:>8} {:>6} {:>9} {:>9} {:>6} {:>7} {:>7} {:>9}\n",
      scene.name(), width_, bench.planner, bench.checker,
      fmt::format("{}/{}", solved_count(bench), bench.results.size()),
      milliseconds(time_quantile(bench, 0.5)), milliseconds(time_quantile(bench, 0.95)),
      milliseconds(time_quantile(bench, 0.99)), shown(time_ratio(scene, i)),
      shown(median_checks(bench)), shown(median_samples(bench)), shown(median_path_nodes(bench)),
      shown(median_length(bench)), shown(median_to_subspace(bench)),
      shown(static_cast<double>(bench.memory) / kMega));
  const auto failed = std::ranges::find_if(
      bench.results, [](const planning::PlanResult& result) { return !result.solved(); });
  if (!bench.problem.empty()) {
    fmt::print("  not run: {}\n", bench.problem);
  } else if (failed != bench.results.end()) {
    fmt::print("  {}\n", failed->reason);
  }
  if (settings_.check_paths) {
    add_faults(bench);
  }
  std::fflush(stdout);
}

void BenchTable::begin_variants(const VariantSettings& variants) const {
  fmt::print(
      "{} variants of each problem, drawn from seed {}; {} seed{} each, {} thread{}, limit {:g} s"
      "{}; planning and smoothing in ms (a run without a path counts as endless).\n"
      "{:<{}} {:<18} {:>8} {:>8} {:>8} {:>9} {:>9} {:>6}\n",
      variants.count, variants.seed, settings_.seeds, settings_.seeds == 1 ? "" : "s",
      settings_.threads, settings_.threads == 1 ? "" : "s", settings_.time_limit_s,
      variants.others_time_limit_s == settings_.time_limit_s
          ? ""
          : fmt::format(", of other planners {:g} s", variants.others_time_limit_s),
      "problem", width_, "planner", "solved", "median", "p95", "checks", "samples", "nodes");
  std::fflush(stdout);
}

void BenchTable::add_variants(const VariantBench& bench) const {
  for (const PlanBench& plan : merged_plans(bench)) {
    if (plan.results.empty() && plan.problem.empty()) {
      continue;  // nothing was left for it
    }
    fmt::print("{:<{}} {:<18} {:>8} {:>8} {:>8} {:>9} {:>9} {:>6}\n", bench.name(), width_,
               plan.planner, fmt::format("{}/{}", solved_count(plan), plan.results.size()),
               milliseconds(time_quantile(plan, 0.5)), milliseconds(time_quantile(plan, 0.95)),
               shown(median_checks(plan)), shown(median_samples(plan)),
               shown(median_path_nodes(plan)));
    if (!plan.problem.empty()) {
      fmt::print("  not run: {}\n", plan.problem);
    }
    if (settings_.check_paths) {
      add_faults(plan);
    }
  }
  for (const VariantRuns& runs : bench.variants) {
    if (!runs.variant.scene) {
      fmt::print("  variant {}: no free start and goal in {} draws\n", runs.variant.number,
                 runs.variant.draws);
    }
  }
  for (const MissedPair& pair : summary_of(bench).missed) {
    std::string others;
    for (const auto& [planner, time_s] : pair.solved_by) {
      others +=
          fmt::format("{}{} in {:.3g} s", others.empty() ? "solved by " : ", ", planner, time_s);
    }
    fmt::print("  missed: variant {}, seed {}; {}\n", pair.variant, pair.seed,
               others.empty() ? "solved by none" : others);
  }
  std::fflush(stdout);
}

void BenchTable::add_summary(const VariantSummary& summary) const {
  fmt::print(
      "\n{} pairs of variant and seed, {} solved by any planner; of these the default solves "
      "{} ({:.1f} %)\n",
      summary.pairs, summary.solved_by_any, summary.solved_by_default,
      summary.solved_by_any > 0 ? 100.0 * summary.default_share() : 0.0);
}

void BenchTable::add_faults(const PlanBench& bench) const {
  const int faulty = faulty_count(bench);
  fmt::print("  {} of {} paths valid at 1 mm\n", solved_count(bench) - faulty, solved_count(bench));
  for (std::size_t i = 0; i < bench.path_faults.size(); ++i) {
    if (!bench.path_faults[i].empty()) {
      fmt::print("  FAULT: seed {}: {}\n", bench.seeds[i], bench.path_faults[i].front());
    }
  }
}

}  // namespace handway::tools
