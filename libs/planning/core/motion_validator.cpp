#include "handway/planning/core/motion_validator.h"

#include "core/thread_pool.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/limit_violation.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <utility>

namespace handway::planning {

using geometric::BodyPair;
using geometric::CollisionWorld;
using geometric::EdgeResult;

/// The checkers of one thread.
struct MotionValidator::Worker {
  Worker(const PlanningProblem& problem, const PlanRequest& request,
         const std::vector<geometric::EdgeEnd>& ends, const std::function<bool()>& is_interrupted)
      : checker(problem.checker->clone()), edges(*checker, problem.motion, request.resolution) {
    edges.set_ends(ends);
    edges.set_margin(request.margin);
    edges.stop_when(is_interrupted);
  }

  /// A pair that touches, or does not keep the margin. @param hint a pair to test first.
  std::optional<int> conflict(const Configuration& q, std::optional<int> hint = std::nullopt) {
    const std::optional<int> touching =
        hint ? checker->first_collision(q, *hint) : checker->first_collision(q);
    return touching ? touching : edges.too_near(q);
  }

  std::unique_ptr<geometric::CollisionChecker> checker;
  geometric::ContinuousCollisionChecker edges;
};

/// Workers, one for each calling thread; a single one if the run has one thread.
struct MotionValidator::Workers {
  Workers(bool shares_one, const std::function<Worker()>& make) : all(make) {
    if (shares_one) {
      only = std::make_unique<Worker>(make());
    }
  }
  Worker& own() { return only ? *only : all.local(); }

