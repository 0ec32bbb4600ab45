#pragma once

#include "joint_cube.h"

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/goals/GoalState.h>

#include <cstdint>
#include <memory>

namespace handway::planner_ompl {

/// The random numbers of one run: where their seeds come from, and how many samples
/// were drawn with them.
///
/// OMPL seeds every generator from a generator of the whole program. Two runs would
/// differ by what ran before them; so samplers are seeded from here instead.
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

/// Makes `space` draw uniformly with seeds and counts of `draws`, which must outlive it.
void draw_from(ompl::base::RealVectorStateSpace& space, Draws& draws);

/// The problem's goal. To draw it counts as a sample, so that a planner that does
/// nothing else comes to its end too. `draws` must outlive it.
[[nodiscard]] std::shared_ptr<ompl::base::GoalState> make_goal(
    const ompl::base::SpaceInformationPtr& information, Draws& draws);

}  // namespace handway::planner_ompl
