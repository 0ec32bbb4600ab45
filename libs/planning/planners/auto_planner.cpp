#include "handway/planning/core/objective.h"
#include "handway/planning/core/planning_context.h"
#include "handway/planning/paths/path_optimizer.h"
#include "handway/planning/spaces/state_space.h"
#include "handway/planning/spaces/target_sampler.h"
#include "handway/sampling/sequences/random_stream.h"
#include "planners/built_in.h"
#include "planners/portfolio.h"
#include "planners/rrt_connect.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

using Point = Objective::Point;

constexpr int kTrials = 30;           // postures beside one that collides
constexpr double kLargestStep = 1.0;  // to those, in half-sides of the subspace's box
constexpr int kBisections = 3;
constexpr double kInside = 0.02;  // a hand nearer to the subspace needs no entry
constexpr int kEntries = 3;       // tried at each place
constexpr std::array<double, 4> kRetreats = {0.0, 0.05, 0.12, 0.25};  // normalised joints
constexpr std::uint64_t kMostChecks = 60;                             // checks of one motion

// Finds by bisection the free point nearest to `at` on the line to `at` moved by `step`.
Point nearest_free(PlanningContext& context, const Objective& objective, const Point& at,
                   const Eigen::VectorXd& step, Point free) {
  double colliding = 0.0;
  double reached = 1.0;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (colliding + reached);
    Point nearer = objective.moved_along_subspace(at, middle * step);
    if (context.validator().collision(nearer.q)) {
      colliding = middle;
    } else {
      reached = middle;
      free = std::move(nearer);
    }
  }
  return free;
}

/// A free configuration with the hand in the PMD subspace, near `at` and with its arm: the hand at
/// the closest posture or, if that collides, at a sampled one beside it.
std::optional<Point> free_in_subspace(PlanningContext& context, const Objective& objective,
                                      const Point& at, sampling::RandomStream& draw) {
  Point closest = objective.towards_subspace(at, 1.0);
  if (!context.validator().collision(closest.q)) {
    return closest;
  }
  for (int trial = 0; trial < kTrials; ++trial) {
    const double size = kLargestStep * (trial + 1.0) / kTrials;
    const Eigen::VectorXd step =
        size * (2.0 * draw.uniform(objective.subspace_dimension()).array() - 1.0);
    Point point = objective.moved_along_subspace(closest, step);
    if (!context.validator().collision(point.q)) {
      return nearest_free(context, objective, closest, step, std::move(point));
    }
  }
  return std::nullopt;
}

/// Free motions from an end of the problem into the PMD subspace: the hand goes straight to it; if
/// obstacles prevent that, the arm first retreats a little along the straight motion to the other
/// end. @param other the other end.
/// @returns from the end to the entry; the end alone if it is in the subspace, or no entry was
/// found.
std::vector<Configuration> subspace_entry(PlanningContext& context, const Objective& objective,
                                          const Configuration& end, const Configuration& other,
                                          sampling::RandomStream& draw) {
  const Point at = objective.point(end);
  if (at.distance() < kInside) {
    return {end};
  }
  Configuration back = end;
  back(context.problem().joints.arm) = other(context.problem().joints.arm);
  const double length = objective.point(back).distance_to(at);
  for (const double retreat : kRetreats) {
    if (retreat > length) {
      break;
    }
    const Configuration from = retreat == 0.0 ? end : end + retreat / length * (back - end);
    if (retreat > 0.0 && (context.validator().collision(from) ||
                          !context.validator().edge_free(end, from, kMostChecks))) {
      break;
    }
    for (int entry = 0; entry < kEntries; ++entry) {
      const auto inside = free_in_subspace(context, objective, objective.point(from), draw);
      if (inside && context.validator().edge_plausible(from, inside->q, 3) &&
          context.validator().edge_free(from, inside->q, kMostChecks)) {
        return retreat > 0.0 ? std::vector{end, from, inside->q} : std::vector{end, inside->q};
      }
    }
  }
  return {end};
}

/// Free motions from the start and from the goal into the PMD subspace, as subspace_entry().
struct Entries {
  std::vector<Configuration> from_start;
  std::vector<Configuration> from_goal;
};

// Entries of the hand into the PMD subspace at both ends; nothing if they bring no gain.
std::optional<Entries> subspace_entries(PlanningContext& context, const ObjectiveWeights& weights) {
  const PlanningProblem& problem = context.problem();
  if (!problem.basis || weights.human_likeness <= 0.0) {
    return std::nullopt;
  }
  const Objective objective(problem, weights);
  sampling::RandomStream draw = sampling::RandomStream(context.request().seed).fork(6);
  Entries entries{subspace_entry(context, objective, problem.start, problem.goal, draw),
                  subspace_entry(context, objective, problem.goal, problem.start, draw)};
  const bool useful = entries.from_start.size() + entries.from_goal.size() > 2;
  return useful ? std::optional(std::move(entries)) : std::nullopt;
}

// From start to goal through the entries.
Path with_entries(const Entries& entries, const Path& between) {
  Path path;
  path.waypoints.assign(entries.from_start.begin(), entries.from_start.end() - 1);
  path.waypoints.insert(path.waypoints.end(), between.waypoints.begin(), between.waypoints.end());
  path.waypoints.insert(path.waypoints.end(), entries.from_goal.rbegin() + 1,
                        entries.from_goal.rend());
  return path;
}

