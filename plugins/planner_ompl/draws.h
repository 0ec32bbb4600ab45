#pragma once

#include "handway/planning/spaces/target_sampler.h"
#include "state_map.h"

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/goals/GoalState.h>

#include <cstdint>
#include <memory>
#include <mutex>

namespace handway::planner_ompl {

/// The random numbers of one run: the source of seeds, and the number of samples drawn with
/// them.
///
/// OMPL seeds every generator from a generator of the whole program, so that two runs would differ
/// by what ran before them. So samplers are seeded from here instead; code that makes OMPL's other
/// generators calls seed_ompl first.
class Draws {
 public:
  /// @param context, region must outlive this object.
  Draws(planning::PlanningContext& context, const planning::TargetRegion& region,
        planning::HandSpace hand)
      : context_(context), region_(region), hand_(hand) {}

  /// Makes the sampler from which a sampler of states draws.
  [[nodiscard]] std::unique_ptr<planning::TargetSampler> make_targets() {
    return std::make_unique<planning::TargetSampler>(context_, region_, hand_, next_seed());
  }

  /// Another seed, ≥ 1: OMPL takes no 0.
  [[nodiscard]] std::uint_fast32_t next_seed();

  void count() { ++count_; }
  [[nodiscard]] std::uint64_t counted() const { return count_; }
  void forget_count() { count_ = 0; }

 private:
  planning::PlanningContext& context_;
  const planning::TargetRegion& region_;
  planning::HandSpace hand_;
  std::uint64_t seeds_given_ = 0;
  std::uint64_t count_ = 0;
};

/// While this is held, no other run makes a generator of OMPL's.
using SeedingLock = std::unique_lock<std::recursive_mutex>;
[[nodiscard]] SeedingLock lock_seeding();

/// Generators made while `lock` is held get seeds that follow from `draws`.
void seed_ompl(const SeedingLock& lock, Draws& draws);

/// Makes every sampler of the space of `map` sample the targets of Handway's own searches, with
/// seeds and counts of `draws`. Both must outlive the space. @pre before samplers are made.
void draw_states(const StateMap& map, Draws& draws);

/// Makes `information` sample valid states from its space, with seeds of `draws`, which must
/// outlive it.
void draw_valid_states(ompl::base::SpaceInformation& information);

/// The problem's goal. Drawing it counts as a sample, so that a planner that only does this ends
/// too. `draws` must outlive it.
[[nodiscard]] std::shared_ptr<ompl::base::GoalState> make_goal(
    const ompl::base::SpaceInformationPtr& information, Draws& draws);

/// Objective of short paths, whose informed samplers (they sample where a path can be shorter than
/// a known one) are seeded and counted too. `draws` must outlive it.
[[nodiscard]] ompl::base::OptimizationObjectivePtr make_path_length(
    const ompl::base::SpaceInformationPtr& information, Draws& draws);

}  // namespace handway::planner_ompl
