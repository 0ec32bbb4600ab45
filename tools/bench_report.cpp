#include "bench_report.h"

#include "handway/geometric/math/units.h"
#include "handway/report/rendering/csv.h"
#include "plan_report.h"
#include "version.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <utility>

namespace handway::tools {
namespace {

using Json = nlohmann::ordered_json;

// Returns the ratio of median times of planning and smoothing.
double median_ratio(const PlanBench& first, const PlanBench& bench) {
  const double own = time_quantile(first, 0.5);
  const double other = time_quantile(bench, 0.5);
  return std::isfinite(own) && std::isfinite(other) && own > 0.0
             ? other / own
             : std::numeric_limits<double>::quiet_NaN();
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json speed_of(const CheckerSpeed& speed) {
  return {{"configuration_us", number(speed.configuration_us)}, {"edge_us", number(speed.edge_us)}};
}

Json collision_of(const CollisionBench& bench) {
  return {{"configurations", bench.configurations},
          {"in_collision", bench.in_collision},
          {"edges", bench.edges},
          {"edges_free", bench.edges_free},
          {"fast", speed_of(bench.fast)},
          {"fcl", speed_of(bench.fcl)},
          {"fcl_broadphase", {{"configuration_us", number(bench.fcl_broadphase_configuration_us)}}},
          {"disagreements", bench.disagreements}};
}

Json runs_of(const PlanBench& bench) {
  Json runs = Json::array();
  for (std::size_t i = 0; i < bench.results.size(); ++i) {
    const planning::PlanResult& result = bench.results[i];
    runs.push_back(
        {{"seed", bench.seeds[i]},
         {"solved", result.solved()},
         {"status", to_string(result.status)},
         {"reason", result.reason},
         {"time_s", result.time_s},
         {"smoothing_s", result.smoothing_s},
         {"samples", result.statistics.samples},
         {"node_checks", result.statistics.node_checks},
         {"edge_checks", result.statistics.edge_checks},
         {"path_nodes", bench.path_nodes[i]},
         {"objective", path_quality_json(bench.qualities[i])},
         {"motion", motion_json(bench.motions[i])},
         {"path_faults", bench.path_faults[i]},
         {"min_clearance_mm", geometric::millimetres(result.certificate.min_clearance)}});
  }
  return runs;
}

Json motions_of(const PlanBench& bench) {
  const MotionMedians medians = motion_medians(bench);
  return {{"duration_s", number(medians.duration)},
          {"hand_log_dimensionless_jerk", number(medians.hand_log_dimensionless_jerk)},
          {"palm_log_dimensionless_jerk", number(medians.palm_log_dimensionless_jerk)},
          {"hand_spectral_arc_length", number(medians.hand_spectral_arc_length)},
          {"palm_spectral_arc_length", number(medians.palm_spectral_arc_length)},
          {"arm_deviation", number(medians.arm_deviation)},
          {"palm_deviation_mm", number(geometric::millimetres(medians.palm_deviation))},
          {"component_error_rad", number(medians.component_error)},
          {"recorded_error_rad", number(medians.recorded_error)},
          {"warped_distance", number(medians.warped_distance)},
          {"largest_warped_distance", number(medians.largest_warped_distance)}};
}

Json plan_of(const BenchSettings& settings, const PlanBench& bench, double ratio) {
  return {{"planner", bench.planner},
          {"checker", bench.checker},
          {"problem", bench.problem},
          {"solved", solved_count(bench)},
          {"paths_checked", settings.check_paths},
          {"paths_with_faults", faulty_count(bench)},
          {"median_s", number(time_quantile(bench, 0.5))},
          {"p95_s", number(time_quantile(bench, 0.95))},
          {"p99_s", number(time_quantile(bench, 0.99))},
          {"ratio", number(ratio)},
          {"samples", number(median_samples(bench))},
          {"checks", number(median_checks(bench))},
          {"path_nodes", number(median_path_nodes(bench))},
          {"length", number(median_length(bench))},
          {"to_subspace", number(median_to_subspace(bench))},
          {"motion", motions_of(bench)},
          {"memory_bytes", bench.memory},
          {"runs", runs_of(bench)}};
}

Json plans_of(const BenchSettings& settings, const std::vector<PlanBench>& benches) {
  Json plans = Json::array();
  for (const PlanBench& bench : benches) {
    plans.push_back(plan_of(settings, bench, median_ratio(benches.front(), bench)));
  }
  return plans;
}

Json summary_of_pairs(const VariantSummary& summary) {
  Json missed = Json::array();
  for (const MissedPair& pair : summary.missed) {
    Json solved_by = Json::array();
    for (const auto& [planner, time_s] : pair.solved_by) {
      solved_by.push_back({{"planner", planner}, {"time_s", time_s}});
    }
    missed.push_back({{"file", pair.file},
                      {"variant", pair.variant},
                      {"seed", pair.seed},
                      {"reason", pair.reason},
                      {"solved_by", solved_by}});
  }
  return {{"pairs", summary.pairs},
          {"solved_by_any", summary.solved_by_any},
          {"solved_by_default", summary.solved_by_default},
          {"default_share", number(summary.default_share())},
          {"missed_by_default", missed}};
}

Json variants_of(const BenchSettings& settings, const VariantBench& bench) {
  Json variants = Json::array();
  for (const VariantRuns& runs : bench.variants) {
    variants.push_back({{"variant", runs.variant.number},
                        {"found", runs.variant.scene != nullptr},
                        {"draws", runs.variant.draws},
                        {"gap_mm", geometric::millimetres(variant_gap(runs.variant.number))},
                        {"plans", plans_of(settings, runs.plans)}});
  }
  return {{"scene", bench.name()},
          {"file", bench.file.string()},
          {"target", bench.target},
          {"summary", summary_of_pairs(summary_of(bench))},
          {"variants", variants}};
}

std::vector<report::Cell> scene_cells(const SceneBench& scene) {
  return {scene.name(),
          scene.load_s,
          scene.memory,
          scene.collision.fast.configuration_us,
          scene.collision.fcl.configuration_us,
          scene.collision.fcl_broadphase_configuration_us,
          scene.collision.fast.edge_us,
          scene.collision.fcl.edge_us};
}

std::vector<report::Cell> plan_cells(const BenchSettings& settings, const SceneBench& scene,
                                     std::size_t i) {
  const PlanBench& bench = scene.plans[i];
  const MotionMedians motion = motion_medians(bench);
  return {bench.planner,
          bench.checker,
          settings.threads,
          settings.time_limit_s,
          bench.results.size(),
          solved_count(bench),
          settings.check_paths ? report::Cell(faulty_count(bench)) : report::Cell(),
          time_quantile(bench, 0.5),
          time_quantile(bench, 0.95),
          time_quantile(bench, 0.99),
          time_ratio(scene, i),
          median_samples(bench),
          median_checks(bench),
          median_path_nodes(bench),
          median_length(bench),
          median_to_subspace(bench),
          motion.duration,
          motion.hand_log_dimensionless_jerk,
          motion.palm_log_dimensionless_jerk,
          motion.hand_spectral_arc_length,
          motion.palm_spectral_arc_length,
          motion.arm_deviation,
          geometric::millimetres(motion.palm_deviation),
          motion.component_error,
          motion.recorded_error,
          motion.warped_distance,
          motion.largest_warped_distance,
          bench.memory};
}

}  // namespace

double time_ratio(const SceneBench& scene, std::size_t i) {
  return median_ratio(scene.plans.front(), scene.plans[i]);
}

std::string bench_csv(const BenchSettings& settings, const std::vector<SceneBench>& scenes) {
  report::Table table{{"scene",
                       "load_s",
                       "load_memory_bytes",
                       "configuration_us",
                       "configuration_fcl_us",
                       "configuration_fcl_broadphase_us",
                       "edge_us",
                       "edge_fcl_us",
                       "planner",
                       "checker",
                       "threads",
                       "time_limit_s",
                       "runs",
                       "solved",
                       "paths_with_faults",
                       "median_s",
                       "p95_s",
                       "p99_s",
                       "ratio",
                       "samples",
                       "checks",
                       "path_nodes",
                       "length",
                       "to_subspace",
                       "duration_s",
                       "hand_log_dimensionless_jerk",
                       "palm_log_dimensionless_jerk",
                       "hand_spectral_arc_length",
                       "palm_spectral_arc_length",
                       "arm_deviation",
                       "palm_deviation_mm",
                       "component_error_rad",
                       "recorded_error_rad",
                       "warped_distance",
                       "largest_warped_distance",
                       "memory_bytes"}};
  for (const SceneBench& scene : scenes) {
    if (scene.plans.empty()) {
      table.rows.push_back(scene_cells(scene));
    }
    for (std::size_t i = 0; i < scene.plans.size(); ++i) {
      std::vector<report::Cell> row = scene_cells(scene);
      for (report::Cell& cell : plan_cells(settings, scene, i)) {
        row.push_back(std::move(cell));
      }
      table.rows.push_back(std::move(row));
    }
  }
  return report::to_csv(table);
}

std::string bench_json(const BenchSettings& settings, const std::vector<SceneBench>& scenes) {
  Json list = Json::array();
  for (const SceneBench& scene : scenes) {
    list.push_back({{"scene", scene.name()},
                    {"file", scene.file.string()},
                    {"load_s", scene.load_s},
                    {"load_memory_bytes", scene.memory},
                    {"collision", collision_of(scene.collision)},
                    {"plans", plans_of(settings, scene.plans)}});
  }
  const Json report = {{"version", kVersion},
                       {"seeds", settings.seeds},
                       {"threads", settings.threads},
                       {"time_limit_s", settings.time_limit_s},
                       {"scenes", list}};
  return report.dump(2) + "\n";
}

std::string variants_json(const BenchSettings& settings, const VariantSettings& variants,
                          const std::vector<VariantBench>& benches) {
  Json list = Json::array();
  VariantSummary total;
  for (const VariantBench& bench : benches) {
    list.push_back(variants_of(settings, bench));
    total += summary_of(bench);
  }
  const Json report = {{"version", kVersion},
                       {"variants", variants.count},
                       {"variant_seed", variants.seed},
                       {"seeds", settings.seeds},
                       {"threads", settings.threads},
                       {"time_limit_s", settings.time_limit_s},
                       {"others_time_limit_s", variants.others_time_limit_s},
                       {"others_only_where_missed", variants.only_missed},
                       {"summary", summary_of_pairs(total)},
                       {"scenes", list}};
  return report.dump(2) + "\n";
}

}  // namespace handway::tools
