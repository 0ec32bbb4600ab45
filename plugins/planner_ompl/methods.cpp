#include "methods.h"

#include <boost/range/iterator_range.hpp>
#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/est/EST.h>
#include <ompl/geometric/planners/fmt/FMT.h>
#include <ompl/geometric/planners/informedtrees/ABITstar.h>
#include <ompl/geometric/planners/informedtrees/AITstar.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/geometric/planners/sbl/SBL.h>
#include <ompl/geometric/planners/stride/STRIDE.h>

#include <memory>
#include <vector>

namespace handway::planner_ompl {
namespace {

namespace og = ompl::geometric;

template <class Kind>
ompl::base::PlannerPtr make(const ompl::base::SpaceInformationPtr& information) {
  return std::make_shared<Kind>(information);
}

// The offered parameters of OMPL, each for all planners that have it.

const MethodSetting kRange = {
    "range",
    "Step length",
    "Longest step of a tree, in joints normalised to [0, 1]. 0: a fifth of the space's diagonal.",
    0.0,
    0.0,
    10.0};
const MethodSetting kGoalBias = {
    "goal_bias", "Goal bias", "Share of samples that are the goal itself.", 0.05, 0.0, 1.0};
const MethodSetting kNeighbours = {"max_nearest_neighbors",
                                   "Neighbours",
                                   "Number of nearest milestones that a new one is connected to.",
                                   10,
                                   1.0,
                                   1000.0};
const MethodSetting kBorderFraction = {
    "border_fraction",
    "Border fraction",
    "Share of expansions from cells at the border of the explored space.",
    0.9,
    0.001,
    1.0};
const MethodSetting kFailureFactor = {"failed_expansion_score_factor",
                                      "Failure factor",
                                      "Factor for a cell's score after a failed expansion from it.",
                                      0.5,
                                      0.001,
                                      1.0};
const MethodSetting kLeastPart = {"min_valid_path_fraction",
                                  "Minimum step share",
                                  "Smallest share of a step in collision whose free part is kept.",
                                  0.2,
                                  0.001,
                                  1.0};
const MethodSetting kRewireFactor = {
    "rewire_factor",
    "Rewiring factor",
    "Factor for the radius in which neighbours are searched, relative to the theoretical one.",
    1.1,
    1.01,
    2.0};
const MethodSetting kNumSamples = {
    "num_samples",
    "Number of samples",
    "Number of valid samples before the tree grows; more are drawn if these are not enough.",
    1000,
    10.0,
    100000.0};
const MethodSetting kBatch = {"samples_per_batch",
                              "Samples per batch",
                              "Number of valid samples before edges are searched again.",
                              100,
                              1.0,
                              10000.0};

constexpr MethodTraits kImproves = {.improves = true};
constexpr MethodTraits kGuesses = {.guesses = true};

}  // namespace

const std::vector<Method>& methods() {
  static const std::vector<Method> kMethods = {
      {"prm", "PRM", "a roadmap", make<SequentialPrm>, {kNeighbours}, {}},
      {"lazy-prm",
       "LazyPRM",
       "a roadmap that is checked only along candidate paths",
       make<CheckedLazyPrm>,
       {kNeighbours},
       {}},
      {"rrt",
       "RRT",
       "a tree from the start that grows towards samples",
       make<og::RRT>,
       {kRange, kGoalBias},
       {}},
      {"rrt-connect",
       "RRTConnect",
       "trees from start and goal",
       make<og::RRTConnect>,
       {kRange},
       {}},
      {"rrt-star",
       "RRT*",
       "a tree that is rewired to shorter branches",
       make<og::RRTstar>,
       {kRange, kGoalBias, kRewireFactor},
       kImproves},
      {"est",
       "EST",
       "a tree from the start that grows where it is sparse",
       make<og::EST>,
       {kRange, kGoalBias},
       {}},
      {"kpiece",
       "KPIECE1",
       "a tree from the start that grows at the border of the explored space",
       make<og::KPIECE1>,
       {kRange, kGoalBias, kBorderFraction, kFailureFactor, kLeastPart},
       {}},
      {"sbl",
       "SBL",
       "trees from start and goal that are checked only along candidate paths",
       make<og::SBL>,
       {kRange},
       kGuesses},
      {"stride",
       "STRIDE",
       "a tree from the start that grows where it is sparse in all dimensions",
       make<og::STRIDE>,
       {kRange, kGoalBias, kLeastPart},
       {}},
      {"fmt",
       "FMT*",
       "a tree over samples that are drawn first, in the order of the cost to come",
       make<og::FMT>,
       {kNumSamples},
       {}},
      {"bit-star",
       "BIT*",
       "a tree over batches of samples; the most promising edges are checked first",
       make<og::BITstar>,
       {kBatch, kRewireFactor},
       kImproves},
      {"abit-star",
       "ABIT*",
       "BIT* with a heuristic that has a larger weight at first",
       make<og::ABITstar>,
       {kBatch, kRewireFactor},
       kImproves},
      {"ait-star",
       "AIT*",
       "BIT* with a heuristic that is computed by a search from the goal",
       make<og::AITstar>,
       {kBatch, kRewireFactor},
       kImproves},
  };
  return kMethods;
}

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

// Announces the first solution.
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

// Until it knows its range OMPL takes 0 for the longest edge, and still uses that when the number
// of neighbours is set.
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