  tbb::enumerable_thread_specific<Worker> all;
  std::unique_ptr<Worker> only;
};

namespace {

// Pairs of the robot with itself that no hand joint moves.
std::vector<int> arm_pairs(const PlanningProblem& problem) {
  const CollisionWorld& world = problem.checker->world();
  std::vector<int> pairs;
  for (std::size_t p = 0; p < world.pairs().size(); ++p) {
    const BodyPair& pair = world.pairs()[p];
    if (!world.is_self_pair(pair)) {
      continue;
    }
    const bool moved_by_hand = std::ranges::any_of(problem.joints.hand, [&](int v) {
      return world.model().moves_between(v, world.body(pair.a).link, world.body(pair.b).link);
    });
    if (!moved_by_hand) {
      pairs.push_back(static_cast<int>(p));
    }
  }
  return pairs;
}

std::vector<geometric::EdgeEnd> find_ends(const PlanningProblem& problem,
                                          const PlanRequest& request) {
  const auto checker = problem.checker->clone();
  std::vector<geometric::EdgeEnd> ends;
  for (const Configuration* q : {&problem.start, &problem.goal}) {
    if (!geometric::configuration_fault(problem.model(), *q).empty()) {
      return {};
    }
    ends.push_back(make_edge_end(*checker, *q, request.resolution, request.margin));
  }
  return ends;
}

}  // namespace

bool keeps_end_clearance(geometric::CollisionChecker& checker, const Configuration& q,
                         double clearance) {
  return !geometric::is_closer_than(checker, q, clearance) &&
         std::ranges::all_of(checker.world().constraints(),
                             [&](const geometric::LinkConstraint& one) {
                               return one.slack(checker.link_poses()) >= kLeastEndClearance;
                             });
}

MotionValidator::MotionValidator(const PlanningProblem& problem, const PlanRequest& request,
                                 PlanStatistics& statistics, ThreadPool& threads,
                                 std::function<bool()> is_interrupted)
    : problem_(problem),
      request_(request),
      statistics_(statistics),
      threads_(threads),
      arm_pairs_(arm_pairs(problem)),
      ends_(find_ends(problem, request)),
      workers_(std::make_unique<Workers>(threads.size() == 1,
                                         [this, is_interrupted = std::move(is_interrupted)] {
                                           return Worker(problem_, request_, ends_, is_interrupted);
                                         })) {}

MotionValidator::~MotionValidator() = default;

std::string MotionValidator::invalid_end_reason(std::size_t end) {
  const geometric::RobotModel& model = problem_.model();
  const Configuration& q = end == 0 ? problem_.start : problem_.goal;
  if (std::string fault = geometric::configuration_fault(model, q); !fault.empty()) {
    return fault;
  }
  if (const auto violations = geometric::limit_violations(model, q, problem_.joints.fixed);
      !violations.empty()) {
    return "is out of limits: " + to_string(violations.front());
  }
  if (const std::optional<int> pair = collision(q)) {
    return describe_conflict(*problem_.checker->clone(), *pair, q);
  }
  if (end >= ends_.size()) {
    return "";  // the other end is no configuration of the robot
  }
  const geometric::EdgeEnd::NearPair* nearest = ends_[end].nearest();
  if (!nearest || nearest->distance >= kLeastEndClearance) {
    return "";
  }
  const geometric::CollisionWorld& world = problem_.checker->world();
  const std::string names = to_string(named_pair(world, nearest->pair, 0.0));
  return world.constraint(nearest->pair)
             ? "is at the limit of " + names + ": allow a little more"
             : fmt::format(
                   "is too close to a collision: {} at {:.6f} mm, at least {:g} mm is needed",
                   names, geometric::millimetres(nearest->distance),
                   geometric::millimetres(kLeastEndClearance));
}

const EdgeResult& MotionValidator::counted(const EdgeResult& edge) {
  ++statistics_.edges_tested;
  statistics_.edge_checks += edge.checks;
  return edge;
}

std::optional<int> MotionValidator::collision(const Configuration& q) {
  ++statistics_.node_checks;
  return workers_->own().conflict(q);
}

bool MotionValidator::arm_collides(const Configuration& q) {
  ++statistics_.node_checks;
  geometric::CollisionChecker& checker = *workers_->own().checker;
  checker.place(q);
  return std::ranges::any_of(arm_pairs_, [&](int pair) { return checker.pair_collides(pair); });
}

MotionValidator::FirstFree MotionValidator::first_free(
    int count, const std::function<Configuration(int)>& candidate) {
  constexpr int kFree = -1;
  std::vector<int> outcome(static_cast<std::size_t>(count));
  LowestIndex first(count);
  const auto ask = [&](int i) {
    if (i > first.get()) {
      return;  // an earlier one is free: this answer is not needed
    }
    const std::optional<int> pair = workers_->own().conflict(candidate(i), last_rejecting_pair_);
    outcome[static_cast<std::size_t>(i)] = pair.value_or(kFree);
    if (!pair) {
      first.offer(i);
    }
  };
  threads_.run(0, count, ask);
  FirstFree result;
  const int rejected = first.get();
  if (rejected < count) {
    result.index = rejected;
  }
  result.rejecting_pairs.assign(outcome.begin(), outcome.begin() + rejected);
  if (rejected > 0) {
    last_rejecting_pair_ = result.rejecting_pairs.back();
  }
  statistics_.node_checks += static_cast<std::uint64_t>(std::min(rejected + 1, count));
  return result;
}

// At most one edge per thread: a free edge often makes the next ones unnecessary.
std::function<bool(std::size_t)> MotionValidator::edges(std::vector<Edge> edges) {
  std::vector<std::optional<EdgeResult>> results(edges.size());
  return [this, edges = std::move(edges), results = std::move(results)](std::size_t index) mutable {
    if (!results[index]) {
      const std::size_t last =
          std::min(edges.size(), index + static_cast<std::size_t>(threads_.size()));
      threads_.run(static_cast<int>(index), static_cast<int>(last), [&](int i) {
        const auto edge = static_cast<std::size_t>(i);
        if (!results[edge]) {
          results[edge] = workers_->own().edges.check(edges[edge].from, edges[edge].to);
        }
      });
    }
    return counted(*results[index]).free;
  };
}

bool MotionValidator::edge_free(const Configuration& from, const Configuration& to,
                                std::uint64_t most_checks) {
  return counted(workers_->own().edges.check(from, to, most_checks)).free;
}

EdgeResult MotionValidator::edge_among(std::span<const int> pairs, const Configuration& from,
                                       const Configuration& to) {
  return counted(workers_->own().edges.check_among(pairs, from, to));
}

std::optional<int> MotionValidator::collision_among(std::span<const int> pairs,
                                                    const Configuration& q) {
  ++statistics_.node_checks;
  return workers_->own().checker->first_collision_among(pairs, q);
}

std::optional<int> MotionValidator::edge_probe(const Configuration& from, const Configuration& to,
                                               int count) {
  ++statistics_.edges_tested;
  Worker& worker = workers_->own();
  // Tests halves, then quarters, …: an obstacle is found early, after few samples.
  for (int parts = 2; parts / 2 <= count; parts *= 2) {
    for (int i = 1; i < parts; i += 2) {
      ++statistics_.edge_checks;
      const Configuration q = from + (static_cast<double>(i) / parts) * (to - from);
      if (const std::optional<int> pair = worker.conflict(q)) {
        return pair;
      }
    }
  }
  return std::nullopt;
}

Certificate MotionValidator::certify(const Path& path) {
  constexpr double kMostTolerance = 2e-5;  // m, or …
  constexpr double kShare = 0.2;  // … of the clearance: how far below it the answer may be
  geometric::ContinuousCollisionChecker& edges = workers_->own().edges;
  geometric::CollisionChecker& checker = *workers_->own().checker;
  const std::uint64_t before = checker.counts().configurations;
  const double resolution = request_.resolution;
  const auto kept_at = [&](std::size_t end) {
    return end < ends_.size() ? ends_[end].resolution(resolution) : resolution;
  };
  const double tolerance = std::min({kMostTolerance, kShare * kept_at(0), kShare * kept_at(1)});
  const geometric::NamedPair nearest =
      edges.clearance(path.waypoints, kFarClearance, tolerance, kShare);
  return {resolution, kept_at(0), kept_at(1), nearest.distance,
          checker.counts().configurations - before};
}

}  // namespace handway::planning
