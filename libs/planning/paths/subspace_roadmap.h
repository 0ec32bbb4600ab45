#pragma once

#include "handway/planning/core/objective.h"
#include "handway/planning/core/planning_context.h"
#include "handway/sampling/sequences/random_stream.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace handway::planning {

/// A roadmap along a path that leads into the hand's PMD subspace and out of it.
///
/// Its nodes are points of the path in three layers: the path before it enters the subspace, the
/// same points with the hand at the closest free posture of the subspace that a few trials find,
/// and the path after it has left it. Motions lead
/// forwards along the path, and from a layer to itself or a later one; without a subspace there
/// is one layer, whose motions may lead both ways. They are assumed free until the cheapest path
/// leads over them (Bohlin, Kavraki, "Path planning using lazy PRM", ICRA 2000).
class SubspaceRoadmap {
 public:
  using Point = Objective::Point;

  /// All that is passed outlives this. @param path its motions are free.
  SubspaceRoadmap(PlanningContext& context, Objective& objective, const std::vector<Point>& path,
                  bool has_subspace, std::uint64_t seed, bool both_ways = false);

  /// The cheapest free path from the first to the last point; of motions known to be free once
  /// `checks` configurations were checked or the run has to end.
  [[nodiscard]] std::vector<Point> cheapest_path(std::uint64_t checks);

 private:
  enum class Motion : std::uint8_t { kBlocked, kUnknown, kPlausible, kFree };
  struct Node {
    Point point;
    std::size_t place;           ///< Along the path.
    bool known_free;             ///< The configuration, not the motions.
    bool has_given_way = false;  ///< To a free posture beside the closest one.
  };

  void add_path(const std::vector<Point>& path, bool has_subspace);
  [[nodiscard]] std::size_t index(std::size_t from, std::size_t to) const;
  [[nodiscard]] Motion& motion(std::size_t from, std::size_t to);
  [[nodiscard]] double cost(std::size_t from, std::size_t to);
  [[nodiscard]] std::vector<std::size_t> cheapest(Motion least);
  [[nodiscard]] bool confirm(const std::vector<std::size_t>& nodes, std::uint64_t last_check);
  void give_way(std::size_t node);
  [[nodiscard]] std::optional<Point> free_posture_near(const Node& node);
  void set_motions(std::size_t node, Motion state);

  PlanningContext& context_;
  Objective& objective_;
  sampling::RandomStream draw_;
  bool both_ways_;
  double length_ = 0.0;          ///< Of the path.
  std::vector<Node> nodes_;      ///< In an order in which motions lead forwards.
  std::vector<Motion> motions_;  ///< Row from, column to.
  std::vector<double> costs_;    ///< The same; negative: not known yet.
};

}  // namespace handway::planning
