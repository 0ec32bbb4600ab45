#include "methods.h"

#include "method_settings.h"
#include "roadmap_methods.h"

#include <ompl/geometric/planners/est/BiEST.h>
#include <ompl/geometric/planners/est/EST.h>
#include <ompl/geometric/planners/est/ProjEST.h>
#include <ompl/geometric/planners/fmt/BFMT.h>
#include <ompl/geometric/planners/fmt/FMT.h>
#include <ompl/geometric/planners/informedtrees/ABITstar.h>
#include <ompl/geometric/planners/informedtrees/AITstar.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/kpiece/BKPIECE1.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/kpiece/LBKPIECE1.h>
#include <ompl/geometric/planners/pdst/PDST.h>
#include <ompl/geometric/planners/rlrt/BiRLRT.h>
#include <ompl/geometric/planners/rlrt/RLRT.h>
#include <ompl/geometric/planners/rrt/BiTRRT.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/LazyRRT.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTXstatic.h>
#include <ompl/geometric/planners/rrt/RRTsharp.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/geometric/planners/rrt/SORRTstar.h>
#include <ompl/geometric/planners/rrt/TRRT.h>
#include <ompl/geometric/planners/sbl/SBL.h>
#include <ompl/geometric/planners/stride/STRIDE.h>

#include <memory>

namespace handway::planner_ompl {
namespace {

namespace og = ompl::geometric;

template <class Kind>
ompl::base::PlannerPtr make(const ompl::base::SpaceInformationPtr& information) {
  return std::make_shared<Kind>(information);
}

constexpr MethodTraits kImproves = {.improves = true};
constexpr MethodTraits kGuesses = {.guesses = true};

}  // namespace

const std::vector<Method>& methods() {
  static const std::vector<Method> kMethods = {
      {"prm", "PRM", "a roadmap", make<SequentialPrm>, {kNeighbours}, {}},
      {"prm-star",
       "PRM*",
       "a roadmap with as many neighbours as its size asks for",
       make<SequentialPrmStar>,
       {},
       kImproves},
      {"lazy-prm",
       "LazyPRM",
       "a roadmap that is checked only where a path leads",
       make<CheckedLazyPrm>,
       {kNeighbours},
       {}},
      {"lazy-prm-star",
       "LazyPRM*",
       "the same with as many neighbours as its size asks for",
       make<CheckedLazyPrmStar>,
       {},
       kImproves},
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
      {"lazy-rrt",
       "LazyRRT",
       "a tree that is checked only where a path leads",
       make<og::LazyRRT>,
       {kRange, kGoalBias},
       kGuesses},
      {"t-rrt",
       "TRRT",
       "a tree that refuses most steps to higher cost",
       make<og::TRRT>,
       {kRange, kGoalBias},
       {}},
      {"bi-t-rrt", "BiTRRT", "two such trees", make<og::BiTRRT>, {kRange}, {}},
      {"rrt-star",
       "RRT*",
       "a tree that is rewired to shorter branches",
       make<og::RRTstar>,
       {kRange, kGoalBias, kRewireFactor},
       kImproves},
      {"informed-rrt-star",
       "InformedRRT*",
       "the same, then samples only where it gets shorter",
       make<og::InformedRRTstar>,
       {kRange, kGoalBias, kRewireFactor},
       kImproves},
      {"sorrt-star",
       "SORRT*",
       "the same with samples in order of what they promise",
       make<og::SORRTstar>,
       {kRange, kGoalBias, kRewireFactor},
       kImproves},
      {"rrt-sharp",
       "RRT#",
       "a tree that is rewired wherever it gets shorter",
       make<og::RRTsharp>,
       {kRange, kGoalBias, kRewireFactor},
       kImproves},
      {"rrt-x",
       "RRTX",
       "the same, for gains that count",
       make<og::RRTXstatic>,
       {kRange, kGoalBias, kRewireFactor},
       kImproves},
      {"est",
       "EST",
       "a tree from the start that grows where it is sparse",
       make<og::EST>,
       {kRange, kGoalBias},
       {}},
      {"bi-est",
       "BiEST",
       "trees from start and goal that grow where they are sparse",
       make<og::BiEST>,
       {kRange},
       {}},
      {"proj-est",
       "ProjEST",
       "a tree that grows where a projection of it is sparse",
       make<og::ProjEST>,
       {kRange, kGoalBias},
       {}},
      {"kpiece",
       "KPIECE1",
       "a tree from the start, at the border of what is explored",
       make<og::KPIECE1>,
       {kRange, kGoalBias, kBorderFraction, kFailureFactor, kLeastPart},
       {}},
      {"bkpiece",
       "BKPIECE1",
       "trees from start and goal, at the border of what is explored",
       make<og::BKPIECE1>,
       {kRange, kBorderFraction, kFailureFactor, kLeastPart},
       {}},
      {"lbkpiece",
       "LBKPIECE1",
       "the same, checked only where a path leads",
       make<og::LBKPIECE1>,
       {kRange, kBorderFraction, kLeastPart},
       kGuesses},
      {"sbl",
       "SBL",
       "trees from start and goal that are checked only where a path leads",
       make<og::SBL>,
       {kRange},
       kGuesses},
      {"stride",
       "STRIDE",
       "a tree from the start that grows where it is sparse in all dimensions",
       make<og::STRIDE>,
       {kRange, kGoalBias, kLeastPart},
       {}},
      {"pdst",
       "PDST",
       "a tree of motions over cells that are halved",
       make<og::PDST>,
       {kGoalBias},
       kGuesses},
      {"rl-rt",
       "RLRT",
       "a tree of leaps as long as they are free",
       make<og::RLRT>,
       {kRange, kGoalBias},
       {}},
      {"bi-rl-rt", "BiRLRT", "two such trees", make<og::BiRLRT>, {kRange}, {}},
      {"fmt",
       "FMT*",
       "a tree by cost to come over samples drawn before",
       make<og::FMT>,
       {kNumSamples},
       {}},
      {"bfmt", "BFMT*", "two such trees", make<og::BFMT>, {kNumSamples}, {}},
      {"bit-star",
       "BIT*",
       "a tree over batches of samples, the most promising edges first",
       make<og::BITstar>,
       {kBatch, kRewireFactor},
       kImproves},
      {"abit-star",
       "ABIT*",
       "the same with a heuristic that is trusted more at first",
       make<og::ABITstar>,
       {kBatch, kRewireFactor},
       kImproves},
      {"ait-star",
       "AIT*",
       "the same with a heuristic that is searched from the goal",
       make<og::AITstar>,
       {kBatch, kRewireFactor},
       kImproves},
  };
  return kMethods;
}

}  // namespace handway::planner_ompl
