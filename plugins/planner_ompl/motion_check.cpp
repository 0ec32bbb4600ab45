#include "motion_check.h"

#include <ompl/base/SpaceInformation.h>

namespace handway::planner_ompl {

using ompl::base::State;
using planning::Configuration;

StateCheck::StateCheck(const ompl::base::SpaceInformationPtr& information,
                       planning::PlanningContext& context, const JointCube& cube)
    : StateValidityChecker(information), context_(context), cube_(cube) {}

bool StateCheck::isValid(const State* state) const {
  return !context_.interruption() && !context_.collision(cube_.read(state));
}

MotionCheck::MotionCheck(const ompl::base::SpaceInformationPtr& information,
                         planning::PlanningContext& context, const JointCube& cube)
    : MotionValidator(information), context_(context), cube_(cube) {}

bool MotionCheck::is_free(const Configuration& from, const Configuration& to) const {
  return !context_.interruption() && !context_.collision(to) && context_.edge_free(from, to);
}

bool MotionCheck::checkMotion(const State* from, const State* to) const {
  const bool free = is_free(cube_.read(from), cube_.read(to));
  ++(free ? valid_ : invalid_);
  return free;
}

// The state at a share of the way is what OMPL's own interpolation makes of it: the
// planner keeps that state as a node.
double MotionCheck::free_share(const State* from, const State* to) const {
  constexpr int kHalvings = 5;  // to 1/32 of the motion
  const Configuration begin = cube_.read(from);
  State* end = si_->allocState();
  double free = 0.0;
  double taken = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (free + taken);
    si_->getStateSpace()->interpolate(from, to, middle, end);
    (is_free(begin, cube_.read(end)) ? free : taken) = middle;
  }
  si_->freeState(end);
  return free;
}

bool MotionCheck::checkMotion(const State* from, const State* to,
                              std::pair<State*, double>& last_valid) const {
  if (checkMotion(from, to)) {
    return true;
  }
  last_valid.second = free_share(from, to);
  if (last_valid.first != nullptr) {
    si_->getStateSpace()->interpolate(from, to, last_valid.second, last_valid.first);
  }
  return false;
}

}  // namespace handway::planner_ompl
