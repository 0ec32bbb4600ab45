#include "handway/geometric/setup/mounting.h"

#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/robot_state.h"
#include "handway/geometric/setup/collision_sampling.h"
#include "handway/geometric/setup/moving_group.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

constexpr int kSamples = 200;
constexpr std::uint64_t kSeed = 1;

// The parts of a robot; without parts, itself.
std::vector<RobotPart> parts_of(const RobotInstance& robot) {
  if (!robot.parts.empty()) {
    return robot.parts;
  }
  RobotPart part;
  part.name = robot.name;
  part.file = robot.file;
  part.model = robot.model;
  for (const Link& link : robot.model->description().links) {
    part.links[link.name] = link.name;
  }
  for (const Joint& joint : robot.model->description().joints) {
    part.joints[joint.name] = joint.name;
  }
  return {part};
}

/// Values of joints by part and own name, which stay when the composed names change.
using PartValues = std::map<std::pair<std::string, std::string>, double>;

PartValues values_of(const RobotInstance& robot, const Configuration& q) {
  PartValues values;
  for (const RobotPart& part : parts_of(robot)) {
    for (const auto& [own, composed] : part.joints) {
      if (const std::optional<int> variable = robot.model->find_variable(composed)) {
        values[{part.name, own}] = q[*variable];
      }
    }
  }
  return values;
}

Configuration configuration_of(const RobotInstance& robot, const PartValues& values) {
  Configuration q = robot.model->neutral();
  for (const RobotPart& part : parts_of(robot)) {
    for (const auto& [own, composed] : part.joints) {
      const auto value = values.find({part.name, own});
      const std::optional<int> variable = robot.model->find_variable(composed);
      if (variable && value != values.end()) {
        q[*variable] = value->second;
      }
    }
  }
  return q;
}

// By composed link.
std::map<std::string, const RobotPart*> part_of_links(const std::vector<RobotPart>& parts) {
  std::map<std::string, const RobotPart*> owners;
  for (const RobotPart& part : parts) {
    for (const auto& [own, composed] : part.links) {
      owners[composed] = &part;
    }
  }
  return owners;
}

// A mount, as the names of two parts, and the pairs of their links that overlap in every posture.
using OverlapsAtMounts =
    std::map<std::pair<std::string, std::string>, std::vector<AllowedCollisions::Pair>>;

void warn_of_overlaps(const OverlapsAtMounts& overlaps, RobotDescription& description) {
  for (const auto& [parts, pairs] : overlaps) {
    const auto& [a, b] = pairs.front();
    description.warnings.push_back(fmt::format(
        "{} and {} overlap in every posture, and are not checked: {} with {}{}. Look whether the "
        "pose of the mount is right",
        parts.first, parts.second, a, b,
        pairs.size() > 1 ? fmt::format(" and {} more", pairs.size() - 1) : ""));
  }
}

// Allows links of different parts only: each part has its own matrix already.
void allow_at_mounts(const std::vector<RobotPart>& parts, RobotDescription& description) {
  const auto owners = part_of_links(parts);
  const AllowedCollisions sampled =
      sample_overlapping_links(RobotModel(description), kSamples, kSeed);
  OverlapsAtMounts overlaps;
  for (const auto& [pair, reason] : sampled.entries()) {
    const RobotPart& first = *owners.at(pair.first);
    const RobotPart& second = *owners.at(pair.second);
    if (&first == &second || reason == AllowedReason::kDefault) {
      continue;
    }
    description.allowed_collisions.allow(pair.first, pair.second, reason);
    if (reason == AllowedReason::kAlways) {
      const bool in_order = &first < &second;
      overlaps[in_order ? std::pair(first.name, second.name) : std::pair(second.name, first.name)]
          .push_back(in_order ? pair : AllowedCollisions::Pair(pair.second, pair.first));
    }
  }
  warn_of_overlaps(overlaps, description);
}

