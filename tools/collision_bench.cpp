#include "collision_bench.h"

#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/collision/continuous/continuous_collision_checker.h"
#include "handway/geometric/collision/continuous/motion_bound.h"
#include "handway/planning/campaigns/campaign_statistics.h"

#include <algorithm>
#include <chrono>
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

}  // namespace handway::tools
