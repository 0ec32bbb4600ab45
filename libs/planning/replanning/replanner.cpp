#include "replanning/replanner.h"

#include "handway/planning/paths/path_optimizer.h"
#include "planners/bidirectional_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace handway::planning {
namespace {

constexpr double kBackOff = 0.1;  // from what cuts an edge to where the way around it begins

HandSpace hand_space(const PlanningProblem& problem) {
  return problem.basis ? HandSpace::kPrincipalDirections : HandSpace::kAllJoints;
}

const char* sentence_for(ReplanSource source) {
  switch (source) {
    case ReplanSource::kLastPath:
      return "The last path is still free";
    case ReplanSource::kRoadmap:
      return "Found a path in the roadmap";
    default:
      return "Led the last path around what cuts it";
  }
}

/// A part of the last path that is not free, between two waypoints of it.
struct Gap {
  std::size_t first = 0;  ///< Of its edges.
  std::size_t last = 0;   ///< Inclusive.
};

std::vector<Gap> gaps(const std::vector<bool>& edge_free) {
  std::vector<Gap> found;
  for (std::size_t i = 0; i < edge_free.size(); ++i) {
    if (edge_free[i]) {
      continue;
    }
    if (!found.empty() && found.back().last + 1 == i) {
      found.back().last = i;
    } else {
      found.push_back({i, i});
    }
  }
  return found;
}

// The farthest that is safely reached from `from` towards `to` before `obstruction`, in [0, 1].
Configuration before_obstruction(PlanningContext& context, const Configuration& from,
                                 const Configuration& to, double obstruction) {
  const double length = normalised_distance(context.problem().model(), from, to);
  const double share = obstruction - kBackOff / std::max(length, kBackOff);
  if (share <= 0.0) {
    return from;
  }
  Configuration q = from + share * (to - from);
  return !context.validator().collision(q) && context.validator().edge_free(from, q) ? q : from;
}

}  // namespace

Path Replanner::along(const PlanningProblem& problem, const std::vector<int>& way) const {
  Path path;
  for (const int node : way) {
    path.waypoints.push_back(memory_.graph.configuration(node));
  }
  path.waypoints.front() = problem.start;  // to the bit, whatever turn its node is at
  return {problem.model().unwrapped(std::move(path.waypoints), problem.start)};
}

void Replanner::do_plan(PlanningContext& context, PlanResult& result) {
  WayChecker checker(context, memory_);
  ReplanReport& report = memory_.report;
  report.revived_edges = memory_.graph.revived_edges(memory_.changes);
  std::optional<Path> path = known_path(context, checker);
  if (!path && !memory_.last_path.waypoints.empty()) {
    path = repaired_path(context, checker);
  }
  if (path) {
    result.status = PlanStatus::kSolved;
    if (report.source != ReplanSource::kLastPath) {
      smooth_result(context, planner_.objective(), memory_.settings.smoothing_checks, *path,
                    result);
    } else {
      result.path = std::move(*path);
    }
    result.reason =
        fmt::format("{}: {} waypoints.", sentence_for(report.source), result.path.waypoints.size());
  } else if (const std::optional<PlanStatus> interruption = context.interruption()) {
    result.status = *interruption;
  } else {
    harvest_.begin_search();
    planner_.plan_within(context, result);
    report.source = result.solved() ? ReplanSource::kPlanner : ReplanSource::kNone;
  }
  harvest_.bring_in(context.problem(), memory_);
  if (result.solved()) {
    memory_.remember(context.problem(), result.path);
  }
  context.statistics().nodes = static_cast<std::uint64_t>(memory_.graph.node_count());
  context.statistics().edges = static_cast<std::uint64_t>(memory_.graph.edge_count());
}