/// A search of the portfolio.
struct Participant {
  std::string name;
  int first_round;
  std::uint64_t fork;  ///< Fork of the run's seed; 0: the seed itself.
  HandSpace hand;
  RrtConnectSettings settings;
};

// Unlimited samples: the portfolio counts them itself.
RrtConnectSettings without_limit(RrtConnectSettings settings = {}) {
  settings.max_samples = std::numeric_limits<int>::max();
  return settings;
}

// Without a basis, hand postures are sampled over all joints anyway. @param form space of the
// expansive trees, which leave narrow passages.
std::vector<Participant> participants(CorridorForm form, bool has_basis) {
  constexpr HandSpace kPmds = HandSpace::kPrincipalDirections;
  constexpr HandSpace kAll = HandSpace::kAllJoints;
  const RrtConnectSettings expansive = without_limit(
      {.range = 0.1, .expansions = 1.0, .region = {.corridor = static_cast<int>(form)}});
  // If the corridor contains no path, for example around a wall, trees soon find one far from it.
  const RrtConnectSettings corridor = without_limit({.region = {.anywhere = 0.5}});
  return {
      {"tree search in the joint corridor", 0, 0, kPmds, corridor},
      {"expansive tree search", 1, 1, kPmds, expansive},
      {"expansive tree search with another seed", 2, 2, kPmds, expansive},
      has_basis ? Participant{"expansive tree search over all joints", 3, 3, kAll, expansive}
                : Participant{"tree search over all joints", 1, 5, kAll,
                              without_limit(kSettingsOverAllJoints)},
  };
}

class AutoPlanner final : public BuiltInPlanner {
 public:
  AutoPlanner()
      : BuiltInPlanner(kAutoPlanner, "Runs several tree searches and keeps the first path found",
                       {.uses_pmds = true, .uses_threads = true}) {}

 protected:
  void do_plan(PlanningContext& context, PlanResult& result) override {
    const bool has_basis = context.problem().basis != nullptr;
    // Poses of the tool need closed-form inverse kinematics: iterations for every node cost more
    // than they gain.
    const CorridorForm form = cartesian_ && has_closed_form_kinematics(context.problem())
                                  ? CorridorForm::kCartesian
                                  : CorridorForm::kJoint;
    const std::vector<Participant> list = participants(form, has_basis);
    const sampling::RandomStream seeds(context.request().seed);
    const auto entries_found = subspace_entries(context, objective().weights(context.problem()));
    PlanningProblem between = context.problem();
    std::vector<PortfolioMember> members;
    for (const Participant& participant : list) {
      const std::uint64_t seed =
          participant.fork == 0 ? seeds.seed() : seeds.fork(participant.fork).seed();
      members.push_back(
          {participant.name, participant.first_round, [&participant, seed](PlanningContext& lane) {
             return std::make_unique<BidirectionalSearch>(lane, participant.settings,
                                                          participant.hand, seed);
           }});
    }
    if (entries_found) {
      between.start = entries_found->from_start.back();
      between.goal = entries_found->from_goal.back();
      members.front().name = "tree search along the principal motion directions";
      members.front().problem = &between;
    }
    Portfolio portfolio(context, std::move(members), static_cast<std::uint64_t>(max_samples_));
    result.status = portfolio.run();
    if (result.solved()) {
      const Path found = portfolio.winner().problem == &between
                             ? with_entries(*entries_found, portfolio.path())
                             : portfolio.path();
      constexpr int kMostRounds = 6;
      smooth_result(context, objective(), smoothing_checks_, found, result, kMostRounds);
      result.reason = fmt::format("{} waypoints, {}. Found by {}{}.", result.path.waypoints.size(),
                                  context.statistics().samples_text(), portfolio.winner().name,
                                  has_basis ? "" : " (the scene has no hand basis)");
    }
  }

  [[nodiscard]] std::vector<geometric::BoundParameter> own_parameters() override {
    return {
        {"max_samples", "Samples", "",
         "Largest number of samples of all searches together; the planner then gives up.",
         &max_samples_, 1, 100000000},
        smoothing_checks_parameter(smoothing_checks_),
        {"cartesian", "Search in tool poses", "",
         "Grow expansive trees in poses of the tool, if the arm's inverse kinematics has a closed "
         "form.",
         &cartesian_, 0.0, 1.0},
    };
  }

 private:
  int max_samples_ = 1000000;  ///< Limit of all searches together.
  int smoothing_checks_ = 600;
  bool cartesian_ = true;  ///< Expansive trees grow in poses of the arm's tool.
};

}  // namespace

std::unique_ptr<Planner> make_auto_planner() { return std::make_unique<AutoPlanner>(); }

std::vector<TargetRegion> regions_of_auto_planner() {
  std::vector<TargetRegion> regions;
  for (const Participant& participant : participants(CorridorForm::kJoint, true)) {
    regions.push_back(participant.settings.expansions < 1.0 &&
                              participant.hand == HandSpace::kPrincipalDirections
                          ? participant.settings.region
                          : TargetRegion{.rho_a = 1.0});
  }
  return regions;
}

}  // namespace handway::planning
