#include "handway/planning/replanning/living_roadmap.h"

#include "handway/geometric/collision/make_checker.h"
#include "handway/geometric/io/input_error.h"
#include "handway/planning/planners/auto_planner.h"
#include "handway/planning/planners/rrt_connect.h"
#include "replanning/replanner.h"

#include <algorithm>
#include <utility>

namespace handway::planning {

using geometric::CollisionWorld;
using geometric::InputError;
using geometric::ObjectChange;
using geometric::Scene;
using geometric::SceneObject;

namespace {

std::unique_ptr<Planner> usual_planner(const PlanningProblem& problem) {
  if (problem.basis) {
    return std::make_unique<AutoPlanner>();
  }
  return std::make_unique<RrtConnect>(HandSpace::kAllJoints);
}

// The scene's object of that name that stands still.
SceneObject still_object(const Scene& scene, const std::string& name) {
  const auto found =
      std::ranges::find_if(scene.objects, [&](const SceneObject& o) { return o.name == name; });
  if (found == scene.objects.end()) {
    std::string known;
    for (const SceneObject& object : scene.objects) {
      known += (known.empty() ? "one of " : ", ") + object.name;
    }
    throw InputError({scene.file.string(), "object " + name, "no such object",
                      known.empty() ? "an object of the scene, which has none" : known, ""});
  }
  if (found->attachment) {
    throw InputError(
        {scene.file.string(), "object " + name,
         "an attachment to " + found->attachment->robot + "/" + found->attachment->link,
         "an object that stands still", "A carried object moves with its link"});
  }
  return *found;
}

}  // namespace

struct LivingRoadmap::State {
  State(PlanningProblem first, const LivingRoadmapSettings& settings,
        std::unique_ptr<Planner> chosen)
      : problem(std::move(first)),
        world(problem.checker->shared_world()),
        planner(chosen ? std::move(chosen) : usual_planner(problem)),
        memory(settings, problem.model()) {}

  void change(const geometric::ObjectChange& change) {
    world = std::make_shared<const CollisionWorld>(world->with_change(change));
    auto scene = std::make_shared<Scene>(*problem.scene);
    geometric::apply(change, *scene);
    problem.scene = std::move(scene);
    if (change.kind != ObjectChange::Kind::kMoved) {  // else all moves as before
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
  std::shared_ptr<const CollisionWorld> world;
  std::unique_ptr<Planner> planner;
  RoadmapMemory memory;
};

LivingRoadmap::LivingRoadmap(PlanningProblem problem, const LivingRoadmapSettings& settings,
                             std::unique_ptr<Planner> planner)
    : state_(std::make_unique<State>(std::move(problem), settings, std::move(planner))) {}
LivingRoadmap::~LivingRoadmap() = default;
LivingRoadmap::LivingRoadmap(LivingRoadmap&&) noexcept = default;
LivingRoadmap& LivingRoadmap::operator=(LivingRoadmap&&) noexcept = default;

const PlanningProblem& LivingRoadmap::problem() {
  state_->update_checker();
  return state_->problem;
}

const ReplanReport& LivingRoadmap::report() const { return state_->memory.report; }

void LivingRoadmap::move_object(const std::string& name, const geometric::Pose& X_WO) {
  SceneObject object = still_object(*state_->problem.scene, name);
  object.X_PO = X_WO;
  state_->change({ObjectChange::Kind::kMoved, std::move(object)});
}

void LivingRoadmap::add_object(const SceneObject& object) {
  state_->change({ObjectChange::Kind::kAdded, object});
}

void LivingRoadmap::remove_object(const std::string& name) {
  state_->change({ObjectChange::Kind::kRemoved, still_object(*state_->problem.scene, name)});
}

bool LivingRoadmap::follow(const Scene& scene) {
  const auto difference = geometric::scene_difference(*state_->problem.scene, scene);
  if (!difference || difference->other_constraints || !scene.start || !scene.goal) {
    return false;
  }
  for (const ObjectChange& change : difference->changes) {
    state_->change(change);
  }
  set_start(*scene.start);
  set_goal(*scene.goal);
  return true;
}

void LivingRoadmap::set_start(const Configuration& q) {
  state_->problem.start = q;
  set_goal(state_->problem.goal);
}

void LivingRoadmap::set_goal(const Configuration& q) {
  PlanningProblem& problem = state_->problem;
  problem.goal = problem.model().nearest_equivalent(problem.start, q);
}

PlanResult LivingRoadmap::plan(const PlanRequest& request, std::stop_token stop,
                               Observer* observer) {
  state_->update_checker();
  state_->memory.report = {};
  Observer silent;
  NodeHarvest harvest(observer ? *observer : silent);
  Replanner replanner(state_->memory, *state_->planner, harvest);
  PlanResult result = replanner.plan(state_->problem, request, std::move(stop), &harvest);
  state_->memory.report.nodes = state_->memory.graph.node_count();
  state_->memory.report.edges = state_->memory.graph.edge_count();
  return result;
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
