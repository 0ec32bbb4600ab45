#pragma once

#include "state_map.h"

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/goals/GoalState.h>

#include <cstdint>
#include <memory>
#include <mutex>

namespace handway::planner_ompl {

/// The random numbers of one run: where their seeds come from, and how many samples
/// were drawn with them.
///
/// OMPL seeds every generator from a generator of the whole program. Two runs would
/// differ by what ran before them; so samplers are seeded from here instead, and
/// whoever makes OMPL's other generators first calls seed_ompl.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : seed_(seed) {}

  /// Another seed, ≥ 1: OMPL takes no 0.
  [[nodiscard]] std::uint_fast32_t next_seed();

  void count() { ++count_; }
  [[nodiscard]] std::uint64_t counted() const { return count_; }
  void forget_count() { count_ = 0; }

 private:
  std::uint64_t seed_;
  std::uint64_t seeds_given_ = 0;
  std::uint64_t count_ = 0;
};

/// As long as this is held no other run makes a generator of OMPL's.
using SeedingLock = std::unique_lock<std::recursive_mutex>;
[[nodiscard]] SeedingLock lock_seeding();

/// Generators that are made as long as `lock` is held get seeds that follow from `draws`.
void seed_ompl(const SeedingLock& lock, Draws& draws);

/// A sampler of `space`, that of `map`. `map` and `draws` must outlive it.
[[nodiscard]] ompl::base::StateSamplerPtr make_sampler(const ompl::base::StateSpace* space,
                                                       const StateMap& map, Draws& draws);

/// Makes `information` draw valid states from its space, with seeds of `draws`, which
/// must outlive it.
void draw_valid_states(ompl::base::SpaceInformation& information);

/// The problem's goal. To draw it counts as a sample, so that a planner that does
/// nothing else comes to its end too. `draws` must outlive it.
[[nodiscard]] std::shared_ptr<ompl::base::GoalState> make_goal(
    const ompl::base::SpaceInformationPtr& information, Draws& draws);

/// Short paths, whose informed samplers (they draw where a path can be shorter than one
/// that is known) are seeded and counted too. `draws` must outlive it.
[[nodiscard]] ompl::base::OptimizationObjectivePtr make_path_length(
    const ompl::base::SpaceInformationPtr& information, Draws& draws);

}  // namespace handway::planner_ompl
