#include "planners/rrt_connect.h"

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/paths/path_optimizer.h"
#include "planners/built_in.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace handway::planning {
namespace {

constexpr int kCandidates = 12;       // nodes, of which the least expanded is expanded
constexpr double kRefinement = 0.25;  // share of a step that is tried after it
constexpr double kLeastGain = 0.1;    // share of a step that has to be gained
constexpr int kLeastRefinements = 1;  // with constraints: long steps cut across what bends

// Limits of the configurations per edge: at first, growth with every sample, and largest.
constexpr std::uint64_t kEdgeChecks = 300;
constexpr std::uint64_t kMoreEdgeChecks = 10;
constexpr std::uint64_t kMostEdgeChecks = 20000;

}  // namespace

BidirectionalSearch::BidirectionalSearch(PlanningContext& context,
                                         const RrtConnectSettings& settings, HandSpace hand,
                                         std::uint64_t seed)
    : Search(context),
      settings_(settings),
      lazy_(hand == HandSpace::kPrincipalDirections || settings.expansions > 0.0),
      targets_(context, settings.region, hand, seed),
      space_(targets_.space()),
      trees_(context.problem().start, space_.coordinates(context.problem().start),
             context.problem().goal, space_.coordinates(context.problem().goal), space_.periods()),
      choices_(sampling::RandomStream(seed).fork(1)) {
  announce_node(0, {});
  announce_node(1, {});
}

std::optional<PlanStatus> BidirectionalSearch::step() {
  if (sample_ >= settings_.max_samples) {
    return PlanStatus::kSamplesSpent;
  }
  context().observer().on_progress(static_cast<double>(sample_) / settings_.max_samples,
                                   "growing trees");
  ++statistics().samples;
  const int tree = sample_ % 2;
  sampling::RandomStream draw = choices_.fork(static_cast<std::uint64_t>(sample_));
  const Growth growth =
      draw.uniform() < settings_.expansions ? expansion(tree, draw) : extension(tree);
  statistics().final_rho_a = std::max(statistics().final_rho_a, growth.target.rho);
  const std::optional<int> reached = grow(growth);
  ++sample_;
  failures_ = reached ? 0 : failures_ + 1;
  return reached && connect(*reached, growth.target) ? std::optional(PlanStatus::kSolved)
                                                     : std::nullopt;
}

void BidirectionalSearch::announce_node(int node, const TargetSampler::Target& target) {
  statistics().nodes = static_cast<std::uint64_t>(trees_.size());
  const Configuration& q = trees_.configuration(node);
  context().observer().on_node(
      {node, q, target.pmds, arm_progress(context().problem(), q), target.rho});
}

// From the nearest node (RRT).
BidirectionalSearch::Growth BidirectionalSearch::extension(int tree) {
  const auto sample = static_cast<std::uint64_t>(sample_);
  TargetSampler::Target target = targets_.draw(sample, tree, failures_);
  const int from = trees_.nearest(tree, target.coordinates);
  target.coordinates = targets_.held(std::move(target.coordinates), trees_.coordinates(from),
                                     sample, settings_.single_moves);
  return {from, std::move(target)};
}

// Expands a node with few attempts, the newest of them (EST): so trees continue where they have
// just come through, and leave a narrow passage however few targets are beyond it.
BidirectionalSearch::Growth BidirectionalSearch::expansion(int tree, sampling::RandomStream draw) {
  expansions_.resize(static_cast<std::size_t>(trees_.size()));
  const auto tried = [&](int node) -> int& { return expansions_[static_cast<std::size_t>(node)]; };
  const std::vector<int>& nodes = trees_.nodes(tree);
  const auto candidate = [&] {
    const auto index = static_cast<std::size_t>(draw.uniform() * static_cast<double>(nodes.size()));
    return nodes[std::min(nodes.size() - 1, index)];
  };
  int from = candidate();
  for (int i = 1; i < kCandidates; ++i) {
    const int other = candidate();
    if (std::pair(tried(other), -other) < std::pair(tried(from), -from)) {
      from = other;
    }
  }
  ++tried(from);
  return {from,
          targets_.draw_near_node(static_cast<std::uint64_t>(sample_), trees_.coordinates(from),
                                  trees_.coordinates(trees_.parent(from)))};
}

// One step of at most `range`; the new node, if the motion is free.
std::optional<int> BidirectionalSearch::grow(const Growth& growth) {
  const bool has_constraints = !context().problem().checker->world().constraints().empty();
  const int refinements = std::max(settings_.refinements, has_constraints ? kLeastRefinements : 0);
  double range = settings_.range;
  for (int i = 0; i <= refinements; ++i, range *= kRefinement) {
    if (const std::optional<int> node =
            step_towards(growth.from, growth.target.coordinates, range, growth.target)) {
      return node;
    }
  }
  return std::nullopt;
}

std::optional<int> BidirectionalSearch::step_towards(int from, const Eigen::VectorXd& towards,
                                                     double range,
                                                     const TargetSampler::Target& target) {
  const Eigen::VectorXd begin = trees_.coordinates(from);
  const Eigen::VectorXd end = space_.periods().nearest(begin, towards);
  const double length = (end - begin).norm();
  Eigen::VectorXd x = begin + std::min(1.0, range / std::max(length, 1e-12)) * (end - begin);
  const std::optional<Configuration> q = targets_.configuration(x, trees_.configuration(from));
  // A configuration that was projected onto the constraints still has to be nearer to the target.
  if (!q || (end - x).norm() > length - kLeastGain * std::min(range, length) || !sample_free(*q) ||
      !passable(trees_.configuration(from), *q, std::min(range, length))) {
    return std::nullopt;
  }
  const int node = trees_.add(*q, x, from, !lazy_);
  ++statistics().edges;
  announce_node(node, target);
  context().observer().on_edge(from, node);
  return node;
}

