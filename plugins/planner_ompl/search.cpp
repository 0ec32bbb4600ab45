#include "search.h"

#include "handway/geometric/io/input_error.h"
#include "motion_check.h"

#include <fmt/format.h>
#include <ompl/base/PlannerData.h>
#include <ompl/geometric/PathGeometric.h>

#include <algorithm>

namespace handway::planner_ompl {
namespace {

namespace ob = ompl::base;
using planning::Configuration;
using planning::PlanStatus;

void apply(ob::Planner& planner, const planning::Parameter& setting) {
  const std::string text = planning::to_text(setting);
  if (!planner.params().setParam(setting.key, text)) {
    throw geometric::InputError(
        {planner.getName(), setting.key, text, "a value that OMPL takes", ""});
  }
}

}  // namespace

Search::Search(planning::PlanningContext& context, const Method& method,
               const std::vector<planning::Parameter>& settings, int max_samples)
    : context_(context),
      max_samples_(static_cast<std::uint64_t>(max_samples)),
      cube_(context.problem()),
      draws_(context.request().seed),
      information_(std::make_shared<ob::SpaceInformation>(cube_.space())),
      definition_(std::make_shared<ob::ProblemDefinition>(information_)) {
  try {
    set_up(method, settings);
  } catch (const ompl::Exception& e) {
    throw geometric::InputError({context.problem().scene->file.string(), method.name, e.what(),
                                 "a problem and settings that OMPL takes", ""});
  }
}

// All generators but those of samplers are made here, so that the seeds they get depend
// on the run alone.
void Search::set_up(const Method& method, const std::vector<planning::Parameter>& settings) {
  const SeedingLock lock = lock_seeding();
  seed_ompl(lock, draws_);
  draw_from(*cube_.space(), *information_, draws_);
  information_->setStateValidityChecker(
      std::make_shared<StateCheck>(information_, context_, cube_));
  information_->setMotionValidator(std::make_shared<MotionCheck>(information_, context_, cube_));
  information_->setup();

  ob::State* end = information_->allocState();
  cube_.write(context_.problem().start, end);
  definition_->addStartState(end);
  cube_.write(context_.problem().goal, end);
  const auto goal = make_goal(information_, draws_);
  goal->setState(end);
  definition_->setGoal(goal);
  information_->freeState(end);

  planner_ = method.make(information_);
  for (const planning::Parameter& setting : settings) {
    apply(*planner_, setting);
  }
  planner_->setProblemDefinition(definition_);
  planner_->setup();
  draws_.forget_count();
}

bool Search::has_to_end() {
  const double spent = static_cast<double>(draws_.counted()) / static_cast<double>(max_samples_);
  context_.observer().on_progress(std::min(1.0, spent), "searching");
  return spent >= 1.0 || context_.interruption();
}

void Search::run(planning::PlanResult& result) {
  try {
    planner_->solve(ob::PlannerTerminationCondition([this] { return has_to_end(); }));
  } catch (const ompl::Exception& e) {
    result.reason = fmt::format("OMPL gave up after {} samples: {}.", draws_.counted(), e.what());
  }
  context_.statistics().samples = draws_.counted();
  publish_graph();
  if (definition_->hasExactSolution()) {
    result.status = PlanStatus::kSolved;
    result.path = path();
  } else {
    result.status = context_.interruption().value_or(PlanStatus::kSamplesSpent);
  }
}

planning::Path Search::path() const {
  const auto solution = definition_->getSolutionPath();
  planning::Path path;
  for (const ob::State* state : solution->as<ompl::geometric::PathGeometric>()->getStates()) {
    path.waypoints.push_back(cube_.read(state));
  }
  return path;
}

// Undirected edges are there once for each direction.
void Search::publish_graph() {
  ob::PlannerData graph(information_);
  planner_->getPlannerData(graph);
  auto& statistics = context_.statistics();
  statistics.nodes = graph.numVertices();
  for (unsigned int v = 0; v < graph.numVertices(); ++v) {
    const Configuration q = cube_.read(graph.getVertex(v).getState());
    context_.observer().on_node({.id = static_cast<int>(v), .q = q});
  }
  for (unsigned int v = 0; v < graph.numVertices(); ++v) {
    std::vector<unsigned int> ends;
    graph.getEdges(v, ends);
    for (const unsigned int end : ends) {
      if (v < end || !graph.edgeExists(end, v)) {
        ++statistics.edges;
        context_.observer().on_edge(static_cast<int>(v), static_cast<int>(end));
      }
    }
  }
}

}  // namespace handway::planner_ompl
