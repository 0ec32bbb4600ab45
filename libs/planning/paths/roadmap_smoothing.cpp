#include "handway/planning/paths/roadmap_smoothing.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace handway::planning {
namespace {

// Spacing of the configurations that are checked before a motion is certified.
constexpr double kPlausibleSpacing = 0.1;

/// The nodes of a path and the motions between them, assumed free until the cheapest path leads
/// over them (Bohlin, Kavraki, "Path planning using lazy PRM", ICRA 2000).
class PathRoadmap {
 public:
  PathRoadmap(PlanningContext& context, const std::vector<Configuration>& nodes, bool both_ways)
      : context_(context), nodes_(nodes), both_ways_(both_ways) {
    const std::size_t count = nodes.size();
    lengths_.resize(count * count);
    motions_.assign(count * count, Motion::kUnknown);
    for (std::size_t from = 0; from < count; ++from) {
      for (std::size_t to = from + 1; to < count; ++to) {
        lengths_[index(from, to)] =
            normalised_distance(context.problem().model(), nodes[from], nodes[to]);
      }
      if (from + 1 < count) {
        motions_[index(from, from + 1)] = Motion::kFree;
      }
    }
  }

  [[nodiscard]] Path shortest_path() {
    std::vector<std::size_t> nodes = shortest(Motion::kUnknown);
    while (!confirm(nodes)) {
      nodes = shortest(context_.interruption() ? Motion::kFree : Motion::kUnknown);
    }
    Path path;
    for (const std::size_t node : nodes) {
      path.waypoints.push_back(nodes_[node]);
    }
    return path;
  }

 private:
  enum class Motion : std::uint8_t { kBlocked, kUnknown, kPlausible, kFree };

  // A motion is the same in both directions.
  [[nodiscard]] std::size_t index(std::size_t from, std::size_t to) const {
    return to < from ? index(to, from) : from * nodes_.size() + to;
  }

  // Uses motions with at least this state (Bellman, Ford).
  [[nodiscard]] std::vector<std::size_t> shortest(Motion least) const {
    const std::size_t count = nodes_.size();
    std::vector<double> best(count, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> previous(count, 0);
    best[0] = 0.0;
    bool again = true;
    while (again) {
      again = false;  // where all motions lead forwards, once is enough
      for (std::size_t to = 1; to < count; ++to) {
        for (std::size_t from = 0; from < (both_ways_ ? count : to); ++from) {
          const std::size_t motion = index(from, to);
          if (from != to && motions_[motion] >= least && best[from] + lengths_[motion] < best[to]) {
            best[to] = best[from] + lengths_[motion];
            previous[to] = from;
            again = both_ways_;
          }
        }
      }
    }
    std::vector<std::size_t> nodes{count - 1};
    while (nodes.back() != 0) {
      nodes.push_back(previous[nodes.back()]);
    }
    return {nodes.rbegin(), nodes.rend()};
  }

  // Cheap checks of the whole path come before expensive ones of a part of it.
  [[nodiscard]] bool confirm(const std::vector<std::size_t>& nodes) {
    for (const Motion wanted : {Motion::kPlausible, Motion::kFree}) {
      for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        const std::size_t motion = index(nodes[i], nodes[i + 1]);
        if (motions_[motion] >= wanted) {
          continue;
        }
        const Configuration& from = nodes_[nodes[i]];
        const Configuration& to = nodes_[nodes[i + 1]];
        const int looks = static_cast<int>(lengths_[motion] / kPlausibleSpacing);
        const bool passed = wanted == Motion::kPlausible
                                ? context_.validator().edge_plausible(from, to, looks)
                                : context_.validator().edge_free(from, to);
        motions_[motion] = passed ? wanted : Motion::kBlocked;
        if (!passed) {
          return false;
        }
      }
    }
    return true;
  }

  PlanningContext& context_;
  const std::vector<Configuration>& nodes_;
  bool both_ways_;
  std::vector<double> lengths_;  ///< Length of motions; row from, column to, where from < to.
  std::vector<Motion> motions_;  ///< Motions, in the layout of `lengths_`.
};

}  // namespace

Path smooth_by_roadmap(PlanningContext& context, const Path& path, SmoothingEdges edges) {
  const PlanningProblem& problem = context.problem();
  const auto nodes = problem.model().unwrapped(path.waypoints, problem.start);
  return PathRoadmap(context, nodes, edges == SmoothingEdges::kBothWays).shortest_path();
}

}  // namespace handway::planning