bool BidirectionalSearch::passable(const Configuration& from, const Configuration& target,
                                   double length) {
  const Configuration to = context().problem().model().nearest_equivalent(from, target);
  return lazy_ ? edge_plausible(from, to, static_cast<int>(length / kProbeSpacing))
               : context().validator().edge_free(from, to);
}

// An edge that needs more checks counts as blocked as long as a wider passage may exist.
std::uint64_t BidirectionalSearch::edge_checks() const {
  return lazy_ ? std::min(kMostEdgeChecks,
                          kEdgeChecks + kMoreEdgeChecks * static_cast<std::uint64_t>(sample_))
               : std::numeric_limits<std::uint64_t>::max();
}

// Extends the other tree towards `reached` until it is there or a step is not free.
bool BidirectionalSearch::connect(int reached, const TargetSampler::Target& target) {
  const int growing = trees_.tree_of(reached);
  const Eigen::VectorXd end = trees_.coordinates(reached);
  std::optional<int> at = trees_.nearest(1 - growing, end);
  while (at && !context().interruption()) {
    const double length = space_.periods().difference(end, trees_.coordinates(*at)).norm();
    if (length <= settings_.range) {
      return passable(trees_.configuration(*at), trees_.configuration(reached), length) &&
             verify(growing == 0 ? trees_.connection(reached, *at)
                                 : trees_.connection(*at, reached));
    }
    at = step_towards(*at, end, settings_.range, target);
  }
  return false;
}

// Checks the uncertain edges of a connection, longest first: those fail most
// often.
bool BidirectionalSearch::verify(TreePair::Connection connection) {
  std::vector<Configuration> q;
  for (const int node : connection.nodes) {
    q.push_back(trees_.configuration(node));
  }
  q = context().problem().model().unwrapped(std::move(q),
                                            trees_.configuration(connection.nodes.front()));
  connection.certain[connection.bridge] = !lazy_;
  std::vector<std::pair<double, std::size_t>> uncertain;
  for (std::size_t edge = 0; edge < connection.certain.size(); ++edge) {
    if (!connection.certain[edge]) {
      uncertain.emplace_back(
          -normalised_distance(context().problem().model(), q[edge], q[edge + 1]), edge);
    }
  }
  std::ranges::sort(uncertain);
  for (const auto& [length, edge] : uncertain) {
    if (context().interruption()) {
      return false;
    }
    if (!context().validator().edge_free(q[edge], q[edge + 1], edge_checks())) {
      trees_.cut(connection, edge, connection.certain[connection.bridge]);
      return false;
    }
    connection.certain[edge] = true;
    trees_.confirm(connection, edge);
  }
  ++statistics().edges;
  context().observer().on_edge(connection.nodes[connection.bridge],
                               connection.nodes[connection.bridge + 1]);
  path_.waypoints = std::move(q);
  return true;
}

namespace {

class RrtConnect final : public BuiltInPlanner {
 public:
  explicit RrtConnect(HandSpace space)
      : BuiltInPlanner(with_pmds(space) ? "pmd-rrt-connect" : "rrt-connect",
                       with_pmds(space) ? "Two trees in a widening corridor around the arm's "
                                          "motion and in the hand's principal motion directions"
                                        : "Two trees over all joints",
                       {.uses_pmds = with_pmds(space), .needs_basis = with_pmds(space)}),
        space_(space),
        settings_(with_pmds(space) ? RrtConnectSettings{} : kSettingsOverAllJoints) {}

 protected:
  void do_plan(PlanningContext& context, PlanResult& result) override {
    BidirectionalSearch search(context, settings_, space_, context.request().seed);
    result.status = *search.advance({});
    if (result.solved()) {
      smooth_result(context, objective(), settings_.smoothing_checks, search.path(), result);
    }
  }

  [[nodiscard]] std::vector<geometric::BoundParameter> own_parameters() override {
    std::vector<geometric::BoundParameter> list = {
        {"range", "Step length", "", "Longest step of a tree, in joints normalised to [0, 1].",
         &settings_.range, 1e-3, 10.0},
        {"refinements", "Shorter steps", "",
         "Number of times that a step in collision is repeated with a quarter of its length.",
         &settings_.refinements, 0, 5},
        max_samples_parameter(settings_.max_samples),
        smoothing_checks_parameter(settings_.smoothing_checks),
    };
    if (with_pmds(space_)) {
      list.push_back({"single_moves", "Single-part moves", "",
                      "Share of samples that move only the arm or only the hand.",
                      &settings_.single_moves, 0.0, 1.0});
      list.push_back({"expansions", "Expansions", "",
                      "Share of steps that go from a node with few attempts to a configuration "
                      "near it. Helps in narrow passages.",
                      &settings_.expansions, 0.0, 1.0});
      list.push_back(corridor_parameter(settings_.region.corridor));
      append_region_parameters(list, settings_.region);
    }
    return list;
  }

 private:
  HandSpace space_;
  RrtConnectSettings settings_;
};

}  // namespace

std::unique_ptr<Planner> make_rrt_connect(HandSpace hand) {
  return std::make_unique<RrtConnect>(hand);
}

}  // namespace handway::planning
