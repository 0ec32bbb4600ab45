#include "replanning/way_checker.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace handway::planning {
namespace {

constexpr double kProbeSpacing = 0.05;  // of configurations looked at before an edge is checked

}  // namespace

std::optional<std::vector<int>> WayChecker::shortest_way(int from, int to, LivingGraph::Edges edges,
                                                         std::uint64_t checks) {
  const std::uint64_t before = context_.statistics().checks();
  while (!context_.interruption() && context_.statistics().checks() - before < checks) {
    std::vector<int> way = memory_.graph.shortest_path(from, to, edges, memory_.changes);
    if (way.empty()) {
      return std::nullopt;
    }
    if (way_free(way)) {
      return way;
    }
  }
  return std::nullopt;
}

// Cheap questions first; one no ends it.
bool WayChecker::way_free(const std::vector<int>& way) {
  const auto all_edges = [&](auto is_free) {
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      if (context_.interruption() || !is_free(way[i], way[i + 1])) {
        return false;
      }
    }
    return true;
  };
  return std::ranges::all_of(way, [&](int node) { return node_free(node); }) &&
         all_edges([&](int a, int b) { return plausible(a, b); }) &&
         all_edges([&](int a, int b) { return edge_free(a, b); });
}

std::vector<int> WayChecker::changed_pairs(const Freedom& freedom) const {
  const geometric::CollisionWorld& world = context_.problem().checker->world();
  if (freedom.was_free()) {
    return memory_.changes.pairs_changed_since(freedom.free_at, world);
  }
  std::vector<int> all(static_cast<std::size_t>(world.check_count()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

// What it was known to be free of stays known.
void WayChecker::refuse(Freedom& freedom, std::optional<int> pair) const {
  freedom.refused_at = memory_.changes.revision();
  freedom.refused_by.clear();
  const geometric::CollisionWorld& world = context_.problem().checker->world();
  if (pair && !world.constraint(*pair)) {
    const int other = world.pairs()[static_cast<std::size_t>(*pair)].b;
    if (!world.body(other).moves()) {
      freedom.refused_by = world.body(other).name;
    }
  }
}

bool WayChecker::node_free(int node) {
  Freedom& freedom = memory_.graph.node(node);
  if (freedom.is_refused(memory_.changes)) {
    return false;
  }
  if (const std::vector<int> pairs = changed_pairs(freedom); !pairs.empty()) {
    memory_.report.rechecked += freedom.was_free() ? 1 : 0;
    const std::optional<int> touching =
        context_.validator().collision_among(pairs, memory_.graph.configuration(node));
    if (touching) {
      refuse(freedom, touching);
      return false;
    }
  }
  freedom.set_free(memory_.changes.revision());
  return true;
}

bool WayChecker::edge_free(int a, int b) {
  Freedom& freedom = memory_.edge_between(a, b);
  if (freedom.is_refused(memory_.changes)) {
    return false;
  }
  if (const std::vector<int> pairs = changed_pairs(freedom); !pairs.empty()) {
    memory_.report.rechecked += freedom.was_free() ? 1 : 0;
    const Configuration& from = memory_.graph.configuration(a);
    const geometric::EdgeResult result = context_.validator().edge_among(pairs, from, end_of(a, b));
    if (!result.free && !result.pair) {
      return false;  // interrupted: nothing was settled
    }
    if (!result.free) {
      ++memory_.report.refused_edges;
      refuse(freedom, result.pair);
      obstructions_[{a, b}] = result.at;
      obstructions_[{b, a}] = 1.0 - result.at;
      return false;
    }
  }
  freedom.set_free(memory_.changes.revision());
  return true;
}

// Edges never checked are sampled before any is checked exactly.
bool WayChecker::plausible(int a, int b) {
  Freedom& freedom = memory_.graph.edge(a, b);
  if (freedom.was_free()) {
    return true;
  }
  const Configuration& from = memory_.graph.configuration(a);
  const Configuration to = end_of(a, b);
  const int probes = static_cast<int>(memory_.graph.distance(a, b) / kProbeSpacing);
  const std::optional<int> touching = context_.validator().edge_probe(from, to, probes);
  if (touching) {
    ++memory_.report.refused_edges;
    refuse(freedom, touching);
  }
  return !touching;
}

Configuration WayChecker::end_of(int a, int b) const {
  return context_.problem().model().nearest_equivalent(memory_.graph.configuration(a),
                                                       memory_.graph.configuration(b));
}

std::optional<double> WayChecker::obstruction(int a, int b) const {
  const auto found = obstructions_.find({a, b});
  return found == obstructions_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace handway::planning
