#include "handway/planning/replanning/dynamic_roadmap.h"

#include "handway/geometric/robot/normalised_joints.h"
#include "handway/geometric/scene/scene_difference.h"
#include "handway/planning/core/planning_context.h"
#include "handway/planning/paths/path_optimizer.h"
#include "handway/planning/roadmap/roadmap_recorder.h"
#include "planners/built_in.h"
#include "planners/rrt_connect.h"
#include "roadmap/roadmap.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace handway::planning {
namespace {

constexpr double kProbeSpacing = 0.05;  // configurations tested before an edge is checked
constexpr double kBackOff = 0.1;        // from what cuts an edge to where the detour begins
// Limits of checked configurations: in search of a path over edges never checked before, each time;
// for a detour around an obstacle, before planning from scratch; and in smoothing.
constexpr std::uint64_t kRoadmapChecks = 500;
constexpr std::uint64_t kRepairChecks = 4000;
constexpr int kSmoothingChecks = 300;

/// Revisions of the last changes of a scene's objects: the scene has a new one with every
/// change.
class SceneChanges {
 public:
  /// Records that an object was moved, added or removed.
  void note(const std::string& object) { last_change_[object] = ++revision_; }

  /// Revision of the present scene; 0 before the first change.
  [[nodiscard]] int revision() const { return revision_; }

  /// The revision that the last change of `object` made; 0: it never changed.
  [[nodiscard]] int last_change(const std::string& object) const {
    const auto found = last_change_.find(object);
    return found == last_change_.end() ? 0 : found->second;
  }

  /// Pairs with objects that changed after `revision`, in the present world.
  [[nodiscard]] std::vector<int> pairs_changed_since(int revision,
                                                     const geometric::CollisionWorld& world) const {
    std::vector<int> pairs;
    for (const auto& [object, change] : last_change_) {
      if (change > revision) {
        const std::vector<int> own = world.pairs_with(object);
        pairs.insert(pairs.end(), own.begin(), own.end());
      }
    }
    return pairs;
  }

 private:
  int revision_ = 0;
  std::map<std::string, int> last_change_;
};

/// Cached validity of a node or an edge of a roadmap, with the scene's revision.
struct ValidityState {
  static constexpr int kNever = -1;

  int free_at = kNever;     ///< Found free in this revision of the scene.
  int refused_at = kNever;  ///< Found not to be free in this one, …
  std::string refused_by;   ///< … because of this object; empty: a fixed conflict.

  [[nodiscard]] bool was_free() const { return free_at != kNever; }

  /// Returns whether it was refused by an object that has not changed since.
  [[nodiscard]] bool is_refused(const SceneChanges& changes) const {
    return refused_at != kNever && changes.last_change(refused_by) <= refused_at;
  }

  void set_free(int revision) { *this = {revision, kNever, {}}; }
};

/// A graph of a robot's configurations whose nodes and edges store when they were last found free;
/// the state of new ones is unknown. Distances are Euclidean in normalised joints.
class RoadmapGraph : public Roadmap<ValidityState> {
 public:
  explicit RoadmapGraph(std::shared_ptr<const geometric::RobotModel> model)
      : Roadmap(geometric::normalised_turns(*model)), model_(std::move(model)) {}

  /// Returns the node at `q`, or whole turns from it, added if needed, with edges to its nearest.
  int node_at(const Configuration& q) {
    constexpr int kJoined = 8;  // nearest nodes that a new one gets an edge to
    constexpr double kAnywhere = std::numeric_limits<double>::infinity();
    const Eigen::VectorXd coordinates = geometric::normalised(*model_, q);
    const bool periodic = !periods().none();
    const double rounding = periodic ? 1e-12 : 0.0;  // of values whole periods apart
    const auto is_here = [&](int node) { return periodic || configuration(node) == q; };
    if (const auto same = neighbours().nearest(coordinates, 1, rounding, is_here); !same.empty()) {
      return same.front().second;
    }
    const int node = add_node(q, coordinates);
    for (const int other : nearest(node, kJoined, kAnywhere)) {
      edge(node, other);
    }
    return node;
  }

