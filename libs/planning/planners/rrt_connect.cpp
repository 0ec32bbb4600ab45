#include "handway/planning/planners/rrt_connect.h"

#include "handway/planning/core/planning_context.h"
#include "handway/planning/paths/roadmap_smoothing.h"
#include "handway/sampling/sequences/random_stream.h"
#include "planners/hand_arm_space.h"
#include "planners/phase_clock.h"
#include "planners/search_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace handway::planning {
namespace {

using sampling::RandomStream;

class BidirectionalSearch {
 public:
  BidirectionalSearch(PlanningContext& context, const RrtConnectSettings& settings, HandSpace hand)
      : context_(context),
        settings_(settings),
        in_corridor_(hand == HandSpace::kPrincipalDirections),
        space_(context.problem(),
               in_corridor_ ? *context.problem().basis : all_hand_joints(context.problem())),
        draws_(context.request().seed),
        trees_{SearchTree(context.problem().start, space_.coordinates(context.problem().start)),
               SearchTree(context.problem().goal, space_.coordinates(context.problem().goal))} {}

  void run(PlanResult& result) {
    announce_roots();
    for (int sample = 0; sample < settings_.max_samples; ++sample) {
      if (const auto interruption = context_.interruption()) {
        result.status = *interruption;
        return;
      }
      context_.observer().on_progress(static_cast<double>(sample) / settings_.max_samples,
                                      "growing trees");
      ++context_.statistics().samples;
      const int growing = sample % 2;
      const Eigen::VectorXd target = draw(sample);
      const std::optional<int> reached = extend(growing, target);
      if (!reached) {
        continue;
      }
      const Eigen::VectorXd meeting = tree(growing).coordinates(*reached);
      if (const std::optional<int> other = connect(1 - growing, meeting)) {
        result.path = joined(growing == 0 ? *reached : *other, growing == 0 ? *other : *reached);
        result.status = PlanStatus::kSolved;
        return;
      }
    }
    result.status = PlanStatus::kSamplesSpent;
  }

 private:
  SearchTree& tree(int index) { return trees_[static_cast<std::size_t>(index)]; }

  Eigen::VectorXd draw(int sample) {
    RandomStream draw = draws_.fork(static_cast<std::uint64_t>(sample));
    if (!in_corridor_) {
      return draw.uniform(context_.problem().model().variable_count());
    }
    const double widths = std::floor(static_cast<double>(sample) / settings_.samples_per_width);
    const double rho =
        std::min(settings_.rho_max, settings_.rho_a * std::pow(settings_.rho_growth, widths));
    context_.statistics().final_rho_a = rho;
    const Configuration arm = space_.with_arm(
        space_.corridor().sample(draw.uniform(), rho, draw.uniform(space_.arm_dimension())));
    return space_.coordinates(space_.with_hand(arm, draw.uniform(space_.basis().dimension())));
  }

  // Trees are numbered apart: even ids grow from the start, odd ones from the goal.
  static int event_id(int growing, int node) { return 2 * node + growing; }

  void announce_roots() {
    context_.statistics().nodes = 2;
    context_.observer().on_node({event_id(0, 0), tree(0).configuration(0), 0, 0.0, 0.0});
    context_.observer().on_node({event_id(1, 0), tree(1).configuration(0), 0, 1.0, 0.0});
  }

  // One step of at most `range` from the nearest node; the new node, if the way is free.
  std::optional<int> extend(int growing, const Eigen::VectorXd& target) {
    return extend_from(growing, tree(growing).nearest(target), target);
  }

  std::optional<int> extend_from(int growing, int from, const Eigen::VectorXd& target) {
    const Eigen::VectorXd begin = tree(growing).coordinates(from);
    const double distance = (target - begin).norm();
    const double share = std::min(1.0, settings_.range / std::max(distance, 1e-12));
    const Eigen::VectorXd end = share < 1.0 ? begin + share * (target - begin) : target;
    const Configuration q = space_.configuration(end);
    if (context_.collision(q) || !context_.edge_free(tree(growing).configuration(from), q)) {
      return std::nullopt;
    }
    const int node = tree(growing).add(q, end, from);
    auto& statistics = context_.statistics();
    statistics.nodes =
        static_cast<std::uint64_t>(trees_[0].size()) + static_cast<std::uint64_t>(trees_[1].size());
    ++statistics.edges;
    context_.observer().on_node({event_id(growing, node), q, 0, 0.0, statistics.final_rho_a});
    context_.observer().on_edge(event_id(growing, from), event_id(growing, node));
    return node;
  }

  // Steps towards `target` until there, or until one is not free.
  std::optional<int> connect(int growing, const Eigen::VectorXd& target) {
    int at = tree(growing).nearest(target);
    while (!context_.interruption()) {
      const std::optional<int> next = extend_from(growing, at, target);
      if (!next) {
        return std::nullopt;
      }
      at = *next;
      if ((tree(growing).coordinates(at) - target).norm() < 1e-9) {
        return at;
      }
    }
    return std::nullopt;
  }

  Path joined(int start_node, int goal_node) {
    Path path{tree(0).branch(start_node)};
    std::vector<Configuration> rest = tree(1).branch(goal_node);
    path.waypoints.insert(path.waypoints.end(), rest.rbegin() + 1, rest.rend());
    return path;
  }

  PlanningContext& context_;
  const RrtConnectSettings& settings_;
  bool in_corridor_;
  HandArmSpace space_;
  RandomStream draws_;
  std::array<SearchTree, 2> trees_;
};

}  // namespace

RrtConnect::RrtConnect(HandSpace space) : space_(space) {}

std::string RrtConnect::name() const {
  return space_ == HandSpace::kPrincipalDirections ? "pmd-rrt-connect" : "rrt-connect";
}

std::string RrtConnect::description() const {
  return space_ == HandSpace::kPrincipalDirections
             ? "Two trees in a widening corridor of the arm and the hand's principal directions"
             : "Two trees over all joints";
}

PlannerCapabilities RrtConnect::capabilities() const {
  return {.uses_pmds = space_ == HandSpace::kPrincipalDirections,
          .uses_threads = false,
          .deterministic = true};
}

std::vector<Parameter> RrtConnect::parameters() {
  std::vector<Parameter> list = {
      {"range", "Step length", "", "Longest step of a tree, in joints normalised to [0, 1].",
       &settings_.range, 1e-3, 10.0},
      {"max_samples", "Samples", "", "Samples drawn before the planner gives up.",
       &settings_.max_samples, 1, 100000000},
  };
  if (space_ == HandSpace::kPrincipalDirections) {
    list.push_back({"rho_a", "Corridor half-width ρₐ", "",
                    "Half-width of the arm's corridor at the start, normalised.", &settings_.rho_a,
                    1e-5, 1.0});
    list.push_back({"rho_max", "Largest ρₐ", "", "The corridor does not grow beyond this.",
                    &settings_.rho_max, 1e-5, 1.0});
    list.push_back({"rho_growth", "Widening factor", "", "The corridor grows by this factor.",
                    &settings_.rho_growth, 1.0, 100.0});
    list.push_back({"samples_per_width", "Samples per width", "",
                    "Samples drawn before the corridor grows.", &settings_.samples_per_width, 1,
                    1000000});
  }
  return list;
}

void RrtConnect::do_plan(PlanningContext& context, PlanResult& result) {
  BidirectionalSearch search(context, settings_, space_);
  search.run(result);
  if (result.solved()) {
    const PhaseClock smoothing_time(result.smoothing_s);
    result.path = smooth_by_roadmap(context, result.path);
  }
}

}  // namespace handway::planning
