#include "handway/planning/edits/robot_edits.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/robot/group_proposal.h"
#include "handway/geometric/setup/mounting.h"
#include "handway/geometric/setup/moving_group.h"
#include "handway/geometric/setup/placing.h"
#include "handway/planning/edits/scene_edits.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace handway::planning {

using geometric::Configuration;
using geometric::Pose;
using geometric::ResourceKind;
using geometric::RobotInstance;
using geometric::RobotPart;
using geometric::Scene;

namespace {

// Returns the part; none for a robot of one file.
const RobotPart* find_part(const RobotInstance& robot, const std::string& name) {
  const auto found = std::ranges::find(robot.parts, name, &RobotPart::name);
  return found == robot.parts.end() ? nullptr : &*found;
}

// Returns whether the part `inner` is the part `outer` itself, or carried by it.
bool is_on(const RobotInstance& robot, const RobotPart& inner, const RobotPart& outer) {
  const RobotPart* part = &inner;
  while (part != &outer && part->carrier >= 0) {
    part = &robot.parts[static_cast<std::size_t>(part->carrier)];
  }
  return part == &outer;
}

std::string composed_base(const RobotPart& part) { return part.links.at(part.model->link(0).name); }

bool has_all_joints(const geometric::RobotModel& model, const sampling::PmdBasis& basis) {
  return std::ranges::all_of(basis.joints, [&](const std::string& joint) {
    return geometric::find_variable_of_part(model, joint).has_value();
  });
}

// The first robot as it is shown: what edits of its mounts go on with.
Scene shown_scene(const SceneState& state, const Configuration& q) {
  Scene scene = *state.scene;
  if (!scene.robots.empty()) {
    scene.robots.front().configuration = q;
  }
  return scene;
}

void refuse_clashes(const Scene& scene) {
  for (const geometric::SceneObject& object : scene.objects) {
    if (const std::string owner = owner_of_name(scene, object.name); !owner.empty()) {
      throw geometric::InputError(
          {"", "", "the object \"" + object.name + "\" and a link of that name of " + owner,
           "names that differ", "Give the object another name first"});
    }
  }
}

// With the hand basis that there was as long as the first robot has its joints, or else one of the
// library.
SceneState settled(const SceneState& before, Scene scene) {
  refuse_clashes(scene);
  SceneState next = before;
  const geometric::RobotModel& model = *scene.robots.front().model;
  const bool is_for_another = scene.hand_basis != before.scene->hand_basis;
  if (next.basis && (is_for_another || !has_all_joints(model, *next.basis))) {
    next.basis.reset();
    scene.hand_basis.clear();
  }
  if (!next.basis) {
    if (auto fitting = fitting_basis(model)) {
      scene.hand_basis = fitting->first;
      next.basis = std::make_shared<const sampling::PmdBasis>(std::move(fitting->second));
    }
  }
  next.scene = std::make_shared<const Scene>(std::move(scene));
  return next;
}

}  // namespace

std::optional<LinkOfRobot> carrier_of(const Scene& scene, const std::string& robot) {
  const RobotInstance* whole = geometric::find_robot_with_part(scene, robot);
  const RobotPart* part = whole ? find_part(*whole, robot) : nullptr;
  if (!part || part->carrier < 0) {
    return std::nullopt;
  }
  return LinkOfRobot{whole->parts[static_cast<std::size_t>(part->carrier)].name, part->link};
}

std::vector<LinkOfRobot> mounting_places(const Scene& scene, const std::string& robot) {
  std::vector<LinkOfRobot> places;
  for (const RobotInstance& whole : scene.robots) {
    const RobotPart* moved = find_part(whole, robot);
    if (whole.name == robot) {
      continue;
    }
    if (whole.parts.empty()) {
      for (const geometric::Link& link : whole.model->description().links) {
        places.push_back({whole.name, link.name});
      }
    }
    for (const RobotPart& part : whole.parts) {
      if (moved && is_on(whole, part, *moved)) {
        continue;
      }
      for (const geometric::Link& link : part.model->description().links) {
        places.push_back({part.name, link.name});
      }
    }
  }
  return places;
}

std::optional<LinkOfRobot> end_of_arm(const Scene& scene) {
  if (scene.robots.empty() || !scene.robots.front().parts.empty()) {
    return std::nullopt;
  }
  const RobotInstance& robot = scene.robots.front();
  const std::string tip = geometric::propose_groups(*robot.model).tip;
  return tip.empty() ? std::nullopt : std::optional(LinkOfRobot{robot.name, tip});
}

