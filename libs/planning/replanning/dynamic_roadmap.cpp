#include "handway/planning/replanning/dynamic_roadmap.h"

#include "handway/geometric/collision/checkers/make_checker.h"
#include "handway/geometric/scene/scene_difference.h"
#include "handway/planning/planners/auto_planner.h"
#include "handway/planning/planners/rrt_connect.h"
#include "replanning/replanner.h"

#include <utility>

namespace handway::planning {
namespace {

std::unique_ptr<Planner> usual_planner(const PlanningProblem& problem) {
  if (problem.basis) {
    return std::make_unique<AutoPlanner>();
  }
  return std::make_unique<RrtConnect>(HandSpace::kAllJoints);
}

}  // namespace

struct DynamicRoadmap::State {
  void change(const geometric::ObjectChange& change) {
    world = std::make_shared<const geometric::CollisionWorld>(world->with_change(change));
    auto scene = std::make_shared<geometric::Scene>(*problem.scene);
    geometric::apply(change, *scene);
    problem.scene = std::move(scene);
    if (change.kind != geometric::ObjectChange::Kind::kMoved) {  // else all moves as before
      problem.motion = nullptr;
    }
    memory.changes.note(change.object.name);
  }

  // Several changes between two queries make one checker.
  void update_checker() {
    if (problem.checker->shared_world() != world) {
      problem.checker = geometric::make_collision_checker(world);
      if (!problem.motion) {
        problem.motion = std::make_shared<const geometric::MotionBound>(*world);
      }
    }
  }

  PlanningProblem problem;
  std::shared_ptr<const geometric::CollisionWorld> world;
  std::unique_ptr<Planner> planner;
  RoadmapMemory memory;
};

DynamicRoadmap::DynamicRoadmap(PlanningProblem problem, std::unique_ptr<Planner> planner,
                               int max_nodes) {
  auto world = problem.checker->shared_world();
  auto graph = std::make_unique<RoadmapGraph>(problem.scene->robots.front().model);
  planner = planner ? std::move(planner) : usual_planner(problem);
  state_.reset(new State{std::move(problem), std::move(world), std::move(planner),
                         RoadmapMemory{max_nodes, std::move(graph)}});
}
DynamicRoadmap::~DynamicRoadmap() = default;

const PlanningProblem& DynamicRoadmap::problem() {
  state_->update_checker();
  return state_->problem;
}

ReplanSource DynamicRoadmap::source() const { return state_->memory.source; }

bool DynamicRoadmap::follow(const geometric::Scene& scene) {
  const auto difference = geometric::scene_difference(*state_->problem.scene, scene);
  if (!difference || difference->other_constraints || !scene.start || !scene.goal ||
      !scene.goal_poses.empty()) {
    return false;
  }
  for (const geometric::ObjectChange& change : difference->changes) {
    state_->change(change);
  }
  PlanningProblem& problem = state_->problem;
  problem.start = *scene.start;
  problem.set_goal(problem.model().nearest_equivalent(problem.start, *scene.goal));
  return true;
}

PlanResult DynamicRoadmap::plan(const PlanRequest& request, std::stop_token stop,
                                Observer* observer) {
  state_->update_checker();
  if (state_->problem.has_pose_goals()) {  // a roadmap is kept between two ends, not several
    state_->memory.source = ReplanSource::kPlanner;
    return state_->planner->plan(state_->problem, request, std::move(stop), observer);
  }
  Observer silent;
  return replan(state_->memory, *state_->planner, state_->problem, request, std::move(stop),
                observer ? *observer : silent);
}

const char* to_string(ReplanSource source) {
  switch (source) {
    case ReplanSource::kNone:
      return "none";
    case ReplanSource::kLastPath:
      return "last path";
    case ReplanSource::kRoadmap:
      return "roadmap";
    case ReplanSource::kRepair:
      return "repair";
    case ReplanSource::kPlanner:
      return "planner";
  }
  return "none";
}

}  // namespace handway::planning
