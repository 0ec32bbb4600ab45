#include "paths/subspace_roadmap.h"

#include "paths/subspace_entry.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace handway::planning {
namespace {

constexpr double kSpacing = 0.2;  // of nodes along the path, if there is a subspace
constexpr std::size_t kMostPlaces = 24;
constexpr std::size_t kMostOthers = 3;  // postures of other places that are tried
constexpr double kLookSpacing = 0.1;    // of configurations looked at before a motion is certified

}  // namespace

SubspaceRoadmap::SubspaceRoadmap(PlanningContext& context, Objective& objective,
                                 const std::vector<Point>& path, bool has_subspace,
                                 std::uint64_t seed, bool both_ways)
    : context_(context), objective_(objective), draw_(seed), both_ways_(both_ways) {
  add_path(path, has_subspace);
}

void SubspaceRoadmap::add_path(const std::vector<Point>& path, bool has_subspace) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    length_ += path[i].distance_to(path[i + 1]);
  }
  const double spacing = has_subspace
                             ? std::max(kSpacing, length_ / static_cast<double>(kMostPlaces))
                             : std::numeric_limits<double>::infinity();
  std::vector<Point> places;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const int parts =
        std::max(1, static_cast<int>(std::ceil(path[i].distance_to(path[i + 1]) / spacing)));
    for (int k = 0; k < parts; ++k) {
      places.push_back(k == 0 ? path[i]
                              : objective_.point(path[i].q + static_cast<double>(k) / parts *
                                                                 (path[i + 1].q - path[i].q)));
    }
  }
  places.push_back(path.back());
  enum Layer { kBefore, kInside, kAfter };
  std::vector<Layer> layers;
  for (std::size_t p = 0; p < places.size(); ++p) {
    const auto add = [&](Point point, Layer layer, bool known_free) {
      nodes_.push_back({std::move(point), p, known_free});
      layers.push_back(layer);
    };
    const bool is_goal = p + 1 == places.size();
    if (!has_subspace) {
      add(places[p], kBefore, true);
      continue;
    }
    if (!is_goal) {
      add(places[p], kBefore, true);
    }
    add(objective_.towards_subspace(places[p], 1.0), kInside, false);
    if (p > 0) {
      add(places[p], kAfter, true);
    }
  }
  const std::size_t count = nodes_.size();
  costs_.assign(count * count, -1.0);
  motions_.assign(count * count, Motion::kBlocked);
  for (std::size_t from = 0; from < count; ++from) {
    for (std::size_t to = from + 1; to < count; ++to) {
      if (layers[from] > layers[to]) {
        continue;
      }
      const bool next = nodes_[to].place == nodes_[from].place + 1;
      const bool along = next && nodes_[from].known_free && nodes_[to].known_free;
      motion(from, to) = along ? Motion::kFree : Motion::kUnknown;
    }
  }
}

std::size_t SubspaceRoadmap::index(std::size_t from, std::size_t to) const {
  return both_ways_ && to < from ? index(to, from) : from * nodes_.size() + to;
}

SubspaceRoadmap::Motion& SubspaceRoadmap::motion(std::size_t from, std::size_t to) {
  return motions_[index(from, to)];
}

double SubspaceRoadmap::cost(std::size_t from, std::size_t to) {
  double& cost = costs_[index(from, to)];
  if (cost < 0.0) {
    const MotionSums motion = objective_.measure(nodes_[from].point, nodes_[to].point);
    cost = objective_.additive_cost(motion, length_);
  }
  return cost;
}

// Layers stay as they are: what never was a motion stays none.
void SubspaceRoadmap::set_motions(std::size_t node, Motion state) {
  for (std::size_t other = 0; other < nodes_.size(); ++other) {
    for (const auto& [from, to] : {std::pair(node, other), std::pair(other, node)}) {
      if (motion(from, to) != Motion::kBlocked) {
        motion(from, to) = state;
        costs_[index(from, to)] = -1.0;
      }
    }
  }
}