  /// Edges that a path may take.
  enum class Edges {
    kOnceFree,  ///< Edges found free before.
    kAny,       ///< Other edges too, as if they were much longer.
  };
  /// The shortest path without refused parts, by A*; empty if it does not exist.
  [[nodiscard]] std::vector<int> shortest_path(int from, int to, Edges edges,
                                               const SceneChanges& changes) const {
    constexpr double kUnknownCost = 10.0;  // of an edge never checked: most are refused
    constexpr double kNotTaken = std::numeric_limits<double>::infinity();
    return Roadmap::shortest_path(
        from, to,
        [&](double length, const ValidityState& edge, const ValidityState& a,
            const ValidityState& b) {
          if (edge.is_refused(changes) || a.is_refused(changes) || b.is_refused(changes)) {
            return kNotTaken;
          }
          return edge.was_free()        ? length
                 : edges == Edges::kAny ? kUnknownCost * length
                                        : kNotTaken;
        });
  }

 private:
  std::shared_ptr<const geometric::RobotModel> model_;
};

/// Checks whether paths over a roadmap are free, testing only unknown parts, and caches the
/// results.
class LazyPathValidator {
 public:
  /// All must outlive this object.
  LazyPathValidator(PlanningContext& context, RoadmapGraph& graph, const SceneChanges& changes)
      : context_(context), graph_(graph), changes_(changes) {}

  /// The shortest free path. @param checks limit of configurations after which it gives up.
  /// @returns nodes from `from` to `to`; nothing without a path, or when interrupted.
  [[nodiscard]] std::optional<std::vector<int>> shortest_path(int from, int to,
                                                              RoadmapGraph::Edges edges,
                                                              std::uint64_t checks) {
    const std::uint64_t before = context_.statistics().checks();
    while (!context_.interruption() && context_.statistics().checks() - before < checks) {
      std::vector<int> path = graph_.shortest_path(from, to, edges, changes_);
      if (path.empty()) {
        return std::nullopt;
      }
      if (path_free(path)) {
        return path;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] bool node_free(int node) {
    ValidityState& validity = graph_.node(node);
    return settle(validity, [&](const std::vector<int>& pairs) {
      const std::optional<int> touching =
          context_.validator().collision_among(pairs, graph_.configuration(node));
      if (touching) {
        refuse(validity, *touching);
      }
      return !touching;
    });
  }

  /// Returns whether the edge between two nodes is free; adds it if needed. @pre both are free.
  [[nodiscard]] bool edge_free(int a, int b) {
    ValidityState& validity = graph_.edge(a, b);
    return settle(validity, [&](const std::vector<int>& pairs) {
      const geometric::EdgeResult result =
          context_.validator().edge_among(pairs, graph_.configuration(a), end_of(a, b));
      if (!result.free && result.pair) {  // without a pair it was interrupted: nothing is settled
        refuse(validity, *result.pair);
        obstructions_[{a, b}] = result.at;
        obstructions_[{b, a}] = 1.0 - result.at;
      }
      return result.free;
    });
  }

  /// Place at which this object blocks the edge, in [0, 1] from `a` to `b`; 0 if it does
  /// not.
  [[nodiscard]] double obstruction(int a, int b) const {
    const auto found = obstructions_.find({a, b});
    return found == obstructions_.end() ? 0.0 : found->second;
  }

 private:
  // Cheap checks first; the first failure ends it.
  bool path_free(const std::vector<int>& path) {
    const auto all_edges = [&](auto is_free) {
      for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        if (context_.interruption() || !is_free(path[i], path[i + 1])) {
          return false;
        }
      }
      return true;
    };
    return std::ranges::all_of(path, [&](int node) { return node_free(node); }) &&
           all_edges([&](int a, int b) { return plausible(a, b); }) &&
           all_edges([&](int a, int b) { return edge_free(a, b); });
  }

  // Edges never checked are sampled before any is checked exactly.
  bool plausible(int a, int b) {
    ValidityState& validity = graph_.edge(a, b);
    if (validity.was_free()) {
      return true;
    }
    const int probes = static_cast<int>(graph_.distance(a, b) / kProbeSpacing);
    const std::optional<int> touching =
        context_.validator().edge_probe(graph_.configuration(a), end_of(a, b), probes);
    if (touching) {
      refuse(validity, *touching);
    }
    return !touching;
  }

  // Decides whether a node or an edge is free, from the cache and from `check` for unknown pairs.
  template <typename Check>
  bool settle(ValidityState& validity, const Check& check) {
    if (validity.is_refused(changes_)) {
      return false;
    }
    if (const std::vector<int> pairs = unknown_pairs(validity); !pairs.empty() && !check(pairs)) {
      return false;
    }
    validity.set_free(changes_.revision());
    return true;
  }

  [[nodiscard]] std::vector<int> unknown_pairs(const ValidityState& validity) const {
    const geometric::CollisionWorld& world = context_.problem().checker->world();
    if (validity.was_free()) {
      return changes_.pairs_changed_since(validity.free_at, world);
    }
    std::vector<int> all(static_cast<std::size_t>(world.check_count()));
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

  // Objects of which it was known to be free stay known.
  void refuse(ValidityState& validity, int pair) const {
    validity.refused_at = changes_.revision();
    validity.refused_by.clear();
    const geometric::CollisionWorld& world = context_.problem().checker->world();
    if (!world.constraint(pair)) {
      const int other = world.pairs()[static_cast<std::size_t>(pair)].b;
      if (!world.body(other).moves()) {
        validity.refused_by = world.body(other).name;
      }
    }
  }

  // Returns the end of the motion from node `a` to `b`.
  [[nodiscard]] Configuration end_of(int a, int b) const {
    return context_.problem().model().nearest_equivalent(graph_.configuration(a),
                                                         graph_.configuration(b));
  }

  PlanningContext& context_;
  RoadmapGraph& graph_;
  const SceneChanges& changes_;
  std::map<std::pair<int, int>, double> obstructions_;
};

/// Records the results of several searches, one after the other.
class SearchRecorder final : public RoadmapRecorder {
 public:
  explicit SearchRecorder(Observer* next)
      : RoadmapRecorder(std::numeric_limits<std::size_t>::max(), next) {}

  // Numbers of the new search differ.
  [[nodiscard]] AlgorithmObserver* algorithm() override { return nullptr; }
};

// The farthest place that is safely reached from `from` towards `to` before `obstruction`, in [0,
// 1].
Configuration before_obstruction(PlanningContext& context, const Configuration& from,
                                 const Configuration& to, double obstruction) {
  const double length = normalised_distance(context.problem().model(), from, to);
  const double share = obstruction - kBackOff / std::max(length, kBackOff);
  if (share <= 0.0) {
    return from;
  }
  Configuration q = from + share * (to - from);
  return !context.validator().collision(q) && context.validator().edge_free(from, q) ? q : from;
}

}  // namespace

/// Plans with the results of earlier queries.
struct DynamicRoadmap::Replanner final : public Planner {
  Replanner(PlanningProblem first, std::unique_ptr<Planner> from_scratch, int most_nodes)
      : problem(std::move(first)),
        planner(from_scratch ? std::move(from_scratch) : make_auto_planner()),
        max_nodes(most_nodes),
        graph(std::make_unique<RoadmapGraph>(problem.scene->robots.front().model)) {
    objective() = planner->objective();
  }

