#include "handway/planning/core/planning_context.h"

#include "core/lowest_index.h"
#include "handway/geometric/math/units.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

namespace handway::planning {

using geometric::BodyPair;
using geometric::CollisionWorld;
using geometric::EdgeResult;

/// The checkers of one thread.
struct PlanningContext::Worker {
  explicit Worker(const PlanningContext& context)
      : checker(context.problem().checker->clone()),
        edges(*checker, context.problem().motion,
              geometric::metres(context.request().resolution_mm)) {
    edges.set_ends(context.ends());
    edges.set_margin(geometric::metres(context.request().margin_mm));
    edges.stop_when([&context] { return context.interruption().has_value(); });
  }

  /// A pair that touches, or does not keep the margin.
  std::optional<int> conflict(const Configuration& q) {
    const std::optional<int> touching = checker->first_collision(q);
    return touching ? touching : edges.too_near(q);
  }
  /// The same. @param hint a pair to look at first.
  std::optional<int> conflict(const Configuration& q, int hint) {
    const std::optional<int> touching = checker->first_collision(q, hint);
    return touching ? touching : edges.too_near(q);
  }

  std::unique_ptr<geometric::CollisionChecker> checker;
  geometric::EdgeChecker edges;
};

struct PlanningContext::Threads {
  explicit Threads(const PlanningContext& context)
      : arena(context.request().threads), workers([&context] { return Worker(context); }) {
    if (context.request().threads == 1) {
      only = std::make_unique<Worker>(context);
    }
  }

