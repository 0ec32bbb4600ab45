#include "plan_bench.h"

#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/collision/continuous/continuous_collision_checker.h"
#include "handway/geometric/collision/continuous/motion_bound.h"
#include "handway/geometric/io/input_error.h"
#include "handway/planning/campaigns/campaign_statistics.h"
#include "handway/planning/paths/path_check.h"
#include "machine.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <random>
#include <vector>

namespace handway::tools {
namespace {

using geometric::CollisionChecker;
using geometric::CollisionWorld;
using geometric::Configuration;

constexpr int kConfigurations = 256;
constexpr std::size_t kEdges = 24;
constexpr double kSpread = 0.05;      // share of a joint's range
constexpr double kEdge = 0.1;         // share of the motion from start to goal
constexpr double kResolution = 5e-5;  // m, as planners have it
constexpr int kRounds = 5;
constexpr double kLeastTime = 0.05;  // s that a round takes; all questions are asked once at least

std::vector<Configuration> draw(const CollisionWorld& world, const Configuration& start,
                                const Configuration& goal) {
  const geometric::RobotModel& model = world.model();
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Configuration> configurations;
  for (int k = 0; k < kConfigurations; ++k) {
    Configuration q = start + uniform(engine) * (goal - start);
    for (int v = 0; v < model.variable_count(); ++v) {
      q[v] += kSpread * (2.0 * uniform(engine) - 1.0) * (model.upper()[v] - model.lower()[v]);
    }
    configurations.push_back(q);
  }
  return configurations;
}

// Queries to one checker.
struct Series {
  std::size_t count;
  std::function<void(std::size_t)> ask;
  std::vector<double> rounds;  // µs a question

  [[nodiscard]] double median() const { return planning::quantile_of(rounds, 0.5); }
};

// Runs all queries again and again. @returns µs per query.
double time_of(const Series& series) {
  if (series.count == 0) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const auto begin = std::chrono::steady_clock::now();
  std::chrono::duration<double> elapsed{};
  int times = 0;
  do {
    for (std::size_t i = 0; i < series.count; ++i) {
      series.ask(i);
    }
    ++times;
    elapsed = std::chrono::steady_clock::now() - begin;
  } while (elapsed.count() < kLeastTime);
  return 1e6 * elapsed.count() / (static_cast<double>(times) * static_cast<double>(series.count));
}

// The checkers take turns, so that other load of the machine slows all of them equally.
void measure(std::initializer_list<Series*> all) {
  for (int round = 0; round < kRounds; ++round) {
    for (Series* series : all) {
      series->rounds.push_back(time_of(*series));
    }
  }
}

struct Questions {
  std::vector<Configuration> configurations;
  std::vector<Configuration> edge_starts;
  Configuration motion;  ///< Motion of every edge.
};

Series configurations_for(CollisionChecker& checker, const Questions& questions) {
  return {questions.configurations.size(),
          [&](std::size_t i) {
            static_cast<void>(checker.first_collision(questions.configurations[i]));
          },
          {}};
}

Series edges_for(geometric::ContinuousCollisionChecker& edges, const Questions& questions) {
  return {questions.edge_starts.size(),
          [&](std::size_t i) {
            const Configuration& from = questions.edge_starts[i];
            static_cast<void>(edges.check(from, from + questions.motion));
          },
          {}};
}

}  // namespace

CollisionBench bench_collision(const std::shared_ptr<const CollisionWorld>& world,
                               const Configuration& start, const Configuration& goal) {
  using enum geometric::CheckerKind;
  const std::unique_ptr<CollisionChecker> fast = make_collision_checker(world, kFast);
  const std::unique_ptr<CollisionChecker> fcl = make_collision_checker(world, kFcl);
  const std::unique_ptr<CollisionChecker> broad = make_collision_checker(world, kFclBroadphase);
  Questions questions;
  questions.configurations = draw(*world, start, goal);
  questions.motion = kEdge * (goal - start);
  const auto motion = std::make_shared<const geometric::MotionBound>(*world);
  geometric::ContinuousCollisionChecker fast_edges(*fast, motion, kResolution);
  geometric::ContinuousCollisionChecker fcl_edges(*fcl, motion, kResolution);

  // One query before the measurement also fills the fast checker's cache.
  CollisionBench bench;
  int in_collision = 0;
  int free_edges = 0;
  for (const Configuration& q : questions.configurations) {
    const bool collides = fast->first_collision(q).has_value();
    in_collision += collides ? 1 : 0;
    const bool agreed = fcl->first_collision(q).has_value() == collides &&
                        broad->first_collision(q).has_value() == collides;
    bench.disagreements += agreed ? 0 : 1;
    if (!collides && questions.edge_starts.size() < kEdges &&
        !fast->first_collision(q + questions.motion)) {
      questions.edge_starts.push_back(q);
      free_edges += fast_edges.check(q, q + questions.motion).free ? 1 : 0;
    }
  }
  bench.configurations = kConfigurations;
  bench.in_collision = in_collision / static_cast<double>(kConfigurations);
  bench.edges = static_cast<int>(questions.edge_starts.size());
  bench.edges_free = bench.edges > 0 ? free_edges / static_cast<double>(bench.edges) : 0.0;
  Series of_fast = configurations_for(*fast, questions);
  Series of_fcl = configurations_for(*fcl, questions);
  Series of_broad = configurations_for(*broad, questions);
  Series of_fast_edges = edges_for(fast_edges, questions);
  Series of_fcl_edges = edges_for(fcl_edges, questions);
  measure({&of_fast, &of_fcl, &of_broad, &of_fast_edges, &of_fcl_edges});
  bench.fast = {of_fast.median(), of_fast_edges.median()};
  bench.fcl = {of_fcl.median(), of_fcl_edges.median()};
  bench.fcl_broadphase_configuration_us = of_broad.median();
  return bench;
}

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

}  // namespace

PlanBench bench_planner(planning::Planner& planner,
                        const std::function<planning::PlanningProblem()>& make_problem,
                        planning::PlanRequest request, const std::vector<std::uint64_t>& seeds,
                        bool checked) {
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

template <typename Value>
void append_to(std::vector<Value>& all, const std::vector<Value>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

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
