#include "dataset_episode.h"

#include "handway/geometric/setup/placing.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/edits/arranging.h"
#include "handway/planning/edits/scene_edits.h"
#include "handway/planning/tasks/resting_places.h"
#include "handway/sampling/sequences/random_stream.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

namespace handway::tools {
namespace {

using geometric::Pose;

constexpr int kPlacesDrawn = 512;

auto object_of(geometric::Scene& scene, const std::string& name) {
  return std::ranges::find(scene.objects, name, &geometric::SceneObject::name);
}

// A place for the object; its present one if there is none.
Pose random_place(const geometric::Scene& scene, const geometric::SceneObject& object,
                  const SceneVariation& variation, std::uint64_t seed) {
  const std::vector<std::string> supports = planning::supports_of(scene, object);
  if (supports.empty()) {
    return object.X_PO;
  }
  for (const Pose& X_WO :
       planning::resting_places(scene, object, supports.front(), kPlacesDrawn, seed)) {
    if ((X_WO.translation() - object.X_PO.translation()).norm() > variation.spread) {
      continue;
    }
    geometric::Scene moved = scene;
    object_of(moved, object.name)->X_PO = X_WO;
    if (planning::sunk_into(moved, {object.name}).empty()) {
      return X_WO;
    }
  }
  return object.X_PO;
}

void add_pose_names(const std::string& name, std::vector<std::string>& names) {
  for (const char* component : {".x", ".y", ".z", ".qx", ".qy", ".qz", ".qw"}) {
    names.push_back(name + component);
  }
}

void set_pose(const Pose& X_WO, Eigen::Ref<Eigen::RowVectorXd> row) {
  const Eigen::Quaterniond q(X_WO.linear());
  row << X_WO.translation().transpose(), q.x(), q.y(), q.z(), q.w();
}

// Draws the object of an episode, and sets its task. @returns the scene with the object.
planning::SceneState with_drawn(const LoadedTask& loaded, const SceneVariation& variation,
                                Episode& episode) {
  episode.task = loaded.task;
  if (variation.objects.empty()) {
    return loaded.state;
  }
  const std::string target = picked_objects(loaded.task).front();
  episode.drawn = planning::draw_object(variation.objects, episode.seed);
  const planning::ObjectChoice& choice = variation.objects[episode.drawn->choice];
  if (!choice.scene_object.empty()) {
    episode.task = with_picked_object(loaded.task, target, choice.scene_object);
  }
  return with_drawn_object(loaded.state, target, choice, *episode.drawn);
}

// Names of the columns. @param objects the picked ones.
std::vector<std::string> column_names(const Episode& episode,
                                      const std::vector<std::string>& objects) {
  const geometric::RobotModel& model = *episode.timed.motion.model;
  std::vector<std::string> names;
  for (int v = 0; v < model.variable_count(); ++v) {
    names.push_back(model.variable(v).name);
  }
  add_pose_names("palm", names);
  for (const std::string& object : objects) {
    add_pose_names(episode.drawn ? "object" : object, names);
  }
  names.emplace_back("stage");
  if (episode.drawn) {
    names.insert(names.end(), {"object.choice", "object.size_x", "object.size_y", "object.size_z"});
  }
  return names;
}

}  // namespace

std::vector<geometric::BoundParameter> parameters_of(SceneVariation& variation) {
  return {geometric::in_thousandths(
      {"spread_mm", "Spread", "mm",
       "Distance up to which a picked object is moved from its place in the scene",
       &variation.spread, 0.0, 1e4})};
}

planning::SceneState with_random_places(const planning::SceneState& state,
                                        const std::vector<std::string>& objects,
                                        const SceneVariation& variation, std::uint64_t seed) {
  geometric::Scene scene = *state.scene;
  const sampling::RandomStream random(seed);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const auto object = object_of(scene, objects[i]);
    if (object != scene.objects.end() && !object->attachment) {
      object->X_PO = random_place(scene, *object, variation, random.fork(i).below(1ULL << 62));
    }
  }
  planning::SceneState varied = state;
  varied.scene = std::make_shared<const geometric::Scene>(std::move(scene));
  return varied;
}

