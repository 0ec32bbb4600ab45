#include "handway/planning/planners/pmd_auto.h"

#include "handway/geometric/io/input_error.h"
#include "handway/planning/core/planning_context.h"
#include "handway/planning/planners/pmd_lazy.h"
#include "handway/planning/planners/rrt_connect.h"
#include "handway/sampling/sequences/random_stream.h"
#include "planners/bidirectional_search.h"
#include "planners/lazy_search.h"
#include "planners/race.h"
#include "planners/search_parameters.h"
#include "planners/smooth_result.h"

#include <fmt/format.h>

#include <limits>
#include <memory>
#include <utility>

namespace handway::planning {
namespace {

constexpr int kUnlimited = std::numeric_limits<int>::max();  // the race counts samples itself

RrtConnectSettings joint_trees() {
  RrtConnectSettings settings;
  settings.max_samples = kUnlimited;
  return settings;
}

// Short steps and a wide corridor: made for leaving tight places along a line.
RrtConnectSettings cartesian_trees() {
  RrtConnectSettings settings = joint_trees();
  settings.region.corridor = static_cast<int>(CorridorForm::kCartesian);
  settings.range = 0.1;
  settings.refinements = 2;
  settings.region.near_ends = 0.5;
  settings.single_moves = 0.5;
  return settings;
}

PmdLazySettings lazy_roadmap() {
  PmdLazySettings settings;
  settings.max_samples = kUnlimited;
  return settings;
}

Racer trees(std::string name, int first_round, const RrtConnectSettings& settings,
            std::uint64_t seed) {
  return {std::move(name), first_round,
          [&settings, seed](PlanningContext& context) -> std::unique_ptr<Search> {
            return std::make_unique<BidirectionalSearch>(context, settings,
                                                         HandSpace::kPrincipalDirections, seed);
          }};
}

// Takes no part if the arm has no closed-form inverse kinematics.
Racer where_possible(Racer racer) {
  racer.make = [make = std::move(racer.make)](PlanningContext& context) {
    try {
      return make(context);
    } catch (const geometric::InputError&) {
      return std::unique_ptr<Search>();
    }
  };
  return racer;
}

enum class Kind { kJointTrees, kCartesianTrees, kLazyRoadmap };

/// Who takes part in the race.
struct Entry {
  Kind kind;
  std::string name;
  int first_round;
  std::uint64_t fork;  ///< Of the run's seed; 0: the seed itself.
};

std::vector<Entry> entries(const PmdAutoSettings& settings) {
  std::vector<Entry> list{{Kind::kJointTrees, "trees in the joint corridor", 0, 0}};
  if (settings.cartesian) {
    list.push_back({Kind::kCartesianTrees, "trees in the Cartesian corridor", 1, 1});
    list.push_back(
        {Kind::kCartesianTrees, "trees in the Cartesian corridor, from another seed", 3, 2});
  }
  if (settings.lazy) {
    list.push_back({Kind::kLazyRoadmap, "a lazy roadmap", 3, 3});
  }
  list.push_back({Kind::kJointTrees, "trees in the joint corridor, from another seed", 4, 4});
  return list;
}

}  // namespace

std::string PmdAuto::name() const { return "pmd-auto"; }

std::string PmdAuto::description() const {
  return "Races trees in the joint and the Cartesian corridor and a lazy roadmap";
}

PlannerCapabilities PmdAuto::capabilities() const {
  return {.uses_pmds = true, .uses_threads = true, .deterministic = true};
}

std::vector<Parameter> PmdAuto::parameters() {
  return {
      {"max_samples", "Samples", "", "Samples that all searches draw together before giving up.",
       &settings_.max_samples, 1, 100000000},
      smoothing_checks_parameter(settings_.smoothing_checks),
      {"cartesian", "Search in tool poses", "",
       "Trees in the Cartesian corridor take part, if the arm is built like the TX90.",
       &settings_.cartesian, 0.0, 1.0},
      {"lazy", "Search a lazy roadmap", "", "A lazy roadmap takes part.", &settings_.lazy, 0.0,
       1.0},
  };
}

std::vector<TargetRegion> PmdAuto::regions() const {
  std::vector<TargetRegion> regions;
  for (const Entry& entry : entries(settings_)) {
    regions.push_back(entry.kind == Kind::kJointTrees       ? joint_trees().region
                      : entry.kind == Kind::kCartesianTrees ? cartesian_trees().region
                                                            : lazy_roadmap().region);
  }
  return regions;
}

void PmdAuto::do_plan(PlanningContext& context, PlanResult& result) {
  const RrtConnectSettings joint = joint_trees();
  const RrtConnectSettings cartesian = cartesian_trees();
  const PmdLazySettings roadmap = lazy_roadmap();
  const std::uint64_t seed = context.request().seed;
  const sampling::RandomStream seeds(seed);
  std::vector<Racer> racers;
  for (const Entry& entry : entries(settings_)) {
    const std::uint64_t own = entry.fork == 0 ? seed : seeds.fork(entry.fork).seed();
    if (entry.kind == Kind::kLazyRoadmap) {
      racers.push_back({entry.name, entry.first_round,
                        [&roadmap, own](PlanningContext& lane) -> std::unique_ptr<Search> {
                          return std::make_unique<LazySearch>(lane, roadmap, own);
                        }});
    } else if (entry.kind == Kind::kCartesianTrees) {
      racers.push_back(where_possible(trees(entry.name, entry.first_round, cartesian, own)));
    } else {
      racers.push_back(trees(entry.name, entry.first_round, joint, own));
    }
  }
  Race race(context, std::move(racers), static_cast<std::uint64_t>(settings_.max_samples));
  result.status = race.run();
  if (result.solved()) {
    smooth_result(context, *context.problem().basis, settings_.smoothing_checks, race.path(),
                  result);
    result.reason =
        fmt::format("Found a path of {} waypoints after {} samples, by {}.",
                    result.path.waypoints.size(), context.statistics().samples, race.winner());
  }
}

}  // namespace handway::planning