LinkOfRobot own_link(const Scene& scene, const std::string& robot, const std::string& link) {
  if (const RobotInstance* whole = geometric::find_robot(scene, robot)) {
    for (const RobotPart& part : whole->parts) {
      for (const auto& [own, composed] : part.links) {
        if (composed == link) {
          return {part.name, own};
        }
      }
    }
  }
  return {robot, link};
}

std::optional<Pose> base_pose(const Scene& scene, const Configuration& q,
                              const std::string& robot) {
  const RobotInstance* whole = geometric::find_robot_with_part(scene, robot);
  if (!whole) {
    return std::nullopt;
  }
  const RobotPart* part = find_part(*whole, robot);
  return part && part->carrier >= 0 ? link_pose(scene, q, whole->name, composed_base(*part))
                                    : std::optional(whole->X_WB);
}

Pose carrier_pose(const Scene& scene, const Configuration& q, const std::string& robot) {
  const std::optional<LinkOfRobot> on = carrier_of(scene, robot);
  if (!on) {
    return Pose::Identity();
  }
  const RobotInstance& whole = *geometric::find_robot_with_part(scene, robot);
  return *link_pose(scene, q, whole.name, find_part(whole, on->robot)->links.at(on->link));
}

std::optional<std::pair<std::string, sampling::PmdBasis>> fitting_basis(
    const geometric::RobotModel& model) {
  for (const std::string& name : geometric::resource_names(ResourceKind::kHandBasis)) {
    sampling::PmdBasis candidate = sampling::read_pmd_basis(
        geometric::find_resource(ResourceKind::kHandBasis, name, geometric::resource_dir()));
    if (has_all_joints(model, candidate)) {
      return std::pair(name, std::move(candidate));
    }
  }
  return std::nullopt;
}

SceneState with_robot(const SceneState& state, const Configuration& q, RobotInstance robot,
                      const std::optional<LinkOfRobot>& on, const Pose& X_LB) {
  Scene scene = shown_scene(state, q);
  const std::string name = robot.name;
  scene.robots.push_back(std::move(robot));
  if (on) {
    geometric::mount_robot(scene, name, on->robot, on->link, X_LB);
  }
  return settled(state, std::move(scene));
}

bool joins_robots(const Scene& scene, const std::vector<std::string>& group) {
  return std::ranges::any_of(group, [&](const std::string& name) {
    return geometric::named_variables(scene.robots.front(), name).empty();
  });
}

SceneState with_group(const SceneState& state, const Configuration& q,
                      const std::vector<std::string>& group) {
  const bool joins = joins_robots(*state.scene, group);
  Scene scene = joins ? shown_scene(state, q) : *state.scene;
  geometric::set_moving_group(scene, group);
  if (joins) {
    return settled(state, std::move(scene));
  }
  return {std::make_shared<const Scene>(std::move(scene)), state.basis};
}

SceneState with_mount(const SceneState& state, const Configuration& q, const std::string& robot,
                      const LinkOfRobot& on, const Pose& X_LB) {
  Scene scene = shown_scene(state, q);
  if (carrier_of(scene, robot)) {
    geometric::unmount_robot(scene, robot);
  }
  geometric::mount_robot(scene, robot, on.robot, on.link, X_LB);
  return settled(state, std::move(scene));
}

SceneState without_mount(const SceneState& state, const Configuration& q, const std::string& part) {
  Scene scene = shown_scene(state, q);
  geometric::unmount_robot(scene, part);
  return settled(state, std::move(scene));
}

SceneState with_mount_at(const SceneState& state, const Configuration& q, const std::string& part,
                         const Pose& X_WB) {
  const Pose X_WL = carrier_pose(*state.scene, q, part);
  Scene scene = shown_scene(state, q);
  geometric::move_mount(scene, part, X_WL.inverse() * X_WB);
  return settled(state, std::move(scene));
}

SceneState with_model(const SceneState& state, const Configuration& q, const std::string& robot,
                      const std::shared_ptr<const geometric::RobotModel>& model) {
  Scene scene = shown_scene(state, q);
  for (RobotInstance& whole : scene.robots) {
    const auto part = std::ranges::find(whole.parts, robot, &RobotPart::name);
    if (part != whole.parts.end()) {
      part->model = model;
      geometric::compose_parts(whole);
    } else if (whole.name == robot) {
      whole.model = model;
    }
  }
  return settled(state, std::move(scene));
}

SceneState without_robot(const SceneState& state, const Configuration& q,
                         const std::string& robot) {
  Scene scene = shown_scene(state, q);
  geometric::remove_robot(scene, robot);
  return settled(state, std::move(scene));
}

SceneState with_first_robot(const SceneState& state, const Configuration& q,
                            const std::string& robot) {
  Scene scene = shown_scene(state, q);
  geometric::put_first(scene, robot);
  return settled(state, std::move(scene));
}

}  // namespace handway::planning
