#include "roadmap_methods.h"

#include <boost/range/iterator_range.hpp>
#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/geometric/PathGeometric.h>

#include <vector>

namespace handway::planner_ompl {

using ompl::base::PlannerData;
using ompl::base::PlannerDataVertex;
using ompl::base::PlannerStatus;
using ompl::base::PlannerTerminationCondition;
using ompl::base::State;

SequentialPrm::SequentialPrm(const ompl::base::SpaceInformationPtr& information)
    : PRM(information, false) {}

bool SequentialPrm::add_ends(const PlannerTerminationCondition& stop) {
  while (const State* start = pis_.nextStart()) {
    startM_.push_back(addMilestone(si_->cloneState(start)));
  }
  if (const State* goal = pis_.nextGoal(stop)) {
    goalM_.push_back(addMilestone(si_->cloneState(goal)));
  }
  return !startM_.empty() && !goalM_.empty();
}

// Twice as much growing as expanding, as OMPL does.
void SequentialPrm::build_until(const PlannerTerminationCondition& done) {
  constexpr unsigned long kGrown = 20;
  constexpr unsigned long kExpanded = 10;
  const auto done_or_at = [&](unsigned long count) {
    return PlannerTerminationCondition(
        [this, &done, count] { return done() || milestoneCount() >= count; });
  };
  while (!done()) {
    growRoadmap(done_or_at(milestoneCount() + kGrown));
    expandRoadmap(done_or_at(milestoneCount() + kExpanded));
  }
}

// Who waits for a first solution hears of it.
ompl::base::PathPtr SequentialPrm::announced_path() {
  ompl::base::PathPtr path = constructSolution(startM_.front(), goalM_.front());
  if (const auto& callback = pdef_->getIntermediateSolutionCallback()) {
    std::vector<const State*> states;
    for (const State* state : path->as<ompl::geometric::PathGeometric>()->getStates()) {
      states.push_back(state);
    }
    callback(this, states, path->cost(opt_));
  }
  return path;
}

PlannerStatus SequentialPrm::solve(const PlannerTerminationCondition& stop) {
  checkValidity();
  if (!add_ends(stop)) {
    return startM_.empty() ? PlannerStatus::INVALID_START : PlannerStatus::INVALID_GOAL;
  }
  const auto connected = [this] { return sameComponent(startM_.front(), goalM_.front()); };
  build_until(PlannerTerminationCondition([&] { return connected() || stop(); }));
  if (!connected()) {
    return PlannerStatus::TIMEOUT;
  }
  pdef_->addSolutionPath(announced_path(), false, 0.0, getName());
  return PlannerStatus::EXACT_SOLUTION;
}

void SequentialPrm::getPlannerData(PlannerData& data) const {
  PRM::getPlannerData(data);
  for (const Vertex v : boost::make_iterator_range(boost::vertices(g_))) {
    data.addVertex(PlannerDataVertex(stateProperty_[v]));
  }
}

// Until it knows its range OMPL takes 0 for the longest edge, and keeps to it when asked
// the number of neighbours.
CheckedLazyPrm::CheckedLazyPrm(const ompl::base::SpaceInformationPtr& information)
    : LazyPRM(information, false) {
  setRange(information->getMaximumExtent());
}

void CheckedLazyPrm::getPlannerData(PlannerData& data) const {
  for (const Vertex v : startM_) {
    data.addStartVertex(PlannerDataVertex(stateProperty_[v]));
  }
  for (const Vertex v : goalM_) {
    data.addGoalVertex(PlannerDataVertex(stateProperty_[v]));
  }
  for (const Vertex v : boost::make_iterator_range(boost::vertices(g_))) {
    if ((vertexValidityProperty_[v] & VALIDITY_TRUE) != 0) {
      data.addVertex(PlannerDataVertex(stateProperty_[v]));
    }
  }
  for (const Edge& e : boost::make_iterator_range(boost::edges(g_))) {
    if ((edgeValidityProperty_[e] & VALIDITY_TRUE) != 0) {
      data.addEdge(PlannerDataVertex(stateProperty_[boost::source(e, g_)]),
                   PlannerDataVertex(stateProperty_[boost::target(e, g_)]));
    }
  }
}

}  // namespace handway::planner_ompl
