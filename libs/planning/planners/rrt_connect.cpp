#include "handway/planning/planners/rrt_connect.h"

#include "handway/planning/core/planning_context.h"
#include "handway/planning/paths/roadmap_smoothing.h"
#include "handway/sampling/sequences/random_stream.h"
#include "planners/hand_arm_space.h"
#include "planners/phase_clock.h"
#include "planners/search_space.h"
#include "planners/search_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace handway::planning {
namespace {

using sampling::RandomStream;

// Radii of the balls around start and goal: what is a move of a finger's width
// and what takes the hand out of any grasp.
constexpr double kSmallestBall = 0.005;
constexpr double kLargestBall = 0.3;
constexpr double kRefinement = 0.25;  // share of a step that is tried after it

class BidirectionalSearch {
 public:
  BidirectionalSearch(PlanningContext& context, const RrtConnectSettings& settings, HandSpace hand)
      : context_(context),
        settings_(settings),
        in_corridor_(hand == HandSpace::kPrincipalDirections),
        basis_(hand_basis(context.problem(), hand)),
        space_(make_search_space(context.problem(), static_cast<CorridorForm>(settings.corridor))),
        draws_(context.request().seed),
        trees_{root(context.problem().start), root(context.problem().goal)} {}

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
      const std::optional<int> reached = extend(growing, draw(sample), sample);
      if (!reached) {
        continue;
      }
      if (const std::optional<int> other = connect(1 - growing, growing, *reached)) {
        result.path = joined(growing == 0 ? *reached : *other, growing == 0 ? *other : *reached);
        result.status = PlanStatus::kSolved;
        return;
      }
    }
    result.status = PlanStatus::kSamplesSpent;
  }

 private:
  [[nodiscard]] SearchTree root(const Configuration& q) const {
    return SearchTree(q, space_->coordinates(q));
  }

  SearchTree& tree(int index) { return trees_[static_cast<std::size_t>(index)]; }

  Eigen::VectorXd draw(int sample) {
    RandomStream draw = draws_.fork(static_cast<std::uint64_t>(sample));
    if (!in_corridor_) {
      return draw.uniform(context_.problem().model().variable_count());
    }
    return draw.uniform() < settings_.near_ends ? draw_near_root(sample % 2, draw)
                                                : draw_in_corridor(sample, draw);
  }

  Eigen::VectorXd draw_in_corridor(int sample, RandomStream& draw) {
    const double widths = std::floor(static_cast<double>(sample) / settings_.samples_per_width);
    const double rho =
        std::min(settings_.rho_max, settings_.rho_a * std::pow(settings_.rho_growth, widths));
    context_.statistics().final_rho_a = rho;
    const double step = draw.uniform();
    const Eigen::VectorXd arm = draw.uniform(space_->arm_draws());
    return space_->draw(step, rho, arm, draw_posture(draw));
  }

  // Every size of ball is as likely as any other. In half of the draws the hand
  // keeps its posture: it holds on to what is between its fingers.
  Eigen::VectorXd draw_near_root(int index, RandomStream& draw) {
    const double rho = kSmallestBall * std::pow(kLargestBall / kSmallestBall, draw.uniform());
    const bool hand_moves = draw.uniform() < 0.5;
    const Eigen::VectorXd arm = draw.uniform(space_->arm_draws());
    const auto hand_size = static_cast<Eigen::Index>(basis_.joints.size());
    Eigen::VectorXd posture = tree(index).coordinates(0).tail(hand_size);
    if (hand_moves) {
      posture += std::min(1.0, rho / kLargestBall) * (draw_posture(draw) - posture);
    }
    return space_->draw(index, rho, arm, posture);
  }

  [[nodiscard]] Eigen::VectorXd draw_posture(RandomStream& draw) const {
    return sampling::map_to_posture(basis_, draw.uniform(basis_.dimension()));
  }

  // Trees are numbered apart: even ids grow from the start, odd ones from the goal.
  static int event_id(int growing, int node) { return 2 * node + growing; }

  void announce_roots() {
    context_.statistics().nodes = 2;
    context_.observer().on_node({event_id(0, 0), tree(0).configuration(0), 0, 0.0, 0.0});
    context_.observer().on_node({event_id(1, 0), tree(1).configuration(0), 0, 1.0, 0.0});
  }

  // Some samples move the arm alone and as many the hand alone: to open around
  // an object and to draw back from it are hard to find as one motion.
  void hold_a_part(Eigen::VectorXd& target, const Eigen::VectorXd& from, int sample) const {
    if (!in_corridor_) {
      return;
    }
    const double u = draws_.fork(static_cast<std::uint64_t>(sample)).fork(1).uniform();
    const auto hand_size = static_cast<Eigen::Index>(basis_.joints.size());
    const Eigen::Index arm_size = target.size() - hand_size;
    if (u < 0.5 * settings_.single_moves) {
      target.tail(hand_size) = from.tail(hand_size);
    } else if (u < settings_.single_moves) {
      target.head(arm_size) = from.head(arm_size);
    }
  }

  // One step of at most `range` from the nearest node; the new node, if the way is free.
  std::optional<int> extend(int growing, Eigen::VectorXd target, int sample) {
    const int from = tree(growing).nearest(target);
    hold_a_part(target, tree(growing).coordinates(from), sample);
    double range = settings_.range;
    for (int i = 0; i <= settings_.refinements; ++i, range *= kRefinement) {
      if (const std::optional<int> node = step(growing, from, target, range)) {
        return node;
      }
    }
    return std::nullopt;
  }

  std::optional<int> step(int growing, int from, const Eigen::VectorXd& target, double range) {
    const Eigen::VectorXd begin = tree(growing).coordinates(from);
    const double share = std::min(1.0, range / std::max((target - begin).norm(), 1e-12));
    const Eigen::VectorXd end = begin + share * (target - begin);
    const std::optional<Configuration> q =
        space_->configuration(end, tree(growing).configuration(from));
    return q ? add_if_free(growing, from, *q, end) : std::nullopt;
  }

  std::optional<int> add_if_free(int growing, int from, const Configuration& q,
                                 const Eigen::VectorXd& coordinates) {
    if (context_.collision(q) || !context_.edge_free(tree(growing).configuration(from), q)) {
      return std::nullopt;
    }
    const int node = tree(growing).add(q, coordinates, from);
    auto& statistics = context_.statistics();
    statistics.nodes =
        static_cast<std::uint64_t>(trees_[0].size()) + static_cast<std::uint64_t>(trees_[1].size());
    ++statistics.edges;
    context_.observer().on_node({event_id(growing, node), q, 0, 0.0, statistics.final_rho_a});
    context_.observer().on_edge(event_id(growing, from), event_id(growing, node));
    return node;
  }

  // Steps towards `target`, a node of the other tree, until there or until one
  // is not free. The last step goes to the very configuration of that node.
  std::optional<int> connect(int growing, int other, int target) {
    const Configuration q = tree(other).configuration(target);
    const Eigen::VectorXd end = tree(other).coordinates(target);
    std::optional<int> at = tree(growing).nearest(end);
    while (at && !context_.interruption()) {
      if ((tree(growing).coordinates(*at) - end).norm() <= settings_.range) {
        return add_if_free(growing, *at, q, end);
      }
      at = step(growing, *at, end, settings_.range);
    }
    return std::nullopt;
  }

  // Both nodes are the same configuration.
  Path joined(int start_node, int goal_node) {
    Path path{tree(0).branch(start_node)};
    std::vector<Configuration> rest = tree(1).branch(goal_node);
    path.waypoints.insert(path.waypoints.end(), rest.rbegin() + 1, rest.rend());
    return path;
  }

  PlanningContext& context_;
  const RrtConnectSettings& settings_;
  bool in_corridor_;
  sampling::PmdBasis basis_;
  std::unique_ptr<SearchSpace> space_;
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
      {"refinements", "Shorter steps", "",
       "How often a step that is not free is tried again at a quarter of its length.",
       &settings_.refinements, 0, 5},
      {"max_samples", "Samples", "", "Samples drawn before the planner gives up.",
       &settings_.max_samples, 1, 100000000},
  };
  if (space_ == HandSpace::kPrincipalDirections) {
    list.push_back({"corridor", "Corridor", "",
                    "Around the straight motion of the arm's joints, or of its tool.",
                    ChoiceValue{&settings_.corridor, {"joint", "cartesian"}}});
    list.push_back({"near_ends", "Samples near the ends", "",
                    "Share of samples drawn around start and goal.", &settings_.near_ends, 0.0,
                    1.0});
    list.push_back({"single_moves", "Moves of one part", "",
                    "Share of samples that move the arm alone or the hand alone.",
                    &settings_.single_moves, 0.0, 1.0});
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
