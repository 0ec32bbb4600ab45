#include "handway/planning/planners/auto_planner.h"

#include "handway/geometric/io/input_error.h"
#include "handway/planning/core/planning_context.h"
#include "handway/planning/planners/pmd_lazy.h"
#include "handway/planning/planners/rrt_connect.h"
#include "handway/sampling/sequences/random_stream.h"
#include "paths/subspace_entry.h"
#include "planners/bidirectional_search.h"
#include "planners/lazy_search.h"
#include "planners/race.h"
#include "planners/search_parameters.h"
#include "planners/smooth_result.h"

#include <fmt/format.h>

#include <limits>
#include <memory>
#include <optional>
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

RrtConnectSettings whole_space_trees() {
  RrtConnectSettings settings = RrtConnect(HandSpace::kAllJoints).settings();
  settings.max_samples = kUnlimited;
  return settings;
}

/// Free motions from both ends into the PMD subspace, as subspace_entry().
struct Entries {
  std::vector<Configuration> from_start;  ///< Into the subspace.
  std::vector<Configuration> from_goal;
};

// How the hand gets into the PMD subspace at both ends; an end alone where that is not found, and
// nothing if there is nothing to gain.
std::optional<Entries> subspace_entries(PlanningContext& context, const ObjectiveWeights& weights) {
  const PlanningProblem& problem = context.problem();
  if (!problem.basis || weights.human_likeness <= 0.0) {
    return std::nullopt;
  }
  const Objective objective(problem, weights);
  sampling::RandomStream draw = sampling::RandomStream(context.request().seed).fork(6);
  const auto entry = [&](const Configuration& end, const Configuration& other) {
    return subspace_entry(context, objective, end, other, draw)
        .value_or(std::vector<Configuration>{end});
  };
  Entries entries{entry(problem.start, problem.goal), entry(problem.goal, problem.start)};
  const bool useful = entries.from_start.size() + entries.from_goal.size() > 2;
  return useful ? std::optional(std::move(entries)) : std::nullopt;
}

// From start to goal by way of the entries.
Path with_entries(const Entries& entries, const Path& between) {
  Path path;
  path.waypoints.assign(entries.from_start.begin(), entries.from_start.end() - 1);
  path.waypoints.insert(path.waypoints.end(), between.waypoints.begin(), between.waypoints.end());
  path.waypoints.insert(path.waypoints.end(), entries.from_goal.rbegin() + 1,
                        entries.from_goal.rend());
  return path;
}

enum class Kind { kJointTrees, kCartesianTrees, kLazyRoadmap, kWholeSpaceTrees };

/// Who takes part in the race.
struct Participant {
  Kind kind;
  std::string name;
  int first_round;
  std::uint64_t fork;  ///< Of the run's seed; 0: the seed itself.
};

std::vector<Participant> participants(const AutoPlannerSettings& settings, bool has_basis) {
  std::vector<Participant> list{{Kind::kJointTrees, "trees in the joint corridor", 0, 0}};
  if (!has_basis) {
    list.push_back({Kind::kWholeSpaceTrees, "trees over all joints", 1, 5});
  }
  if (settings.cartesian) {
    list.push_back({Kind::kCartesianTrees, "trees in the Cartesian corridor", 1, 1});
    list.push_back(
        {Kind::kCartesianTrees, "trees in the Cartesian corridor, from another seed", 3, 2});
  }
  if (settings.lazy) {
    list.push_back({Kind::kLazyRoadmap, "a lazy roadmap", 3, 3});
  }
  list.push_back({Kind::kJointTrees, "trees in the joint corridor, from another seed", 4, 4});
  if (has_basis) {
    list.push_back({Kind::kWholeSpaceTrees, "trees over all joints", 5, 5});
  }
  return list;
}

/// What all searches of one run are made with.
struct RaceSettings {
  RrtConnectSettings joint = joint_trees();
  RrtConnectSettings cartesian = cartesian_trees();
  RrtConnectSettings whole_space = whole_space_trees();
  PmdLazySettings roadmap = lazy_roadmap();
};