  tbb::task_arena arena;
  tbb::enumerable_thread_specific<Worker> workers;
  std::unique_ptr<Worker> only;  ///< Of a context for one thread, whichever that is.
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
    const bool moved_by_hand = std::ranges::any_of(problem.hand, [&](int v) {
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
    if (q->size() != problem.model().variable_count() || !q->allFinite()) {
      return {};
    }
    ends.push_back(make_edge_end(*checker, *q, geometric::metres(request.resolution_mm),
                                 geometric::metres(request.margin_mm)));
  }
  return ends;
}

}  // namespace

PlanningContext::PlanningContext(const PlanningProblem& problem, const PlanRequest& request,
                                 std::stop_token stop, Observer& observer)
    : problem_(problem),
      request_(request),
      stop_(std::move(stop)),
      observer_(observer),
      begin_(std::chrono::steady_clock::now()),
      arm_pairs_(arm_pairs(problem)),
      ends_(find_ends(problem, request)),
      threads_(std::make_unique<Threads>(*this)) {}

PlanningContext::~PlanningContext() = default;

double PlanningContext::elapsed_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

std::optional<PlanStatus> PlanningContext::interruption() const {
  if (stop_.stop_requested()) {
    return PlanStatus::kCancelled;
  }
  if (parent_) {
    return parent_->interruption();
  }
  if (elapsed_s() > request_.time_limit_s) {
    return PlanStatus::kTimeLimit;
  }
  return std::nullopt;
}

PlanningContext::Worker& PlanningContext::own_worker() {
  return threads_->only ? *threads_->only : threads_->workers.local();
}

const EdgeResult& PlanningContext::counted(const EdgeResult& edge) {
  ++statistics_.edges_tested;
  statistics_.edge_checks += edge.checks;
  return edge;
}

std::optional<int> PlanningContext::collision(const Configuration& q) {
  ++statistics_.node_checks;
  return own_worker().conflict(q);
}

bool PlanningContext::arm_collides(const Configuration& q) {
  ++statistics_.node_checks;
  geometric::CollisionChecker& checker = *own_worker().checker;
  checker.place(q);
  return std::ranges::any_of(arm_pairs_, [&](int pair) { return checker.pair_collides(pair); });
}

PlanningContext::FirstFree PlanningContext::first_free(
    int count, const std::function<Configuration(int)>& candidate) {
  constexpr int kFree = -1;
  std::vector<int> outcome(static_cast<std::size_t>(count));
  LowestIndex first(count);
  const auto ask = [&](int i) {
    if (i > first.get()) {
      return;  // an earlier one is free: this answer is not needed
    }
    const std::optional<int> pair = own_worker().conflict(candidate(i), last_rejecting_pair_);
    outcome[static_cast<std::size_t>(i)] = pair.value_or(kFree);
    if (!pair) {
      first.offer(i);
    }
  };
  if (request_.threads > 1) {
    threads_->arena.execute([&] { tbb::parallel_for(0, count, ask, tbb::simple_partitioner()); });
  } else {
    for (int i = 0; i < first.get(); ++i) {
      ask(i);
    }
  }
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

PlanningContext::EdgeBatch::EdgeBatch(PlanningContext& context, std::vector<Edge> edges)
    : context_(context), edges_(std::move(edges)), results_(edges_.size()) {}

// One edge a thread and no more: a free edge often makes those after it needless.
void PlanningContext::EdgeBatch::check_from(std::size_t first) {
  const auto check = [&](std::size_t i) {
    if (!results_[i]) {
      results_[i] = context_.own_worker().edges.check(edges_[i].from, edges_[i].to);
    }
  };
  const std::size_t last =
      std::min(edges_.size(), first + static_cast<std::size_t>(context_.request_.threads));
  if (last - first < 2) {
    check(first);
    return;
  }
  context_.threads_->arena.execute(
      [&] { tbb::parallel_for(first, last, check, tbb::simple_partitioner()); });
}

bool PlanningContext::EdgeBatch::is_free(std::size_t index) {
  if (!results_[index]) {
    check_from(index);
  }
  return context_.counted(*results_[index]).free;
}

PlanningContext::EdgeBatch PlanningContext::edges(std::vector<Edge> edges) {
  return EdgeBatch(*this, std::move(edges));
}

bool PlanningContext::edge_free(const Configuration& from, const Configuration& to,
                                std::uint64_t most_checks) {
  return counted(own_worker().edges.check(from, to, most_checks)).free;
}

EdgeResult PlanningContext::edge_among(std::span<const int> pairs, const Configuration& from,
                                       const Configuration& to) {
  return counted(own_worker().edges.check_among(pairs, from, to));
}

std::optional<int> PlanningContext::collision_among(std::span<const int> pairs,
                                                    const Configuration& q) {
  ++statistics_.node_checks;
  return own_worker().checker->first_collision_among(pairs, q);
}

std::optional<int> PlanningContext::edge_probe(const Configuration& from, const Configuration& to,
                                               int count) {
  ++statistics_.edges_tested;
  Worker& worker = own_worker();
  // Halves, then quarters, …: the sooner an obstacle is met, the fewer are looked at.
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

std::unique_ptr<sampling::Sampler> PlanningContext::make_sampler(
    int dimension, std::uint64_t seed, sampling::ValidityPredicate valid) const {
  return sampling::make_sampler(sampler_, dimension, seed, std::move(valid));
}

std::unique_ptr<PlanningContext> PlanningContext::make_child(Observer& observer,
                                                             std::stop_token stop) const {
  return make_child(problem_, observer, std::move(stop));
}

std::unique_ptr<PlanningContext> PlanningContext::make_child(const PlanningProblem& problem,
                                                             Observer& observer,
                                                             std::stop_token stop) const {
  PlanRequest request = request_;
  request.threads = 1;
  auto child = std::make_unique<PlanningContext>(problem, request, std::move(stop), observer);
  child->parent_ = this;
  child->begin_ = begin_;
  child->sampler_ = sampler_;
  return child;
}

void PlanningContext::run_on_threads(int count, const std::function<void(int)>& work) {
  if (request_.threads > 1 && count > 1) {
    threads_->arena.execute([&] { tbb::parallel_for(0, count, work, tbb::simple_partitioner()); });
    return;
  }
  for (int i = 0; i < count; ++i) {
    work(i);
  }
}

void PlanningContext::count_rejection(int pair, double step) {
  const geometric::NamedPair bodies = named_pair(problem_.checker->world(), pair, 0.0);
  ++statistics_.rejections[{bodies.a, bodies.b}];
  statistics_.rejections_per_tenth.resize(10);
  ++statistics_.rejections_per_tenth[static_cast<std::size_t>(std::clamp(step, 0.0, 0.99) * 10)];
}

Certificate PlanningContext::certify(const Path& path) {
  constexpr double kMostTolerance = 2e-5;  // m, or …
  constexpr double kShare = 0.2;  // … of the clearance: how far below it the answer may be
  geometric::EdgeChecker& edges = own_worker().edges;
  geometric::CollisionChecker& checker = *own_worker().checker;
  const std::uint64_t before = checker.counts().configurations;
  const double resolution = geometric::metres(request_.resolution_mm);
  const auto kept_at = [&](std::size_t end) {
    return end < ends_.size() ? ends_[end].resolution(resolution) : resolution;
  };
  const double tolerance = std::min({kMostTolerance, kShare * kept_at(0), kShare * kept_at(1)});
  double least = kFarClearance;
  for (std::size_t i = 0; i + 1 < path.waypoints.size(); ++i) {
    // What is asked for is more than what is known, so that tolerances don't add up.
    const double enough = std::min(kFarClearance, least + std::max(tolerance, kShare * least));
    const geometric::NamedPair found =
        edges.clearance(path.waypoints[i], path.waypoints[i + 1], enough, tolerance, kShare);
    least = std::min(least, found.distance);
  }
  return {request_.resolution_mm, geometric::millimetres(kept_at(0)),
          geometric::millimetres(kept_at(1)), geometric::millimetres(least),
          checker.counts().configurations - before};
}

}  // namespace handway::planning