/// Old and new names of links and joints in parts that both robots have.
struct Renaming {
  std::map<std::string, std::string> links;
  std::map<std::string, std::string> joints;

  Renaming(const RobotInstance& before, const RobotInstance& after) {
    const std::vector<RobotPart> parts = parts_of(after);
    for (const RobotPart& part : parts_of(before)) {
      const auto now = std::ranges::find(parts, part.name, &RobotPart::name);
      if (now == parts.end()) {
        continue;
      }
      for (const auto& [own, composed] : part.links) {
        links[composed] = now->links.at(own);
      }
      for (const auto& [own, composed] : part.joints) {
        joints[composed] = now->joints.at(own);
      }
    }
  }

  void rename_link(std::string& link) const {
    if (const auto found = links.find(link); found != links.end()) {
      link = found->second;
    }
  }
};

// Renames links in objects that are fixed to a link of `after`; other links can't touch them.
void rename_in_objects(Scene& scene, const RobotInstance& before, const RobotInstance& after) {
  const Renaming renaming(before, after);
  for (SceneObject& object : scene.objects) {
    if (object.attachment && object.attachment->robot == before.name &&
        renaming.links.contains(object.attachment->link)) {
      object.attachment->robot = after.name;
      std::erase_if(object.attachment->touching,
                    [&](const std::string& link) { return !renaming.links.contains(link); });
      renaming.rename_link(object.attachment->link);
      for (std::string& link : object.attachment->touching) {
        renaming.rename_link(link);
      }
    }
  }
}

// Renames links and joints in settings of the first robot. Settings of those that `after` lacks go.
void rename_in_query(Scene& scene, const RobotInstance& before, const RobotInstance& after) {
  const Renaming renaming(before, after);
  std::erase_if(scene.constraints, [&](const PathConstraint& constraint) {
    return !find_object(scene, constraint.body) && !renaming.links.contains(constraint.body);
  });
  for (std::string& name : scene.group) {
    if (const auto joint = renaming.joints.find(name); joint != renaming.joints.end()) {
      name = joint->second;
    }
  }
  std::erase_if(scene.group,
                [&](const std::string& name) { return named_variables(after, name).empty(); });
  for (PathConstraint& constraint : scene.constraints) {
    if (!find_object(scene, constraint.body)) {
      renaming.rename_link(constraint.body);
    }
  }
  std::erase_if(scene.goal_poses,
                [&](const PoseGoal& goal) { return !renaming.links.contains(goal.link); });
  for (PoseGoal& goal : scene.goal_poses) {
    renaming.rename_link(goal.link);
  }
  std::erase_if(scene.frames, [&](const NamedFrame& frame) {
    return !frame.parent.empty() && !find_object(scene, frame.parent) &&
           !renaming.links.contains(frame.parent);
  });
  for (NamedFrame& frame : scene.frames) {
    if (!frame.parent.empty() && !find_object(scene, frame.parent)) {
      renaming.rename_link(frame.parent);
    }
  }
  for (NamedPosture& posture : scene.postures) {
    std::map<std::string, double> values;
    for (const auto& [joint, value] : posture.values) {
      if (const auto now = renaming.joints.find(joint); now != renaming.joints.end()) {
        values[now->second] = value;
      }
    }
    posture.values = std::move(values);
  }
  std::erase_if(scene.postures, [](const NamedPosture& posture) { return posture.values.empty(); });
}

/// A link of a part, by the part's own name.
using LinkOfPart = std::pair<std::string, std::string>;

// Returns links by their names in Scene::allowed_collisions: those of the first robot by their
// names alone.
std::map<std::string, LinkOfPart> links_by_body(const Scene& scene) {
  std::map<std::string, LinkOfPart> links;
  for (const RobotInstance& robot : scene.robots) {
    const bool is_first = &robot == &scene.robots.front();
    for (const RobotPart& part : parts_of(robot)) {
      for (const auto& [own, composed] : part.links) {
        links[is_first ? composed : robot.name + "/" + composed] = {part.name, own};
      }
    }
  }
  return links;
}