// Null: the arm has no closed-form inverse kinematics for a Cartesian corridor.
std::unique_ptr<Search> make_search(Kind kind, const RaceSettings& settings,
                                    PlanningContext& context, std::uint64_t seed) {
  const auto trees = [&](const RrtConnectSettings& tree_settings, HandSpace hand) {
    return std::make_unique<BidirectionalSearch>(context, tree_settings, hand, seed);
  };
  switch (kind) {
    case Kind::kJointTrees:
      return trees(settings.joint, HandSpace::kPrincipalDirections);
    case Kind::kWholeSpaceTrees:
      return trees(settings.whole_space, HandSpace::kAllJoints);
    case Kind::kLazyRoadmap:
      return std::make_unique<LazySearch>(context, settings.roadmap, seed);
    default:
      try {
        return trees(settings.cartesian, HandSpace::kPrincipalDirections);
      } catch (const geometric::InputError&) {
        return nullptr;
      }
  }
}

}  // namespace

std::string AutoPlanner::name() const { return "auto"; }

std::string AutoPlanner::description() const {
  return "Races trees in the joint and the Cartesian corridor, over all joints, and a lazy roadmap";
}

PlannerCapabilities AutoPlanner::capabilities() const {
  return {.uses_pmds = true, .uses_threads = true, .deterministic = true};
}

std::vector<Parameter> AutoPlanner::own_parameters() {
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

std::vector<TargetRegion> AutoPlanner::regions(bool has_basis) const {
  const RaceSettings race;
  std::vector<TargetRegion> regions;
  for (const Participant& participant : participants(settings_, has_basis)) {
    regions.push_back(participant.kind == Kind::kJointTrees       ? race.joint.region
                      : participant.kind == Kind::kCartesianTrees ? race.cartesian.region
                      : participant.kind == Kind::kLazyRoadmap    ? race.roadmap.region
                                                                  : TargetRegion{.rho_a = 1.0});
  }
  regions.push_back(race.joint.region);  // of the trees in the principal motion directions
  return regions;
}

void AutoPlanner::do_plan(PlanningContext& context, PlanResult& result) {
  const RaceSettings searches;
  const bool has_basis = context.problem().basis != nullptr;
  const std::uint64_t seed = context.request().seed;
  const sampling::RandomStream seeds(seed);
  const std::vector<Participant> list = participants(settings_, has_basis);
  const auto entries_found = subspace_entries(context, objective().weights(context.problem()));
  PlanningProblem between = context.problem();
  std::vector<Racer> racers;
  if (entries_found) {
    between.start = entries_found->from_start.back();
    between.goal = entries_found->from_goal.back();
    racers.push_back({"trees in the principal motion directions", 0,
                      [&searches, seed](PlanningContext& lane) {
                        return make_search(Kind::kJointTrees, searches, lane, seed);
                      },
                      &between, static_cast<int>(list.size())});
  }
  const int head_start = entries_found ? 1 : 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Participant& participant = list[i];
    const std::uint64_t own = participant.fork == 0 ? seed : seeds.fork(participant.fork).seed();
    racers.push_back({participant.name, participant.first_round + head_start,
                      [&searches, kind = participant.kind, own](PlanningContext& lane) {
                        return make_search(kind, searches, lane, own);
                      },
                      nullptr, static_cast<int>(i)});
  }
  Race race(context, std::move(racers), static_cast<std::uint64_t>(settings_.max_samples));
  result.status = race.run();
  if (result.solved()) {
    const Path found =
        race.winner_problem() == &between ? with_entries(*entries_found, race.path()) : race.path();
    smooth_result(context, objective(), settings_.smoothing_checks, found, result);
    result.reason =
        fmt::format("Found a path of {} waypoints after {} samples, by {}{}.",
                    result.path.waypoints.size(), context.statistics().samples, race.winner(),
                    has_basis ? "" : ", over all joints: the scene has no hand basis");
  }
}

}  // namespace handway::planning
