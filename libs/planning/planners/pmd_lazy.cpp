#include "handway/planning/core/planning_context.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/paths/path_optimizer.h"
#include "handway/planning/spaces/target_sampler.h"
#include "planners/built_in.h"
#include "planners/search.h"
#include "roadmap/roadmap.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

namespace handway::planning {
namespace {

struct PmdLazySettings {
  int k = 15;
  int batch = 20;
  int max_samples = 1000000;
  int smoothing_checks = 300;
  TargetRegion region = {.near_ends = 0.5, .rho_a = 0.03};
};

class LazySearch final : public Search {
 public:
  /// @param settings must outlive this object.
  /// @throws InputError as make_corridor_space().
  LazySearch(PlanningContext& context, const PmdLazySettings& settings, std::uint64_t seed)
      : Search(context),
        settings_(settings),
        targets_(context, settings.region, HandSpace::kPrincipalDirections, seed),
        space_(targets_.space()) {
    const PlanningProblem& problem = context.problem();
    add_node(problem.start, {space_.coordinates(problem.start), 0, 0.0});
    add_node(problem.goal, {space_.coordinates(problem.goal), 0, 0.0});
  }

  [[nodiscard]] Path path() const override {
    Path path;
    for (const int node : path_) {
      path.waypoints.push_back(roadmap_.configuration(node));
    }
    return path;
  }

 protected:
  // One sample, or one check of the shortest nodes.
  [[nodiscard]] std::optional<PlanStatus> step() override {
    if (nodes_wanted_ > 0) {
      if (sample_ >= settings_.max_samples) {
        return PlanStatus::kSamplesSpent;
      }
      context().observer().on_progress(static_cast<double>(sample_) / settings_.max_samples,
                                       "adding nodes");
      draw_node();
      return std::nullopt;
    }
    path_ = roadmap_.shortest_path(kStartNode, kGoalNode);
    if (path_.empty() || statistics().samples == 0) {
      nodes_wanted_ = settings_.batch;
      return std::nullopt;
    }
    return is_free(path_) ? std::optional(PlanStatus::kSolved) : std::nullopt;
  }

 private:
  // Joined to the nearest of those before.
  void add_node(const Configuration& q, const TargetSampler::Target& target) {
    const int node = roadmap_.add_node(q, target.coordinates);
    for (const int other : roadmap_.nearest(node, settings_.k, kAnywhere)) {
      roadmap_.edge(node, other);
    }
    statistics().nodes = static_cast<std::uint64_t>(roadmap_.node_count());
    context().observer().on_node(
        {node, q, target.pmds, arm_progress(context().problem(), q), target.rho});
  }

  void draw_node() {
    ++statistics().samples;
    const int end = sample_ % 2;
    TargetSampler::Target target =
        targets_.draw(static_cast<std::uint64_t>(sample_), end, failures_);
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

  // Removes refused edges from the roadmap. All edges are sampled before any is made certain.
  [[nodiscard]] bool is_free(const std::vector<int>& nodes) {
    for (const bool exactly : {false, true}) {
      for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        const int a = nodes[i];
        const int b = nodes[i + 1];
        Certainty& certainty = roadmap_.edge(a, b);
        if (certainty.is_free) {
          continue;
        }
        if (context().interruption()) {
          return false;
        }
        const Configuration& from = roadmap_.configuration(a);
        const Configuration to =
            context().problem().model().nearest_equivalent(from, roadmap_.configuration(b));
        const int probes = static_cast<int>(roadmap_.distance(a, b) / kProbeSpacing);
        if (!(exactly ? context().validator().edge_free(from, to)
                      : edge_plausible(from, to, probes))) {
          roadmap_.remove_edge(a, b);
          return false;
        }
        if (exactly) {
          certainty.is_free = true;
          ++statistics().edges;
          context().observer().on_edge(a, b);
        }
      }
    }
    return true;
  }

  struct Certainty {
    bool is_free = false;
  };

  static constexpr int kStartNode = 0;
  static constexpr int kGoalNode = 1;
  static constexpr double kAnywhere = std::numeric_limits<double>::infinity();

  const PmdLazySettings& settings_;
  TargetSampler targets_;
  const CorridorSpace& space_;
  Roadmap<Certainty> roadmap_{space_.periods()};  ///< Its edges are assumed to be free until
                                                  ///< checked.
  int sample_ = 0;
  int failures_ = 0;      ///< Samples since the last free one.
  int nodes_wanted_ = 0;  ///< Number of nodes before the next search for a path.
  std::vector<int> path_;
};

class PmdLazy final : public BuiltInPlanner {
 public:
  PmdLazy()
      : BuiltInPlanner("pmd-lazy",
                       "Lazy roadmap in the regions of pmd-rrt-connect; it checks only edges of "
                       "candidate shortest paths",
                       {.uses_pmds = true, .needs_basis = true}) {}

 protected:
  void do_plan(PlanningContext& context, PlanResult& result) override {
    LazySearch search(context, settings_, context.request().seed);
    result.status = *search.advance({});
    if (result.solved()) {
      smooth_result(context, objective(), settings_.smoothing_checks, search.path(), result);
    }
  }

  [[nodiscard]] std::vector<geometric::BoundParameter> own_parameters() override {
    std::vector<geometric::BoundParameter> list = {
        {"k", "Neighbours K", "", "Number of nearest nodes that a new node is connected to.",
         &settings_.k, 1, 1000},
        {"batch", "Batch size", "",
         "Number of nodes that are added when no candidate path from start to goal remains.",
         &settings_.batch, 1, 100000},
        max_samples_parameter(settings_.max_samples),
        smoothing_checks_parameter(settings_.smoothing_checks),
    };
    list.push_back(corridor_parameter(settings_.region.corridor));
    append_region_parameters(list, settings_.region);
    return list;
  }

 private:
  PmdLazySettings settings_;
};

}  // namespace

std::unique_ptr<Planner> make_pmd_lazy() { return std::make_unique<PmdLazy>(); }

}  // namespace handway::planning