// Transfers the checked pairs, with the links' names in the present robots; pairs of removed links
// are dropped.
void keep_collisions(const Scene& before, Scene& scene) {
  const std::map<std::string, LinkOfPart> old_links = links_by_body(before);
  std::map<LinkOfPart, std::string> bodies;
  for (const auto& [body, link] : links_by_body(scene)) {
    bodies[link] = body;
  }
  const auto name_now = [&](const std::string& body) -> std::optional<std::string> {
    const auto link = old_links.find(body);
    if (link == old_links.end()) {
      return body;  // an object
    }
    const auto now = bodies.find(link->second);
    return now == bodies.end() ? std::nullopt : std::optional(now->second);
  };
  scene.allowed_collisions.clear();
  for (const auto& [pair, touch] : before.allowed_collisions) {
    const auto a = name_now(pair.first);
    const auto b = name_now(pair.second);
    if (a && b) {
      scene.allowed_collisions[std::minmax(*a, *b)] = touch;
    }
  }
}

void keep_paddings(const Scene& before, Scene& scene) {
  std::map<LinkOfPart, Padding> paddings;
  const auto each_link = [](const RobotInstance& robot, const auto& visit) {
    for (const RobotPart& part : parts_of(robot)) {
      for (const auto& [own, composed] : part.links) {
        visit(LinkOfPart(part.name, own), composed);
      }
    }
  };
  for (const RobotInstance& robot : before.robots) {
    each_link(robot, [&](const LinkOfPart& link, const std::string& composed) {
      if (const auto found = robot.padding.find(composed); found != robot.padding.end()) {
        paddings[link] = found->second;
      }
    });
  }
  for (RobotInstance& robot : scene.robots) {
    robot.padding.clear();
    each_link(robot, [&](const LinkOfPart& link, const std::string& composed) {
      if (const auto found = paddings.find(link); found != paddings.end()) {
        robot.padding[composed] = found->second;
      }
    });
  }
}

// Transfers settings of links by the names that they had before.
void keep_said_of_links(const Scene& before, Scene& scene) {
  keep_collisions(before, scene);
  keep_paddings(before, scene);
}

std::size_t needed_robot(const Scene& scene, const RobotInstance* found, const std::string& name) {
  if (found == nullptr) {
    throw InputError({scene.file.string(), "robots", "no robot \"" + name + "\"",
                      "the name of a robot of the scene", ""});
  }
  return static_cast<std::size_t>(found - scene.robots.data());
}

RobotInstance mounted(const RobotInstance& carrier, const std::string& part,
                      const std::string& link, const RobotInstance& robot, const Pose& X_LB) {
  RobotInstance whole = carrier;
  whole.parts = parts_of(carrier);
  const auto on = std::ranges::find(whole.parts, part, &RobotPart::name) - whole.parts.begin();
  const auto first = static_cast<int>(whole.parts.size());
  for (RobotPart& added : parts_of(robot)) {
    added.carrier = added.carrier < 0 ? static_cast<int>(on) : added.carrier + first;
    whole.parts.push_back(std::move(added));
  }
  whole.parts[static_cast<std::size_t>(first)].link = link;
  whole.parts[static_cast<std::size_t>(first)].X_LB = X_LB;
  compose_parts(whole);
  PartValues values = values_of(carrier, carrier.configuration);
  values.merge(values_of(robot, robot.configuration));
  whole.configuration = configuration_of(whole, values);
  return whole;
}

