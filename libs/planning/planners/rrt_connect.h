#pragma once

#include "handway/planning/spaces/state_space.h"
#include "handway/planning/spaces/target_sampler.h"
#include "handway/sampling/sequences/random_stream.h"
#include "planners/search.h"
#include "planners/tree_pair.h"

#include <optional>
#include <vector>

namespace handway::planning {

/// Settings of a BidirectionalSearch. Lengths in joints normalised to [0, 1]; with a Cartesian
/// corridor the arm's as make_corridor_space() has them.
struct RrtConnectSettings {
  double range = 0.3;   ///< Longest step of a tree.
  int refinements = 0;  ///< Steps tried, each a quarter of the one before, when one is not free.
  int max_samples = 1000000;
  int smoothing_checks = 300;  ///< Configurations that ShortcutSmoothing may check.
  double single_moves = 0.3;   ///< Share that move the arm alone or the hand alone; PMDs only.
  double expansions = 0.0;     ///< Share of steps that expand a node instead; PMDs only.
  TargetRegion region = {};    ///< PMDs only.
};

/// Settings without regions of short paths.
inline const RrtConnectSettings kSettingsOverAllJoints{.range = 0.2, .refinements = 2};

/// Two trees that grow towards random samples and towards each other. Over all joints it
/// is the usual baseline. With PMDs it samples from the paper's regions: the arm from a
/// corridor that widens, the hand from thumb base and PMDs; and from balls around start
/// and goal, where passages are narrowest. Its edges are sampled at first, and certified
/// only when trees meet. A share of its steps goes from a node with few attempts to a
/// place near it: such trees get out of passages that are too narrow for targets beyond
/// them to help.
///
/// Sources: Kuffner, LaValle, "RRT-Connect: an efficient approach to single-query
/// path planning", ICRA 2000, doi:10.1109/ROBOT.2000.844730;
/// Hsu, Latombe, Motwani, "Path planning in expansive configuration spaces", ICRA 1997,
/// doi:10.1109/ROBOT.1997.619371 (expansions);
/// Sánchez, Latombe, "A single-query bi-directional probabilistic roadmap planner
/// with lazy collision checking", ISRR 2001 (both, and edges checked late).
class BidirectionalSearch final : public Search {
 public:
  /// @param settings must outlive this object.
  /// @throws InputError as make_corridor_space().
  BidirectionalSearch(PlanningContext& context, const RrtConnectSettings& settings, HandSpace hand,
                      std::uint64_t seed);

  [[nodiscard]] Path path() const override { return path_; }

 protected:
  [[nodiscard]] std::optional<PlanStatus> step() override;

 private:
  /// Growth of a tree: from a node towards a target.
  struct Growth {
    int from;
    TargetSampler::Target target;
  };

  void announce_node(int node, const TargetSampler::Target& target);
  [[nodiscard]] Growth extension(int tree);
  [[nodiscard]] Growth expansion(int tree, sampling::RandomStream draw);
  [[nodiscard]] std::optional<int> grow(const Growth& growth);
  [[nodiscard]] std::optional<int> step_towards(int from, const Eigen::VectorXd& towards,
                                                double range, const TargetSampler::Target& target);
  [[nodiscard]] bool connect(int reached, const TargetSampler::Target& target);
  [[nodiscard]] bool passable(const Configuration& from, const Configuration& target,
                              double length);
  [[nodiscard]] bool verify(TreePair::Connection connection);
  [[nodiscard]] std::uint64_t edge_checks() const;

  const RrtConnectSettings& settings_;
  bool lazy_;
  TargetSampler targets_;
  const CorridorSpace& space_;
  TreePair trees_;
  sampling::RandomStream choices_;  ///< Random choices of the trees' growth.
  std::vector<int> expansions_;     ///< Attempts from each node.
  int sample_ = 0;
  int failures_ = 0;  ///< Samples since the last useful one.
  Path path_;
};

}  // namespace handway::planning