  [[nodiscard]] std::string name() const override { return "dynamic-roadmap"; }
  [[nodiscard]] std::string description() const override {
    return "Roadmap that is reused while the scene changes";
  }
  [[nodiscard]] PlannerCapabilities capabilities() const override {
    return planner->capabilities();
  }
  [[nodiscard]] std::vector<geometric::BoundParameter> own_parameters() override { return {}; }

  // Several changes between two queries make a single new checker.
  void update() {
    if (changed) {
      problem = updated_problem(problem, std::exchange(changed, nullptr), problem.basis);
    }
  }

  // Notes the objects that another scene changes; false: it changes more than objects and ends.
  bool note_changes(const geometric::Scene& scene) {
    const geometric::Scene& before = changed ? *changed : *problem.scene;
    const auto difference = geometric::scene_difference(before, scene);
    if (!difference || difference->other_constraints || difference->other_group || !scene.goal ||
        !scene.goal_poses.empty()) {
      return false;
    }
    for (const geometric::ObjectChange& change : difference->changes) {
      changes.note(change.object.name);
    }
    return true;
  }

  void do_plan(PlanningContext& context, PlanResult& result) override {
    LazyPathValidator validator(context, *graph, changes);
    std::optional<Path> path = known_path(validator);
    if (!path && !last_path.empty()) {
      path = repaired_path(context, validator);
    }
    if (path) {
      result.status = PlanStatus::kSolved;
      if (source != ReplanSource::kLastPath) {
        smooth_result(context, objective(), kSmoothingChecks, *path, result);
      } else {
        result.path = std::move(*path);
      }
      const char* found = source == ReplanSource::kLastPath  ? "The previous path is still valid"
                          : source == ReplanSource::kRoadmap ? "Found a path in the roadmap"
                                                             : "Repaired the previous path";
      result.reason = fmt::format("{}: {} waypoints.", found, result.path.waypoints.size());
    } else if (const std::optional<PlanStatus> interruption = context.interruption()) {
      result.status = *interruption;
    } else {
      planner->plan_within(context, result);
      source = result.solved() ? ReplanSource::kPlanner : ReplanSource::kNone;
    }
    learn(recorder->roadmap());
    if (result.solved()) {
      remember(result.path);
    }
    context.statistics().nodes = static_cast<std::uint64_t>(graph->node_count());
    context.statistics().edges = static_cast<std::uint64_t>(graph->edge_count());
  }

