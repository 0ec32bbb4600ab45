#include "ompl_planner.h"

#include "handway/geometric/io/input_error.h"
#include "handway/planning/core/planning_context.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/paths/roadmap_smoothing.h"
#include "handway/planning/spaces/target_sampler.h"

#include <fmt/format.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/Console.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

namespace handway::planner_ompl {
namespace {

namespace ob = ompl::base;
using planning::Configuration;
using planning::PlanStatus;

void apply(ob::Planner& planner, const geometric::Parameter& setting) {
  const std::string text = geometric::to_text(setting);
  if (!planner.params().setParam(setting.key, text)) {
    throw geometric::InputError(
        {planner.getName(), setting.key, text, "a value that OMPL accepts", ""});
  }
}

}  // namespace

Search::Search(planning::PlanningContext& context, const Method& method,
               std::unique_ptr<StateMap> map, const std::vector<geometric::Parameter>& settings,
               SampleBudget budget, const planning::TargetRegion& region, planning::HandSpace hand)
    : context_(context),
      traits_(method.traits),
      budget_(budget),
      map_(std::move(map)),
      draws_(context, region, hand),
      information_(std::make_shared<ob::SpaceInformation>(map_->space())),
      definition_(std::make_shared<ob::ProblemDefinition>(information_)),
      motions_(std::make_shared<MotionCheck>(information_, context_, *map_)) {
  try {
    set_up(method, settings);
  } catch (const ompl::Exception& e) {
    throw geometric::InputError({context.problem().scene->file.string(), method.name, e.what(),
                                 "a problem and settings that OMPL accepts", ""});
  }
}

// All generators but those of samplers are made here, so that their seeds depend on the run
// alone.
void Search::set_up(const Method& method, const std::vector<geometric::Parameter>& settings) {
  const SeedingLock lock = lock_seeding();
  seed_ompl(lock, draws_);
  draw_states(*map_, draws_);
  draw_valid_states(*information_);
  information_->setStateValidityChecker(
      std::make_shared<StateCheck>(information_, context_, *map_));
  information_->setMotionValidator(motions_);
  information_->setup();
  set_goal_and_start();
  set_objective();

  planner_ = method.make(information_);
  for (const geometric::Parameter& setting : settings) {
    apply(*planner_, setting);
  }
  planner_->setProblemDefinition(definition_);
  planner_->setup();
  draws_.forget_count();
}

void Search::set_goal_and_start() {
  ob::State* end = information_->allocState();
  map_->write(context_.problem().start, end);
  definition_->addStartState(end);
  map_->write(context_.problem().goal, end);
  const auto goal = make_goal(information_, draws_);
  goal->setState(end);
  definition_->setGoal(goal);
  information_->freeState(end);
}

// Every path is accepted if the first one is taken.
void Search::set_objective() {
  if (!traits_.improves) {
    return;
  }
  const ob::OptimizationObjectivePtr objective = make_path_length(information_, draws_);
  objective->setCostThreshold(budget_.improvement == 0 ? objective->infiniteCost()
                                                       : objective->identityCost());
  definition_->setOptimizationObjective(objective);
  definition_->setIntermediateSolutionCallback(
      [this](const ob::Planner* /*planner*/, const std::vector<const ob::State*>& /*states*/,
             ob::Cost /*cost*/) {
        if (!first_path_at_) {
          first_path_at_ = draws_.counted();
        }
      });
}

bool Search::has_to_end() {
  const auto all = static_cast<double>(budget_.all);
  double spent = static_cast<double>(draws_.counted()) / all;
  if (first_path_at_ && budget_.improvement > 0) {
    spent = std::max(spent, static_cast<double>(draws_.counted() - *first_path_at_) /
                                static_cast<double>(budget_.improvement));
  }
  context_.observer().on_progress(std::min(1.0, spent), first_path_at_ ? "improving" : "searching");
  return spent >= 1.0 || context_.interruption();
}

void Search::run(planning::PlanResult& result) {
  try {
    planner_->solve(ob::PlannerTerminationCondition([this] { return has_to_end(); }));
  } catch (const ompl::Exception& e) {
    result.reason = fmt::format("OMPL gave up after {} samples: {}.", draws_.counted(), e.what());
  }
  context_.statistics().samples = draws_.counted();
  if (definition_->hasExactSolution()) {
    result.path = path();
  }
  if (result.path.waypoints.empty()) {
    result.status = context_.interruption().value_or(PlanStatus::kSamplesSpent);
  } else if (proved(result.path)) {
    result.status = PlanStatus::kSolved;
  } else {
    result.path = {};
    result.status = context_.interruption().value_or(PlanStatus::kSamplesSpent);
    result.reason = fmt::format(
        "OMPL's path after {} samples has a motion that is not free where OMPL cut it at a joint's "
        "limit.",
        draws_.counted());
  }
  publish_graph();
}

planning::Path Search::path() const {
  const auto solution = definition_->getSolutionPath();
  planning::Path path;
  for (const ob::State* state : solution->as<ompl::geometric::PathGeometric>()->getStates()) {
    path.waypoints.push_back(map_->read(state));
  }
  return path;
}

bool Search::proved(const planning::Path& path) {
  const auto end = std::ranges::adjacent_find(
      path.waypoints, [this](const Configuration& from, const Configuration& to) {
        return !motions_->known_free(from, to) &&
               !context_.validator().edge_free(
                   from, context_.problem().model().nearest_equivalent(from, to));
      });
  return end == path.waypoints.end();
}

// Undirected edges occur once for each direction.
std::vector<std::pair<int, int>> Search::edges_of(const ob::PlannerData& graph,
                                                  const std::vector<Configuration>& nodes) const {
  std::vector<std::pair<int, int>> edges;
  for (unsigned int v = 0; v < graph.numVertices(); ++v) {
    std::vector<unsigned int> ends;
    graph.getEdges(v, ends);
    for (const unsigned int end : ends) {
      const bool first = v < end || !graph.edgeExists(end, v);
      if (first && (!traits_.guesses || motions_->known_free(nodes[v], nodes[end]))) {
        edges.emplace_back(v, end);
      }
    }
  }
  return edges;
}

// Publishes the graph; of unchecked edges only those found free, with both ends of the problem.
void Search::publish_graph() {
  ob::PlannerData graph(information_);
  planner_->getPlannerData(graph);
  std::vector<Configuration> nodes;
  std::vector<bool> shown(graph.numVertices(), !traits_.guesses);
  for (unsigned int v = 0; v < graph.numVertices(); ++v) {
    nodes.push_back(map_->read(graph.getVertex(v).getState()));
    shown[v] = shown[v] || graph.isStartVertex(v) || graph.isGoalVertex(v);
  }
  const std::vector<std::pair<int, int>> edges = edges_of(graph, nodes);
  for (const auto& [from, to] : edges) {
    shown[static_cast<std::size_t>(from)] = true;
    shown[static_cast<std::size_t>(to)] = true;
  }
  auto& statistics = context_.statistics();
  for (std::size_t v = 0; v < nodes.size(); ++v) {
    if (shown[v]) {
      ++statistics.nodes;
      context_.observer().on_node({.id = static_cast<int>(v),
                                   .q = nodes[v],
                                   .step = planning::arm_progress(context_.problem(), nodes[v])});
    }
  }
  statistics.edges = edges.size();
  for (const auto& [from, to] : edges) {
    context_.observer().on_edge(from, to);
  }
}

namespace {

using geometric::BoundParameter;
using geometric::Parameter;
using planning::HandSpace;

class DebugLog final : public ompl::msg::OutputHandler {
 public:
  void log(const std::string& text, ompl::msg::LogLevel /*level*/, const char* /*file*/,
           int /*line*/) override {
    spdlog::debug("OMPL: {}", text);
  }
};

}  // namespace

OmplPlanner::OmplPlanner(const Method& method, planning::HandSpace space)
    : method_(method), space_(space) {
  for (const MethodSetting& setting : method.settings) {
    values_.push_back(setting.initial);
  }
}

std::string OmplPlanner::name() const {
  return (space_ == HandSpace::kAllJoints ? "ompl-" : "ompl-pmd-") + method_.key;
}

std::string OmplPlanner::description() const {
  return fmt::format("OMPL's {} over {}: {}", method_.name,
                     space_ == HandSpace::kAllJoints
                         ? "all joints"
                         : "the arm's corridor and the hand's principal motion directions",
                     method_.summary);
}

planning::PlannerCapabilities OmplPlanner::capabilities() const {
  const bool in_controls = space_ == HandSpace::kPrincipalDirections;
  return {.uses_pmds = in_controls, .needs_basis = in_controls};
}

std::vector<BoundParameter> OmplPlanner::method_parameters() {
  std::vector<BoundParameter> list;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const MethodSetting& setting = method_.settings[i];
    std::visit(
        [&](auto& value) {
          list.push_back(
              {setting.key, setting.label, "", setting.help, &value, setting.lower, setting.upper});
        },
        values_[i]);
  }
  return list;
}

