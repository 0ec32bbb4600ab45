#pragma once

#include "handway/planning/planners/pmd_lazy.h"
#include "handway/planning/spaces/target_sampler.h"
#include "planners/search.h"
#include "roadmap/lazy_roadmap.h"

#include <memory>
#include <optional>
#include <vector>

namespace handway::planning {

/// The search of PmdLazy.
class LazySearch final : public Search {
 public:
  /// @param settings must outlive this object.
  /// @throws InputError as make_corridor_space().
  LazySearch(PlanningContext& context, const PmdLazySettings& settings, std::uint64_t seed);

  [[nodiscard]] Path path() const override;

 protected:
  [[nodiscard]] std::optional<PlanStatus> step() override;

 private:
  void add_node(const Configuration& q, const TargetSampler::Target& target);
  void draw_node();
  [[nodiscard]] bool is_free(const std::vector<int>& way);

  const PmdLazySettings& settings_;
  TargetSampler targets_;
  const CorridorSpace& space_;
  LazyRoadmap roadmap_;
  int sample_ = 0;
  int failures_ = 0;      ///< Draws since one was free.
  int nodes_wanted_ = 0;  ///< Before the next look for a way.
  std::vector<int> way_;
};

}  // namespace handway::planning