  // Searches the present roadmap.
  std::optional<Path> known_path(LazyPathValidator& validator) {
    constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();
    const int start = graph->node_at(problem.start);
    const int goal = graph->node_at(problem.goal);
    graph->node(start).set_free(changes.revision());  // plan() has checked them
    graph->node(goal).set_free(changes.revision());
    for (const auto& [edges, checks] : {std::pair(RoadmapGraph::Edges::kOnceFree, kUnlimited),
                                        std::pair(RoadmapGraph::Edges::kAny, kRoadmapChecks)}) {
      if (const auto nodes = validator.shortest_path(start, goal, edges, checks)) {
        Path path = along(*nodes);
        source = path.waypoints == last_path.waypoints ? ReplanSource::kLastPath
                                                       : ReplanSource::kRoadmap;
        return path;
      }
    }
    return std::nullopt;
  }

  // The last path with a detour for each of its blocked stretches.
  std::optional<Path> repaired_path(PlanningContext& context, LazyPathValidator& validator) {
    const std::vector<int> nodes = free_waypoints(validator);
    std::vector<bool> edge_free;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      edge_free.push_back(validator.edge_free(nodes[i], nodes[i + 1]));
    }
    const std::vector<Configuration> waypoints = along(nodes).waypoints;
    Path path{{waypoints.front()}};
    const auto append = [&path](const Configuration& q) {
      if (q != path.waypoints.back()) {
        path.waypoints.push_back(q);
      }
    };
    for (std::size_t i = 0, end = 1; end < nodes.size(); i = end++) {
      if (edge_free[i]) {
        path.waypoints.push_back(waypoints[end]);
        continue;
      }
      while (end < edge_free.size() && !edge_free[end]) {
        ++end;
      }
      const std::optional<Path> around =
          detour(context,
                 before_obstruction(context, waypoints[i], waypoints[i + 1],
                                    validator.obstruction(nodes[i], nodes[i + 1])),
                 before_obstruction(context, waypoints[end], waypoints[end - 1],
                                    validator.obstruction(nodes[end], nodes[end - 1])));
      if (!around) {
        return std::nullopt;
      }
      std::ranges::for_each(around->waypoints, append);
      append(waypoints[end]);
    }
    source = ReplanSource::kRepair;
    return path;
  }

  // Start, free inner waypoints of the last path, goal.
  std::vector<int> free_waypoints(LazyPathValidator& validator) {
    const int start = graph->node_at(problem.start);
    const int goal = graph->node_at(problem.goal);
    std::vector<int> nodes{start};
    for (const Configuration& q : last_path.waypoints) {
      const int node = graph->node_at(q);
      if (node != start && node != goal && validator.node_free(node)) {
        nodes.push_back(node);
      }
    }
    nodes.push_back(goal);
    return nodes;
  }

  std::optional<Path> detour(PlanningContext& context, const Configuration& from,
                             const Configuration& to) {
    if (context.interruption()) {
      return std::nullopt;
    }
    if (from == to) {
      return Path{{from}};
    }
    PlanningProblem part = problem;
    part.start = from;
    part.goal = to;
    const std::unique_ptr<PlanningContext> own = context.make_child(part, *recorder, {});
    RrtConnectSettings settings;
    settings.max_samples = std::numeric_limits<int>::max();
    BidirectionalSearch search(*own, settings,
                               part.basis ? HandSpace::kPrincipalDirections : HandSpace::kAllJoints,
                               context.request().seed);
    SearchBudget budget;
    budget.checks = kRepairChecks;
    const bool found = search.advance(budget) == PlanStatus::kSolved;
    context.statistics() += own->statistics();
    return found ? std::optional(search.path()) : std::nullopt;
  }