std::vector<BoundParameter> OmplPlanner::own_parameters() {
  std::vector<BoundParameter> list = method_parameters();
  list.push_back({"max_samples", "Samples", "",
                  "Largest number of samples; the planner then gives up.", &budget_.all, 1,
                  100000000});
  if (method_.traits.improves) {
    list.push_back({"improvement_samples", "Improvement samples", "",
                    "Number of samples after the first path, to find a shorter one. 0: the first "
                    "path is the result.",
                    &budget_.improvement, 0, 100000000});
  }
  if (space_ == HandSpace::kPrincipalDirections) {
    list.push_back({"max_pmds", "Principal directions", "",
                    "Largest number of principal motion directions that are used together.",
                    &region_.max_pmds, 1, 13});
    planning::append_region_parameters(list, region_);
  }
  return list;
}

void OmplPlanner::do_plan(planning::PlanningContext& context, planning::PlanResult& result) {
  const planning::PlanningProblem& problem = context.problem();
  std::unique_ptr<planning::StateSpace> space;
  if (space_ == HandSpace::kAllJoints) {
    space = planning::make_corridor_space(problem, planning::CorridorForm::kJoint);
  } else {
    space = planning::make_control_space(problem, region_.max_pmds, region_.rho_max);
  }
  std::vector<Parameter> settings;
  std::ranges::transform(method_parameters(), std::back_inserter(settings), geometric::value_of);
  Search search(context, method_, std::make_unique<StateMap>(std::move(space)), settings, budget_,
                region_, space_);
  search.run(result);
  if (result.solved()) {
    const double begin = context.elapsed_s();
    result.path = planning::smooth_by_roadmap(context, result.path);
    result.smoothing_s = context.elapsed_s() - begin;
  }
}

void register_planners(planning::PlannerRegistry& registry) {
  static DebugLog log;
  ompl::msg::useOutputHandler(&log);
  for (const HandSpace space : {HandSpace::kAllJoints, HandSpace::kPrincipalDirections}) {
    for (const Method& method : methods()) {
      registry.add(OmplPlanner(method, space).name(),
                   [&method, space] { return std::make_unique<OmplPlanner>(method, space); });
    }
  }
}

}  // namespace handway::planner_ompl

HANDWAY_PLUGIN({.name = "planner_ompl",
                .version = HANDWAY_VERSION,
                .register_planners = handway::planner_ompl::register_planners});
