#include "motion_check.h"

#include <boost/functional/hash.hpp>
#include <ompl/base/SpaceInformation.h>

namespace handway::planner_ompl {

using ompl::base::State;
using planning::Configuration;

namespace {

// Hashes a motion; both directions have the same hash.
std::size_t hash_of(const Configuration& a, const Configuration& b) {
  return boost::hash_range(a.begin(), a.end()) ^ boost::hash_range(b.begin(), b.end());
}

}  // namespace

StateCheck::StateCheck(const ompl::base::SpaceInformationPtr& information,
                       planning::PlanningContext& context, const StateMap& map)
    : StateValidityChecker(information), context_(context), map_(map) {}

bool StateCheck::isValid(const State* state) const {
  return context_.interruption() || !context_.validator().collision(map_.read(state));
}

MotionCheck::MotionCheck(const ompl::base::SpaceInformationPtr& information,
                         planning::PlanningContext& context, const StateMap& map)
    : MotionValidator(information), context_(context), map_(map) {}

bool MotionCheck::is_free(const Configuration& from, const Configuration& to) const {
  const Configuration end = map_.problem().model().nearest_equivalent(from, to);
  if (context_.interruption() || context_.validator().collision(to) ||
      !context_.validator().edge_free(from, end)) {
    return false;
  }
  free_.insert(hash_of(from, to));
  return true;
}

bool MotionCheck::known_free(const Configuration& a, const Configuration& b) const {
  return free_.contains(hash_of(a, b));
}

bool MotionCheck::checkMotion(const State* from, const State* to) const {
  const bool free = is_free(map_.read(from), map_.read(to));
  ++(free ? valid_ : invalid_);
  return free;
}

// OMPL's own interpolation gives the state at a share of the motion: the planner stores that state
// as a node.
double MotionCheck::free_share(const State* from, const State* to) const {
  constexpr int kHalvings = 5;  // to 1/32 of the motion
  const Configuration begin = map_.read(from);
  State* end = si_->allocState();
  double free = 0.0;
  double taken = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (free + taken);
    si_->getStateSpace()->interpolate(from, to, middle, end);
    (is_free(begin, map_.read(end)) ? free : taken) = middle;
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
