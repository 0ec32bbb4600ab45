#pragma once

#include "handway/planning/planners/rrt_connect.h"
#include "handway/planning/spaces/target_sampler.h"
#include "handway/sampling/sequences/random_stream.h"
#include "planners/search.h"
#include "planners/tree_pair.h"

#include <memory>
#include <optional>
#include <vector>

namespace handway::planning {

/// The search of RrtConnect.
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
  sampling::RandomStream choices_;  ///< Of how trees grow.
  std::vector<int> expansions_;     ///< Tried from each node.
  int sample_ = 0;
  int failures_ = 0;  ///< Draws since one was of use.
  Path path_;
};

}  // namespace handway::planning
