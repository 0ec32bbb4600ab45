#include "plan_bench.h"

#include "handway/geometric/io/input_error.h"
#include "handway/planning/paths/path_check.h"
#include "machine.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace handway::tools {
namespace {

using planning::PlanResult;
using planning::PlanStatus;

constexpr double kBenchResolution = 1e-3;  // m

double quantile(std::vector<double> values, double p) {
  if (values.empty()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(p * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(rank, 1) - 1];
}

template <typename Value>
double median_of(const PlanBench& bench, const Value& value) {
  std::vector<double> values;
  values.reserve(bench.results.size());
  for (const PlanResult& result : bench.results) {
    values.push_back(static_cast<double>(value(result.statistics)));
  }
  return quantile(std::move(values), 0.5);
}

template <typename Value>
double median_of_paths(const PlanBench& bench, const Value& value) {
  std::vector<double> values;
  for (const auto& quality : bench.qualities) {
    if (quality) {
      values.push_back(value(*quality));
    }
  }
  return quantile(std::move(values), 0.5);
}

template <typename Value>
void append_to(std::vector<Value>& all, const std::vector<Value>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

PlanBench bench_planner(planning::Planner& planner,
                        const std::function<planning::PlanningProblem()>& make_problem,
                        planning::PlanRequest request, const std::vector<std::uint64_t>& seeds,
                        bool checked,
                        const std::shared_ptr<const sampling::RecordedPostures>& recorded) {
  PlanBench bench;
  bench.planner = planner.name();
  reset_peak_memory();
  try {
    for (const std::uint64_t seed : seeds) {
      request.seed = seed;
      const planning::PlanningProblem problem = make_problem();
      PlanResult result = planner.plan(problem, request);
      bench.seeds.push_back(request.seed);
      bench.path_nodes.push_back(result.path.waypoints.size());
      bench.qualities.push_back(result.solved() ? std::optional(path_quality(problem, result.path))
                                                : std::nullopt);
      bench.motions.push_back(measure_motion(problem, result.path, recorded));
      bench.path_faults.emplace_back();
      if (checked && result.solved()) {
        bench.path_faults.back() = check_path(problem, result.path, kBenchResolution).faults;
      }
      result.path.waypoints.clear();
      bench.results.push_back(std::move(result));
      const PlanStatus status = bench.results.back().status;
      if (status == PlanStatus::kStartInvalid || status == PlanStatus::kGoalInvalid) {
        break;
      }
    }
  } catch (const geometric::InputError& error) {  // it needs what the scene has not
    bench.problem = error.what();
  }
  bench.memory = peak_memory();
  return bench;
}

int solved_count(const PlanBench& bench) {
  return static_cast<int>(
      std::ranges::count_if(bench.results, [](const PlanResult& r) { return r.solved(); }));
}

int faulty_count(const PlanBench& bench) {
  return static_cast<int>(
      std::ranges::count_if(bench.path_faults, [](const auto& faults) { return !faults.empty(); }));
}

double time_quantile(const PlanBench& bench, double p) {
  std::vector<double> times;
  times.reserve(bench.results.size());
  for (const PlanResult& result : bench.results) {
    times.push_back(result.solved() ? result.time_s + result.smoothing_s
                                    : std::numeric_limits<double>::infinity());
  }
  return quantile(std::move(times), p);
}

double median_samples(const PlanBench& bench) {
  return median_of(bench, [](const planning::PlanStatistics& s) { return s.samples; });
}

double median_checks(const PlanBench& bench) {
  return median_of(bench,
                   [](const planning::PlanStatistics& s) { return s.node_checks + s.edge_checks; });
}

double median_path_nodes(const PlanBench& bench) {
  std::vector<double> nodes;
  for (std::size_t i = 0; i < bench.results.size(); ++i) {
    if (bench.results[i].solved()) {
      nodes.push_back(static_cast<double>(bench.path_nodes[i]));
    }
  }
  return quantile(std::move(nodes), 0.5);
}

double median_length(const PlanBench& bench) {
  return median_of_paths(bench, [](const planning::PathQuality& path) { return path.length; });
}

double median_to_subspace(const PlanBench& bench) {
  return median_of_paths(bench, [](const planning::PathQuality& path) {
    return path.human_likeness ? path.human_likeness->mean
                               : std::numeric_limits<double>::quiet_NaN();
  });
}

namespace {

// Median over the runs that have this measure, or NaN.
template <typename Value>
double median_of_motions(const PlanBench& bench, const Value& value) {
  std::vector<double> values;
  for (const auto& motion : bench.motions) {
    if (motion && motion->fault.empty()) {
      if (const std::optional<double> measured = value(motion->likeness)) {
        values.push_back(*measured);
      }
    }
  }
  return quantile(std::move(values), 0.5);
}

// Returns a getter of `value` of an optional measure.
template <typename Measure>
auto part(std::optional<Measure> planning::MotionLikeness::*measure, double Measure::*value) {
  return [measure, value](const planning::MotionLikeness& likeness) {
    const std::optional<Measure>& measured = likeness.*measure;
    return measured ? std::optional((*measured).*value) : std::nullopt;
  };
}

std::optional<planning::MotionSpread> spread_of(const PlanBench& bench) {
  std::vector<Eigen::MatrixXd> motions;
  for (const auto& motion : bench.motions) {
    if (motion && motion->fault.empty()) {
      motions.push_back(motion->motion);
    }
  }
  return planning::motion_spread(motions);
}

}  // namespace

MotionMedians motion_medians(const PlanBench& bench) {
  using planning::ComponentError;
  using planning::MotionLikeness;
  using planning::MovementSmoothness;
  using planning::StraightDeviation;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const auto median = [&](auto measure, auto value) {
    return median_of_motions(bench, part(measure, value));
  };
  const std::optional<planning::MotionSpread> spread = spread_of(bench);
  return {
      .duration = median_of_motions(
          bench, [](const MotionLikeness& likeness) { return std::optional(likeness.duration); }),
      .hand_log_dimensionless_jerk =
          median(&MotionLikeness::hand, &MovementSmoothness::log_dimensionless_jerk),
      .palm_log_dimensionless_jerk =
          median(&MotionLikeness::palm, &MovementSmoothness::log_dimensionless_jerk),
      .hand_spectral_arc_length =
          median(&MotionLikeness::hand, &MovementSmoothness::spectral_arc_length),
      .palm_spectral_arc_length =
          median(&MotionLikeness::palm, &MovementSmoothness::spectral_arc_length),
      .arm_deviation = median(&MotionLikeness::deviation, &StraightDeviation::arm),
      .palm_deviation = median(&MotionLikeness::deviation, &StraightDeviation::palm),
      .component_error = median(&MotionLikeness::components, &ComponentError::error),
      .recorded_error = median(&MotionLikeness::components, &ComponentError::recorded_median),
      .warped_distance = spread ? spread->median : kNone,
      .largest_warped_distance = spread ? spread->largest : kNone};
}

VariantSummary& VariantSummary::operator+=(const VariantSummary& other) {
  pairs += other.pairs;
  solved_by_any += other.solved_by_any;
  solved_by_default += other.solved_by_default;
  append_to(missed, other.missed);
  return *this;
}

double VariantSummary::default_share() const {
  return solved_by_any > 0
             ? static_cast<double>(solved_by_default) / static_cast<double>(solved_by_any)
             : std::numeric_limits<double>::quiet_NaN();
}

VariantSummary summary_of(const VariantBench& bench) {
  VariantSummary summary;
  for (const VariantRuns& runs : bench.variants) {
    if (runs.plans.empty()) {
      continue;
    }
    const PlanBench& own = runs.plans.front();
    for (std::size_t i = 0; i < own.results.size(); ++i) {
      ++summary.pairs;
      if (own.results[i].solved()) {
        ++summary.solved_by_any;
        ++summary.solved_by_default;
        continue;
      }
      MissedPair missed{
          bench.file.string(), runs.variant.number, own.seeds[i], own.results[i].reason, {}};
      for (std::size_t p = 1; p < runs.plans.size(); ++p) {
        const PlanBench& other = runs.plans[p];
        const auto run = std::ranges::find(other.seeds, missed.seed) - other.seeds.begin();
        if (run < std::ssize(other.results) &&
            other.results[static_cast<std::size_t>(run)].solved()) {
          missed.solved_by.emplace_back(other.planner,
                                        other.results[static_cast<std::size_t>(run)].time_s);
        }
      }
      summary.solved_by_any += missed.solved_by.empty() ? 0 : 1;
      summary.missed.push_back(std::move(missed));
    }
  }
  return summary;
}

std::vector<PlanBench> merged_plans(const VariantBench& bench) {
  std::vector<PlanBench> merged;
  for (const VariantRuns& runs : bench.variants) {
    for (std::size_t p = 0; p < runs.plans.size(); ++p) {
      if (p == merged.size()) {
        merged.push_back(runs.plans[p]);
        continue;
      }
      append_to(merged[p].seeds, runs.plans[p].seeds);
      append_to(merged[p].results, runs.plans[p].results);
      append_to(merged[p].path_nodes, runs.plans[p].path_nodes);
      append_to(merged[p].qualities, runs.plans[p].qualities);
      append_to(merged[p].motions, runs.plans[p].motions);
      append_to(merged[p].path_faults, runs.plans[p].path_faults);
      merged[p].memory = std::max(merged[p].memory, runs.plans[p].memory);
    }
  }
  return merged;
}

std::vector<std::uint64_t> unsolved_seeds(const PlanBench& bench) {
  std::vector<std::uint64_t> seeds;
  for (std::size_t i = 0; i < bench.results.size(); ++i) {
    if (!bench.results[i].solved()) {
      seeds.push_back(bench.seeds[i]);
    }
  }
  return seeds;
}

}  // namespace handway::tools
