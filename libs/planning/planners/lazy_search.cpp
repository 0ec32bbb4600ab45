#include "planners/lazy_search.h"

#include "handway/planning/queries/arm_progress.h"

#include <algorithm>

namespace handway::planning {
namespace {

constexpr int kStartNode = 0;
constexpr int kGoalNode = 1;

}  // namespace

LazySearch::LazySearch(PlanningContext& context, const PmdLazySettings& settings,
                       std::uint64_t seed)
    : Search(context),
      settings_(settings),
      targets_(context, settings.region, HandSpace::kPrincipalDirections, seed),
      space_(targets_.space()),
      roadmap_(settings.k) {
  const PlanningProblem& problem = context.problem();
  add_node(problem.start, {space_.coordinates(problem.start), 0, 0.0});
  add_node(problem.goal, {space_.coordinates(problem.goal), 0, 0.0});
}

Path LazySearch::path() const {
  Path path;
  for (const int node : way_) {
    path.waypoints.push_back(roadmap_.configuration(node));
  }
  return path;
}

void LazySearch::add_node(const Configuration& q, const TargetSampler::Target& target) {
  const int node = roadmap_.add_node(q, target.coordinates);
  statistics().nodes = static_cast<std::uint64_t>(roadmap_.node_count());
  context().observer().on_node(
      {node, q, target.pmds, arm_progress(context().problem(), q), target.rho});
}

// One draw, or one look at the shortest way.
std::optional<PlanStatus> LazySearch::step() {
  if (nodes_wanted_ > 0) {
    if (sample_ >= settings_.max_samples) {
      return PlanStatus::kSamplesSpent;
    }
    context().observer().on_progress(static_cast<double>(sample_) / settings_.max_samples,
                                     "adding nodes");
    draw_node();
    return std::nullopt;
  }
  way_ = roadmap_.shortest_path(kStartNode, kGoalNode);
  if (way_.empty() || statistics().samples == 0) {
    nodes_wanted_ = settings_.batch;
    return std::nullopt;
  }
  return is_free(way_) ? std::optional(PlanStatus::kSolved) : std::nullopt;
}

void LazySearch::draw_node() {
  ++statistics().samples;
  const int end = sample_ % 2;
  TargetSampler::Target target = targets_.draw(static_cast<std::uint64_t>(sample_), end, failures_);
  ++sample_;
  statistics().final_rho_a = std::max(statistics().final_rho_a, target.rho);
  const PlanningProblem& problem = context().problem();
  const std::optional<Configuration> q =
      targets_.configuration(target.coordinates, end == 0 ? problem.start : problem.goal);
  if (!q || !sample_free(*q)) {
    ++failures_;
    return;
  }
  failures_ = 0;
  --nodes_wanted_;
  add_node(*q, target);
}

// What is refused is taken out of the roadmap. All edges are sampled before any is made certain.
bool LazySearch::is_free(const std::vector<int>& way) {
  for (const bool exactly : {false, true}) {
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      const int a = way[i];
      const int b = way[i + 1];
      if (roadmap_.is_certain(a, b)) {
        continue;
      }
      if (context().interruption()) {
        return false;
      }
      const Configuration& from = roadmap_.configuration(a);
      const Configuration& to = roadmap_.configuration(b);
      const int probes = static_cast<int>(roadmap_.distance(a, b) / kProbeSpacing);
      if (!(exactly ? context().edge_free(from, to) : edge_plausible(from, to, probes))) {
        roadmap_.remove_edge(a, b);
        return false;
      }
      if (exactly) {
        roadmap_.confirm_edge(a, b);
        ++statistics().edges;
        context().observer().on_edge(a, b);
      }
    }
  }
  return true;
}

}  // namespace handway::planning