// The hand's posture that collides gives way to a free one beside it in the subspace, if there is
// one.
void SubspaceRoadmap::give_way(std::size_t node) {
  Node& colliding = nodes_[node];
  const std::optional<Point> free =
      colliding.has_given_way ? std::nullopt : free_posture_near(colliding);
  if (free) {
    colliding.point = *free;
    colliding.has_given_way = true;
    colliding.known_free = true;
  }
  set_motions(node, free ? Motion::kUnknown : Motion::kBlocked);
}

std::optional<Objective::Point> SubspaceRoadmap::free_posture_near(const Node& node) {
  // First what was free at other places: the hand need not move between them.
  std::vector<const Node*> others;
  for (const Node& other : nodes_) {
    if (other.has_given_way) {
      others.push_back(&other);
    }
  }
  std::ranges::stable_sort(others, {}, [&](const Node* other) {
    return std::max(other->place, node.place) - std::min(other->place, node.place);
  });
  for (std::size_t i = 0; i < std::min(kMostOthers, others.size()); ++i) {
    const Point point = objective_.with_hand(node.point, others[i]->point);
    if (!context_.collision(point.q)) {
      return point;
    }
  }
  return free_in_subspace(context_, objective_, node.point, draw_);
}

std::vector<std::size_t> SubspaceRoadmap::cheapest(Motion least) {
  const std::size_t count = nodes_.size();
  std::vector<double> best(count, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> previous(count, 0);
  best[0] = 0.0;
  bool again = true;
  while (again) {
    again = false;  // where all motions lead forwards, once is enough
    for (std::size_t to = 1; to < count; ++to) {
      for (std::size_t from = 0; from < (both_ways_ ? count : to); ++from) {
        if (motion(from, to) < least || !(best[from] < best[to])) {
          continue;
        }
        const double sum = best[from] + cost(from, to);
        if (sum < best[to]) {
          best[to] = sum;
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

// Cheap questions about the whole path come before dear ones about a part of it.
bool SubspaceRoadmap::confirm(const std::vector<std::size_t>& nodes, std::uint64_t last_check) {
  for (const std::size_t i : nodes) {
    Node& node = nodes_[i];
    if (!node.known_free && context_.collision(node.point.q)) {
      give_way(i);
      return false;
    }
    node.known_free = true;
  }
  for (const Motion wanted : {Motion::kPlausible, Motion::kFree}) {
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      Motion& state = motion(nodes[i], nodes[i + 1]);
      if (state >= wanted) {
        continue;
      }
      const Point& from = nodes_[nodes[i]].point;
      const Point& to = nodes_[nodes[i + 1]].point;
      const std::uint64_t now = context_.statistics().checks();
      const bool passed =
          wanted == Motion::kPlausible
              ? context_.edge_plausible(from.q, to.q,
                                        static_cast<int>(from.distance_to(to) / kLookSpacing))
              : now < last_check && context_.edge_free(from.q, to.q, last_check - now);
      state = passed ? wanted : Motion::kBlocked;
      if (!passed) {
        return false;
      }
    }
  }
  return true;
}

std::vector<Objective::Point> SubspaceRoadmap::cheapest_path(std::uint64_t checks) {
  const std::uint64_t before = context_.statistics().checks();
  const std::uint64_t last_check =
      before + std::min(checks, std::numeric_limits<std::uint64_t>::max() - before);
  std::vector<std::size_t> nodes = cheapest(Motion::kUnknown);
  while (!confirm(nodes, last_check)) {
    const bool over = context_.interruption() || context_.statistics().checks() >= last_check;
    nodes = cheapest(over ? Motion::kFree : Motion::kUnknown);
  }
  std::vector<Point> points;
  std::ranges::transform(nodes, std::back_inserter(points),
                         [&](std::size_t node) { return nodes_[node].point; });
  return points;
}

}  // namespace handway::planning