// Some parts of a robot as a robot of their own, without the parts that carry them.
// @pre the first of `parts` carries all others of them.
RobotInstance of_parts(const RobotInstance& whole, const std::vector<std::size_t>& parts) {
  const RobotPart& first = whole.parts[parts.front()];
  RobotInstance robot;
  robot.name = first.name;
  robot.file = first.file;
  robot.model = first.model;
  std::map<int, int> place_of{{first.carrier, -1}};
  for (const std::size_t index : parts) {
    RobotPart part = whole.parts[index];
    place_of[static_cast<int>(index)] = static_cast<int>(robot.parts.size());
    part.carrier = robot.parts.empty() ? -1 : place_of.at(part.carrier);
    robot.parts.push_back(std::move(part));
  }
  robot.parts.front().link.clear();
  robot.parts.front().X_LB = Pose::Identity();
  robot.configuration = robot.model->neutral();
  if (robot.parts.size() == 1) {
    robot.parts.clear();
  } else {
    compose_parts(robot);
  }
  robot.configuration = configuration_of(robot, values_of(whole, whole.configuration));
  return robot;
}

/// A robot in two: the rest, and a part with all that it carries.
struct Split {
  std::size_t index = 0;  ///< In the scene.
  RobotInstance rest;
  RobotInstance off;
};

Split split(const Scene& scene, const std::string& part) {
  Split split;
  split.index = needed_robot(scene, find_robot_with_part(scene, part), part);
  const RobotInstance& whole = scene.robots[split.index];
  const auto found = std::ranges::find(whole.parts, part, &RobotPart::name);
  if (found == whole.parts.end() || found->carrier < 0) {
    throw InputError({scene.file.string(), "robot " + part, "a robot that is not mounted",
                      "one that another robot carries", ""});
  }
  const auto root = static_cast<std::size_t>(found - whole.parts.begin());
  std::vector<std::size_t> kept{0}, taken{root};
  for (std::size_t i = 1; i < whole.parts.size(); ++i) {
    const auto carrier = static_cast<std::size_t>(whole.parts[i].carrier);
    if (i != root) {
      (std::ranges::count(taken, carrier) > 0 ? taken : kept).push_back(i);
    }
  }
  split.rest = of_parts(whole, kept);
  split.rest.X_WB = whole.X_WB;
  split.off = of_parts(whole, taken);
  RobotState state(whole.model);
  state.set_configuration(whole.configuration);
  const std::string base = found->links.at(found->model->link(0).name);
  split.off.X_WB = whole.X_WB * state.link_pose(*whole.model->find_link(base));
  return split;
}

// Continues the first robot's settings with `after`, which has a part of it.
void go_on_with(Scene& scene, const RobotInstance& before, const RobotInstance& after) {
  for (std::optional<Configuration>* q : {&scene.start, &scene.goal}) {
    if (*q) {
      *q = configuration_of(after, values_of(before, **q));
    }
  }
  rename_in_query(scene, before, after);
}

// Objects on the robot stay in place, fixed to the world.
void release_objects(Scene& scene, const RobotInstance& robot) {
  RobotState state(robot.model);
  state.set_configuration(robot.configuration);
  for (SceneObject& object : scene.objects) {
    if (is_carried_by(object, robot)) {
      object.X_PO = robot.X_WB * state.link_pose(*robot.model->find_link(object.attachment->link)) *
                    object.X_PO;
      object.attachment.reset();
    }
  }
}

// Removes start, goal and all other settings of the first robot.
void forget_query(Scene& scene) {
  scene.start.reset();
  scene.goal.reset();
  scene.goal_poses.clear();
  scene.group.clear();
  scene.constraints.clear();
  scene.postures.clear();
  scene.hand_basis.clear();
  std::erase_if(scene.frames, [&](const NamedFrame& frame) {
    return !frame.parent.empty() && !find_object(scene, frame.parent);
  });
}

}  // namespace

void compose_parts(RobotInstance& robot) {
  const PartValues before = robot.model ? values_of(robot, robot.configuration) : PartValues();
  robot.parts.front().name = robot.name;
  RobotDescription description = compose_robots(robot.parts);
  allow_at_mounts(robot.parts, description);
  robot.model = std::make_shared<const RobotModel>(std::move(description));
  robot.configuration = configuration_of(robot, before);
}

