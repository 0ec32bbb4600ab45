#include "handway/planning/paths/roadmap_smoothing.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace handway::planning {
namespace {

/// The roadmap of a path's nodes. Its edges are assumed free until they are
/// looked at, and only those of candidate ways are (R. Bohlin, L. Kavraki, "Path
/// planning using lazy PRM", ICRA 2000): the shortest way with few checks.
class LazyShortcuts {
 public:
  LazyShortcuts(PlanningContext& context, const Path& path, std::uint64_t checks)
      : context_(context),
        path_(path),
        checks_(checks),
        before_(context.statistics().checks()),
        count_(path.waypoints.size()) {
    states_.assign(count_ * count_, EdgeState::kUnknown);
    for (std::size_t i = 0; i + 1 < count_; ++i) {
      state(i, i + 1) = EdgeState::kFree;
    }
  }

  /// Path indices of the shortest free way; of the edges known by then if interrupted.
  std::vector<std::size_t> shortest() {
    while (!context_.interruption() && spent() < checks_) {
      std::vector<std::size_t> way = shortest_way(EdgeState::kUnknown);
      if (all_free(way)) {
        return way;
      }
    }
    return shortest_way(EdgeState::kFree);
  }

 private:
  enum class EdgeState { kBlocked, kUnknown, kFree };

  EdgeState& state(std::size_t from, std::size_t to) { return states_[from * count_ + to]; }

  [[nodiscard]] std::uint64_t spent() const { return context_.statistics().checks() - before_; }

  [[nodiscard]] double length(std::size_t from, std::size_t to) const {
    return normalised_distance(context_.problem().model(), path_.waypoints[from],
                               path_.waypoints[to]);
  }

  // Over edges that are at least `worst`. The nodes are in the path's order: no
  // way back is needed.
  std::vector<std::size_t> shortest_way(EdgeState worst) {
    std::vector<double> distance(count_, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> previous(count_, 0);
    distance[0] = 0.0;
    for (std::size_t to = 1; to < count_; ++to) {
      for (std::size_t from = 0; from < to; ++from) {
        const bool usable = state(from, to) >= worst;
        if (usable && distance[from] + length(from, to) < distance[to]) {
          distance[to] = distance[from] + length(from, to);
          previous[to] = from;
        }
      }
    }
    std::vector<std::size_t> way{count_ - 1};
    while (way.back() != 0) {
      way.push_back(previous[way.back()]);
    }
    return {way.rbegin(), way.rend()};
  }

  bool all_free(const std::vector<std::size_t>& way) {
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      EdgeState& edge = state(way[i], way[i + 1]);
      if (edge == EdgeState::kUnknown) {
        const bool free = context_.edge_free(path_.waypoints[way[i]], path_.waypoints[way[i + 1]],
                                             checks_ - std::min(checks_, spent()));
        edge = free ? EdgeState::kFree : EdgeState::kBlocked;
      }
      if (edge == EdgeState::kBlocked) {
        return false;
      }
    }
    return true;
  }

  PlanningContext& context_;
  const Path& path_;
  std::uint64_t checks_;
  std::uint64_t before_;
  std::size_t count_;
  std::vector<EdgeState> states_;  ///< Row from, column to.
};

}  // namespace

Path smooth_by_roadmap(PlanningContext& context, const Path& path, std::uint64_t checks) {
  Path smooth;
  for (const std::size_t node : LazyShortcuts(context, path, checks).shortest()) {
    smooth.waypoints.push_back(path.waypoints[node]);
  }
  return smooth;
}

}  // namespace handway::planning
