#pragma once

#include "handway/planning/core/planning_context.h"
#include "state_map.h"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/StateValidityChecker.h>

#include <cstddef>
#include <unordered_set>
#include <utility>

namespace handway::planner_ompl {

/// OMPL's validity check of a state, by a run's collision checker. Once the run has to end, every
/// state is valid, and no motion is any more: some planners sample until they have a valid state,
/// none until it has a valid motion.
class StateCheck final : public ompl::base::StateValidityChecker {
 public:
  /// `context` and `map` must outlive this object.
  StateCheck(const ompl::base::SpaceInformationPtr& information, planning::PlanningContext& context,
             const StateMap& map);

  [[nodiscard]] bool isValid(const ompl::base::State* state) const override;

 private:
  planning::PlanningContext& context_;
  const StateMap& map_;
};

/// OMPL's motion validator for the whole motion instead of samples of it
/// (geometric::ContinuousCollisionChecker). As OMPL requires, the first state is assumed to be
/// valid and the second is checked. Once the run has to end, every motion is invalid.
class MotionCheck final : public ompl::base::MotionValidator {
 public:
  /// `context` and `map` must outlive this object.
  MotionCheck(const ompl::base::SpaceInformationPtr& information,
              planning::PlanningContext& context, const StateMap& map);

  [[nodiscard]] bool checkMotion(const ompl::base::State* from,
                                 const ompl::base::State* to) const override;

  /// If the motion is not free, `last_valid` gets the end of a free part of it: the longest of
  /// those tried by bisection, or `from` and 0 if none was free.
  [[nodiscard]] bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                                 std::pair<ompl::base::State*, double>& last_valid) const override;

  /// Returns whether the motion between two configurations, in either direction, was found free.
  [[nodiscard]] bool known_free(const planning::Configuration& a,
                                const planning::Configuration& b) const;

 private:
  [[nodiscard]] bool is_free(const planning::Configuration& from,
                             const planning::Configuration& to) const;
  /// Share of the motion, in [0, 1], that is free from its beginning on.
  [[nodiscard]] double free_share(const ompl::base::State* from, const ompl::base::State* to) const;

  planning::PlanningContext& context_;
  const StateMap& map_;
  mutable std::unordered_set<std::size_t> free_;  ///< Hashes of motions.
};

}  // namespace handway::planner_ompl
