#include "model/document/selection.h"

#include "handway/planning/edits/arranging.h"

#include <algorithm>
#include <utility>

namespace handway::gui {
namespace {

using Kind = SceneItem::Kind;
using Names = std::vector<std::string>;

bool holds(const Names& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

bool same_set(Names a, Names b) {
  std::ranges::sort(a);
  std::ranges::sort(b);
  return a == b;
}

// The object with its group; it comes last.
Names with_group(const planning::SceneState& state, const std::string& object) {
  const std::string group = state.display_of(object).group;
  if (group.empty()) {
    return {object};
  }
  Names members = planning::group_members(*state.scene, group);
  std::erase(members, object);
  members.push_back(object);
  return members;
}

}  // namespace

SceneItem object_item(const std::string& name) { return {Kind::kObject, "", name}; }

SceneItem goal_pose_item(std::size_t index) { return {Kind::kGoalPose, "", std::to_string(index)}; }

SceneItem frame_item(const std::string& name) { return {Kind::kFrame, "", name}; }

const geometric::NamedFrame* find_frame(const planning::SceneState& state, const SceneItem& item) {
  return item.kind == Kind::kFrame && state.scene ? geometric::find_frame(*state.scene, item.name)
                                                  : nullptr;
}

const geometric::PoseGoal* find_goal_pose(const planning::SceneState& state,
                                          const SceneItem& item) {
  if (item.kind != Kind::kGoalPose || !state.scene) {
    return nullptr;
  }
  const std::size_t index = std::stoul(item.name);
  return index < state.scene->goal_poses.size() ? &state.scene->goal_poses[index] : nullptr;
}

Selection selection_of(const SceneItem& item) {
  return {item, item.kind == Kind::kObject ? Names{item.name} : Names{}};
}

Selection selection_of(std::vector<std::string> objects) {
  Names once;
  for (std::string& name : objects) {
    if (!holds(once, name)) {
      once.push_back(std::move(name));
    }
  }
  return {once.empty() ? SceneItem{} : object_item(once.back()), once};
}

Selection clicked(const planning::SceneState& state, const Selection& now, const SceneItem& item) {
  if (item.kind != Kind::kObject) {
    return selection_of(item);
  }
  const Names group = with_group(state, item.name);
  return same_set(group, now.objects) ? selection_of(item) : selection_of(group);
}

Selection toggled(const planning::SceneState& state, const Selection& now, const SceneItem& item) {
  if (item.kind != Kind::kObject) {
    return now.objects.empty() ? selection_of(item) : now;
  }
  const Names group = with_group(state, item.name);
  Names objects = now.objects;
  const bool all_in =
      std::ranges::all_of(group, [&](const std::string& name) { return holds(objects, name); });
  std::erase_if(objects, [&](const std::string& name) { return holds(group, name); });
  if (!all_in) {
    objects.insert(objects.end(), group.begin(), group.end());
  }
  return selection_of(std::move(objects));
}

Selection still_there(const planning::SceneState& state, Selection selection) {
  if (selection.item.kind == Kind::kGoalPose && !find_goal_pose(state, selection.item)) {
    return {};
  }
  if (selection.item.kind == Kind::kFrame && !find_frame(state, selection.item)) {
    return {};
  }
  std::erase_if(selection.objects, [&](const std::string& name) { return !state.find(name); });
  if (selection.item.kind == Kind::kObject) {
    return selection_of(std::move(selection.objects));
  }
  const bool is_of_robot =
      selection.item.kind == Kind::kRobot || selection.item.kind == Kind::kLink;
  if (is_of_robot && state.scene) {
    const geometric::RobotInstance* robot =
        geometric::find_robot_with_part(*state.scene, selection.item.robot);
    const bool is_there = robot && (selection.item.kind == Kind::kRobot ||
                                    robot->model->find_link(selection.item.name));
    return is_there ? selection : Selection{};
  }
  return selection;
}

}  // namespace handway::gui