  [[nodiscard]] Path along(const std::vector<int>& nodes) const {
    Path path;
    for (const int node : nodes) {
      path.waypoints.push_back(graph->configuration(node));
    }
    path.waypoints.front() = problem.start;  // to the bit, whatever turn its node is at
    return {problem.model().unwrapped(std::move(path.waypoints), problem.start)};
  }

  // Keeps a path whose edges are free in this revision, and discards the rest if it is too large.
  void remember(const Path& path) {
    if (graph->node_count() > max_nodes) {
      graph = std::make_unique<RoadmapGraph>(problem.scene->robots.front().model);
    }
    last_path = {problem.model().in_half_turns(path.waypoints)};
    int before = -1;
    for (const Configuration& q : last_path.waypoints) {
      const int node = graph->node_at(q);
      graph->node(node).set_free(changes.revision());
      if (before >= 0 && before != node) {
        graph->edge(before, node).set_free(changes.revision());
      }
      before = node;
    }
  }

  /// Adds the searches' results to the roadmap, as nodes and edges of unknown state.
  void learn(const RecordedRoadmap& found) {
    std::vector<int> numbers(found.nodes.size(), -1);
    for (std::size_t i = 0; i < numbers.size() && graph->node_count() < max_nodes; ++i) {
      numbers[i] = graph->node_at(found.nodes[i].q);
    }
    for (const auto& [from, to] : found.edges) {
      const int a = numbers[static_cast<std::size_t>(from)];
      const int b = numbers[static_cast<std::size_t>(to)];
      if (a >= 0 && b >= 0 && a != b) {
        graph->edge(a, b);
      }
    }
  }

  PlanningProblem problem;
  std::unique_ptr<Planner> planner;  ///< Plans the first path, and others if repair fails.
  int max_nodes;  ///< Limit beyond which all but the last path's nodes are removed.
  std::unique_ptr<RoadmapGraph> graph;
  SceneChanges changes;
  Path last_path;                                             ///< Empty: no path was found yet.
  ReplanSource source = ReplanSource::kNone;                  ///< Source of the last query's path.
  std::shared_ptr<const geometric::Scene> changed = nullptr;  ///< Next scene, or null.
  SearchRecorder* recorder = nullptr;                         ///< Recorder of the present query.
};

DynamicRoadmap::DynamicRoadmap(PlanningProblem problem, std::unique_ptr<Planner> planner,
                               int max_nodes)
    : replanner_(std::make_unique<Replanner>(std::move(problem), std::move(planner), max_nodes)) {}
DynamicRoadmap::~DynamicRoadmap() = default;

const PlanningProblem& DynamicRoadmap::problem() {
  replanner_->update();
  return replanner_->problem;
}

ReplanSource DynamicRoadmap::source() const { return replanner_->source; }

bool DynamicRoadmap::follow(const geometric::Scene& scene) {
  if (!replanner_->note_changes(scene)) {
    return false;
  }
  replanner_->changed = std::make_shared<const geometric::Scene>(scene);
  return true;
}

bool DynamicRoadmap::follow(const PlanningProblem& next) {
  if (!replanner_->note_changes(*next.scene)) {
    return false;
  }
  replanner_->changed = nullptr;
  replanner_->problem = next;
  return true;
}

void DynamicRoadmap::adopt(const Path& path) {
  replanner_->update();
  if (!path.empty()) {
    replanner_->remember(path);
  }
}

PlanResult DynamicRoadmap::plan(const PlanRequest& request, std::stop_token stop,
                                Observer* observer) {
  const PlanningProblem& now = problem();
  // A roadmap connects a single start and goal of the moving joints.
  if (now.has_pose_goals() || !group_fault(now).empty()) {
    replanner_->source = ReplanSource::kPlanner;
    return replanner_->planner->plan(now, request, std::move(stop), observer);
  }
  replanner_->source = ReplanSource::kNone;
  SearchRecorder recorder(observer);
  replanner_->recorder = &recorder;
  return replanner_->plan(now, request, std::move(stop), &recorder);
}

const char* to_string(ReplanSource source) {
  static constexpr std::array kWords{"No path", "Previous path still valid", "Found in the roadmap",
                                     "Repaired the previous path", "Planned from scratch"};
  return kWords.at(static_cast<std::size_t>(source));
}

}  // namespace handway::planning
