#pragma once

#include "handway/planning/core/objective.h"
#include "handway/planning/core/planning_context.h"
#include "handway/sampling/sequences/random_stream.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace handway::planning {

/// The cost of a path as a sum over its motions: a weight for each of their sums.
struct AdditiveCost {
  double length = 0.0;
  double outside = 0.0;
  double missing_clearance = 0.0;
  double duration = 0.0;

  [[nodiscard]] double of(const MotionSums& motion) const {
    return length * motion.length + outside * motion.outside +
           missing_clearance * motion.missing_clearance + duration * motion.duration;
  }
};

/// A search for a path between two points whose cost is below a bound: two trees that know the cost
/// of each node from its root, and grow only where start, node and goal can still be joined below
/// the bound.
///
/// A sample gets a cost between the least one from its root and the largest one that leaves enough
/// for the rest; the tree grows from the nearest node that reaches the sample at this cost. Edges
/// are sampled at first, and certified when the trees meet; a subtree behind an edge that is not
/// free is dropped.
///
/// Sources: Wilson, Thomason, Kingston, Gammell, "AORRTC: Almost-surely asymptotically optimal
/// planning with RRT-Connect", 2025 (costs of samples, two trees); Gammell, Srinivasa, Barfoot,
/// "Informed RRT*", IROS 2014, doi:10.1109/IROS.2014.6942976 (samples in an ellipsoid).
class CheaperPathSearch {
 public:
  /// @param context outlives this.
  /// @param guide a free path from start to goal, near which half of the samples are. The costs of
  /// others are measured as if they had its length.
  /// @param share the bound, as a share of the guide's cost.
  CheaperPathSearch(PlanningContext& context, const ObjectiveWeights& weights, const Path& guide,
                    double share, std::uint64_t seed);

  /// Draws a sample, and grows a tree towards it.
  /// @returns a path whose motions are free and whose cost is below the bound, if the trees met.
  [[nodiscard]] std::optional<Path> step();

  /// Number of configurations checked and of distance queries so far.
  [[nodiscard]] std::uint64_t spent() const {
    return context_.statistics().checks() - checks_before_ + objective_.distance_queries();
  }

 private:
  using Point = Objective::Point;
  struct Node {
    Point point;
    int parent;       ///< -1: the root.
    double cost;      ///< From the root; infinite: an edge on the way is not free.
    bool is_certain;  ///< The edge to the parent is free.
  };
  using Tree = std::vector<Node>;
  /// A node of each tree, and the cost of the path through them.
  struct Meeting {
    std::array<int, 2> nodes;
    double cost;
  };

  [[nodiscard]] std::optional<Point> draw();
  [[nodiscard]] Eigen::VectorXd draw_in_ellipsoid();
  [[nodiscard]] Eigen::VectorXd draw_near_guide();
  [[nodiscard]] double least(const Point& from, const Point& to) const;
  [[nodiscard]] std::optional<int> nearest(int tree, const Point& to, double most) const;
  [[nodiscard]] std::optional<int> grow(int tree, int from, const Point& target, double beyond);
  [[nodiscard]] std::optional<Meeting> connect(int tree, int reached);
  [[nodiscard]] bool passable(const Point& from, const Point& to);
  [[nodiscard]] bool verify(const Meeting& meeting);
  [[nodiscard]] bool verify_branch(int tree, int node);
  void drop(int tree, int node);
  [[nodiscard]] Path path_through(const Meeting& meeting) const;

  PlanningContext& context_;
  Objective objective_;
  std::uint64_t checks_before_;
  AdditiveCost cost_;
  double bound_ = 0.0;
  sampling::RandomStream random_;
  geometric::JointIndices planned_;  ///< PlanningProblem::planned_joints().
  std::vector<Point> guide_;
  std::array<Tree, 2> trees_;  ///< Trees of start and goal; their roots are the nodes 0.
  int samples_ = 0;
};

}  // namespace handway::planning
