#pragma once

#include "handway/planning/planners/rrt_connect.h"
#include "planners/search.h"
#include "planners/search_space.h"
#include "planners/target_draws.h"
#include "planners/tree_pair.h"

#include <memory>
#include <optional>

namespace handway::planning {

/// The search of RrtConnect.
class BidirectionalSearch final : public Search {
 public:
  /// @param settings must outlive this object.
  /// @throws InputError as make_search_space().
  BidirectionalSearch(PlanningContext& context, const RrtConnectSettings& settings, HandSpace hand,
                      std::uint64_t seed);

  [[nodiscard]] Path path() const override { return path_; }

 protected:
  [[nodiscard]] std::optional<PlanStatus> step() override;

 private:
  void announce_node(int node, const TargetDraws::Target& target);
  [[nodiscard]] std::optional<int> extend(int tree, const TargetDraws::Target& target);
  [[nodiscard]] std::optional<int> step_towards(int from, const Eigen::VectorXd& end, double range,
                                                const TargetDraws::Target& target);
  [[nodiscard]] bool connect(int reached, const TargetDraws::Target& target);
  [[nodiscard]] bool passable(const Configuration& from, const Configuration& to, double length);
  [[nodiscard]] bool verify(TreePair::Way way);
  [[nodiscard]] std::uint64_t edge_checks() const;

  const RrtConnectSettings& settings_;
  bool lazy_;
  std::unique_ptr<SearchSpace> space_;
  TargetDraws draws_;
  TreePair trees_;
  int sample_ = 0;
  int failures_ = 0;  ///< Draws since one was of use.
  Path path_;
};

}  // namespace handway::planning