void mount_robot(Scene& scene, const std::string& robot, const std::string& carrier,
                 const std::string& link, const Pose& X_LB) {
  const std::size_t added = needed_robot(scene, find_robot(scene, robot), robot);
  const std::size_t onto = needed_robot(scene, find_robot_with_part(scene, carrier), carrier);
  if (added == onto) {
    throw InputError({scene.file.string(), "robot " + robot, "a mount on " + carrier,
                      "another robot: " + robot + " carries " + carrier + " already", ""});
  }
  const Scene old_scene = scene;
  const RobotInstance& alone = old_scene.robots[added];
  const RobotInstance& before = old_scene.robots[onto];
  const RobotInstance whole = mounted(before, carrier, link, alone, X_LB);
  rename_in_objects(scene, before, whole);
  rename_in_objects(scene, alone, whole);
  if (std::min(added, onto) == 0) {
    const RobotInstance& first = old_scene.robots.front();
    const RobotInstance& other = added == 0 ? before : alone;
    for (std::optional<Configuration>* q : {&scene.start, &scene.goal}) {
      if (*q) {
        PartValues values = values_of(first, **q);
        values.merge(values_of(other, other.configuration));
        *q = configuration_of(whole, values);
      }
    }
    rename_in_query(scene, first, whole);
  }
  scene.robots[std::min(added, onto)] = whole;
  scene.robots.erase(scene.robots.begin() + static_cast<std::ptrdiff_t>(std::max(added, onto)));
  keep_said_of_links(old_scene, scene);
}

void move_mount(Scene& scene, const std::string& part, const Pose& X_LB) {
  const RobotInstance* found = find_robot_with_part(scene, part);
  RobotInstance& robot = scene.robots[needed_robot(scene, found, part)];
  const auto moved = std::ranges::find(robot.parts, part, &RobotPart::name);
  if (moved == robot.parts.end() || moved->carrier < 0) {
    throw InputError({scene.file.string(), "robot " + part, "a robot that is not mounted",
                      "one that another robot carries", ""});
  }
  moved->X_LB = X_LB;
  compose_parts(robot);
}

void unmount_robot(Scene& scene, const std::string& part) {
  const Split parts = split(scene, part);
  const Scene old_scene = scene;
  const RobotInstance& before = old_scene.robots[parts.index];
  scene.robots[parts.index] = parts.rest;
  scene.robots.insert(scene.robots.begin() + static_cast<std::ptrdiff_t>(parts.index) + 1,
                      parts.off);
  if (parts.index == 0) {
    go_on_with(scene, before, parts.rest);
  }
  rename_in_objects(scene, before, parts.off);
  rename_in_objects(scene, before, parts.rest);
  keep_said_of_links(old_scene, scene);
}

void remove_robot(Scene& scene, const std::string& name) {
  const RobotInstance* robot = find_robot(scene, name);
  if (robot == nullptr) {
    unmount_robot(scene, name);
    robot = find_robot(scene, name);
  }
  const Scene old_scene = scene;
  const auto index = needed_robot(scene, robot, name);
  release_objects(scene, *robot);
  scene.robots.erase(scene.robots.begin() + static_cast<std::ptrdiff_t>(index));
  if (index == 0) {
    forget_query(scene);
  }
  keep_said_of_links(old_scene, scene);
}

void put_first(Scene& scene, const std::string& name) {
  const Scene old_scene = scene;
  const auto first = scene.robots.begin() + static_cast<std::ptrdiff_t>(
                                                needed_robot(scene, find_robot(scene, name), name));
  std::rotate(scene.robots.begin(), first, first + 1);
  forget_query(scene);
  keep_said_of_links(old_scene, scene);
}

}  // namespace handway::geometric