Episode make_episode(const LoadedTask& loaded, const TaskRequest& request,
                     const planning::PluginManager& plugins, const planning::TimingOptions& timing,
                     const SceneVariation& variation, std::uint64_t seed,
                     const std::stop_token& stop) {
  constexpr std::uint64_t kTries = 8;  // until no object is in the way of the robot's start
  Episode episode;
  episode.seed = seed;
  const planning::SceneState state = with_drawn(loaded, variation, episode);
  planning::TaskOptions options = request.options;
  options.seed = seed;
  const auto planner = planner_of(request, loaded.state, plugins);
  const sampling::RandomStream places(seed);
  for (std::uint64_t i = 0; i < kTries && (i == 0 || !episode.plan.start_is_valid); ++i) {
    episode.state = with_random_places(state, picked_objects(episode.task), variation,
                                       places.fork(i).below(1ULL << 62));
    episode.plan = plan_task(episode.state, episode.task, *planner, options, stop);
  }
  if (!episode.plan.solved) {
    episode.reason = episode.plan.reason;
    return episode;
  }
  planning::TimingOptions stoppable = timing;
  stoppable.stop = stop;
  episode.timed = time_task(episode.task, episode.plan, "episode", stoppable);
  if (episode.timed.cleared()) {
    planning::Trajectory& trajectory = episode.timed.motion.trajectory;
    trajectory = with_rests_sampled(trajectory, timing.period);
  }
  const auto fault = std::ranges::find_if_not(episode.timed.stages, &planning::TimedPath::cleared);
  if (fault != episode.timed.stages.end()) {
    episode.reason =
        fault->blends.fault.empty() ? fault->preflight.faults.front().text : fault->blends.fault;
  }
  return episode;
}

const geometric::SceneObject& drawn_object(const Episode& episode) {
  return *episode.state.find(picked_objects(episode.task).front());
}

device::RecordedTable table_of(const Episode& episode) {
  constexpr Eigen::Index kPose = 7;
  const planning::Motion& motion = episode.timed.motion;
  const geometric::RobotModel& model = *motion.model;
  const std::vector<std::string> objects = picked_objects(episode.task);
  const geometric::Scene& first = *episode.plan.stages.front().state.scene;
  const int palm = planning::make_problem(episode.plan.stages.front().state.scene, nullptr, {},
                                          planning::GoalNeed::kOptional)
                       .hand.palm;
  device::RecordedTable table;
  const auto variables = static_cast<Eigen::Index>(model.variable_count());
  const Eigen::Index stage_column = variables + (std::ssize(objects) + 1) * kPose;
  table.names = column_names(episode, objects);
  const auto rows = std::ssize(motion.trajectory.points);
  table.times.resize(rows);
  table.values.resize(rows, std::ssize(table.names));
  if (episode.drawn) {
    table.values.col(stage_column + 1).setConstant(static_cast<double>(episode.drawn->choice));
    table.values.rightCols(3).rowwise() =
        planning::size_of_object(drawn_object(episode)).transpose();
  }
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  Eigen::Index row = 0;
  for (std::size_t stage = 0; stage < motion.stages.size(); ++stage) {
    std::span<const planning::TrajectoryPoint> points = points_of_stage(motion, stage);
    const planning::SceneState& state = episode.plan.stages[stage].state;
    for (const planning::TrajectoryPoint& point : points.subspan(stage == 0 ? 0 : 1)) {
      Eigen::RowVectorXd values(stage_column + 1);
      values.head(variables) = point.position.transpose();
      model.forward_kinematics(point.position, X_BL);
      set_pose(first.robots.front().X_WB * X_BL[static_cast<std::size_t>(palm)],
               values.segment(variables, kPose));
      for (std::size_t i = 0; i < objects.size(); ++i) {
        set_pose(object_pose(*state.scene, point.position, *state.find(objects[i])),
                 values.segment(variables + static_cast<Eigen::Index>(i + 1) * kPose, kPose));
      }
      values[stage_column] = static_cast<double>(stage);
      table.times[row] = point.time;
      table.values.row(row++).head(stage_column + 1) = values;
    }
  }
  return table;
}

}  // namespace handway::tools
