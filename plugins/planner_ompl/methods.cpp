#include "methods.h"

#include "roadmap_methods.h"

#include <ompl/geometric/planners/est/EST.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include <memory>

namespace handway::planner_ompl {
namespace {

using ompl::base::PlannerPtr;
using ompl::base::SpaceInformationPtr;

template <class Kind>
PlannerPtr make(const SpaceInformationPtr& information) {
  return std::make_shared<Kind>(information);
}

const MethodSetting kRange = {
    "range",
    "Step length",
    "Longest step of a tree, in joints normalised to [0, 1]. 0: a fifth of the cube's diagonal.",
    0.0,
    0.0,
    10.0};
const MethodSetting kGoalBias = {
    "goal_bias", "Share of the goal", "Share of samples that are the goal itself.", 0.05, 0.0, 1.0};
const MethodSetting kNeighbours = {"max_nearest_neighbors",
                                   "Neighbours",
                                   "Nearest milestones that a new one is connected to.",
                                   10,
                                   1.0,
                                   1000.0};

std::vector<MethodSetting> kpiece_settings() {
  return {
      kRange,
      kGoalBias,
      {"border_fraction", "Share of the border",
       "Share of expansions from cells at the border of what is explored.", 0.9, 0.001, 1.0},
      {"failed_expansion_score_factor", "Factor of failure",
       "A cell's score is multiplied by this when an expansion from it fails.", 0.5, 0.001, 1.0},
      {"min_valid_path_fraction", "Least part of a step",
       "A step that is not free is kept up to where it is, if that is more than this share.", 0.2,
       0.001, 1.0}};
}

}  // namespace

const std::vector<Method>& methods() {
  static const std::vector<Method> kMethods = {
      {"ompl-prm", "OMPL's PRM: a roadmap over all joints", make<SequentialPrm>, {kNeighbours}},
      {"ompl-lazy-prm",
       "OMPL's LazyPRM: a roadmap over all joints, checked where a path leads",
       make<CheckedLazyPrm>,
       {kNeighbours}},
      {"ompl-rrt",
       "OMPL's RRT: a tree over all joints that grows towards samples",
       make<ompl::geometric::RRT>,
       {kRange, kGoalBias}},
      {"ompl-rrt-connect",
       "OMPL's RRTConnect: two trees over all joints",
       make<ompl::geometric::RRTConnect>,
       {kRange}},
      {"ompl-est",
       "OMPL's EST: a tree over all joints that grows where it is sparse",
       make<ompl::geometric::EST>,
       {kRange, kGoalBias}},
      {"ompl-kpiece",
       "OMPL's KPIECE1: a tree over all joints that grows at the border of a projection's cells",
       make<ompl::geometric::KPIECE1>, kpiece_settings()},
  };
  return kMethods;
}

}  // namespace handway::planner_ompl