// From the roadmap as it is.
std::optional<Path> Replanner::known_path(PlanningContext& context, WayChecker& checker) {
  constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();
  const int start = memory_.node_at(context.problem(), context.problem().start);
  const int goal = memory_.node_at(context.problem(), context.problem().goal);
  memory_.graph.node(start).set_free(memory_.changes.revision());  // plan() has checked them
  memory_.graph.node(goal).set_free(memory_.changes.revision());
  if (const auto way =
          checker.shortest_way(start, goal, LivingGraph::Edges::kOnceFree, kUnlimited)) {
    Path path = along(context.problem(), *way);
    memory_.report.source = path.waypoints == memory_.last_path.waypoints ? ReplanSource::kLastPath
                                                                          : ReplanSource::kRoadmap;
    return path;
  }
  if (const auto way =
          checker.shortest_way(start, goal, LivingGraph::Edges::kAny,
                               static_cast<std::uint64_t>(memory_.settings.roadmap_checks))) {
    memory_.report.source = ReplanSource::kRoadmap;
    return along(context.problem(), *way);
  }
  return std::nullopt;
}

// Start, what is free of the last path's inner waypoints, goal.
std::vector<int> Replanner::free_waypoints(PlanningContext& context, WayChecker& checker) {
  const int start = memory_.node_at(context.problem(), context.problem().start);
  const int goal = memory_.node_at(context.problem(), context.problem().goal);
  std::vector<int> way{start};
  for (const Configuration& q : memory_.last_path.waypoints) {
    const int node = memory_.node_at(context.problem(), q);
    if (node != start && node != goal && checker.node_free(node)) {
      way.push_back(node);
    }
  }
  way.push_back(goal);
  return way;
}

std::optional<Path> Replanner::repaired_path(PlanningContext& context, WayChecker& checker) {
  const std::vector<int> way = free_waypoints(context, checker);
  std::vector<bool> edge_free;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    edge_free.push_back(checker.edge_free(way[i], way[i + 1]));
  }
  Path path;
  const Path waypoints = along(context.problem(), way);
  std::size_t next = 0;  // waypoint to go on with
  for (const Gap& gap : gaps(edge_free)) {
    for (; next <= gap.first; ++next) {
      path.waypoints.push_back(waypoints.waypoints[next]);
    }
    const std::size_t end = gap.last + 1;
    const Configuration& from = waypoints.waypoints[gap.first];
    const Configuration& to = waypoints.waypoints[end];
    const double first_cut = checker.obstruction(way[gap.first], way[gap.first + 1]).value_or(0.0);
    const double last_cut = checker.obstruction(way[end], way[gap.last]).value_or(0.0);
    const std::optional<Path> around = detour(
        context, before_obstruction(context, from, waypoints.waypoints[gap.first + 1], first_cut),
        before_obstruction(context, to, waypoints.waypoints[gap.last], last_cut));
    if (!around) {
      return std::nullopt;
    }
    for (const Configuration& q : around->waypoints) {
      if (q != path.waypoints.back()) {
        path.waypoints.push_back(q);
      }
    }
    next = path.waypoints.back() == to ? end + 1 : end;
  }
  for (; next < way.size(); ++next) {
    path.waypoints.push_back(waypoints.waypoints[next]);
  }
  memory_.report.source = ReplanSource::kRepair;
  return path;
}

std::optional<Path> Replanner::detour(PlanningContext& context, const Configuration& from,
                                      const Configuration& to) {
  if (context.interruption()) {
    return std::nullopt;
  }
  if (from == to) {
    return Path{{from}};
  }
  PlanningProblem part = context.problem();
  part.start = from;
  part.goal = to;
  harvest_.begin_search();
  const std::unique_ptr<PlanningContext> own = context.make_child(part, harvest_, {});
  RrtConnectSettings settings;
  settings.max_samples = std::numeric_limits<int>::max();
  BidirectionalSearch search(*own, settings, hand_space(part), context.request().seed);
  SearchBudget budget;
  budget.checks = static_cast<std::uint64_t>(memory_.settings.repair_checks);
  const bool found = search.advance(budget) == PlanStatus::kSolved;
  context.statistics() += own->statistics();
  return found ? std::optional(search.path()) : std::nullopt;
}

}  // namespace handway::planning
