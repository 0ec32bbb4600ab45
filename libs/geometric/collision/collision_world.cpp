#include "handway/geometric/collision/collision_world.h"

#include "handway/geometric/io/input_error.h"

#include <algorithm>

namespace handway::geometric {

TriangleMesh collision_mesh(const Link& link) {
  TriangleMesh whole;
  for (const LinkGeometry& geometry : link.collision) {
    append(whole, transformed(*tessellate(geometry.shape), geometry.X_LG));
  }
  return whole;
}

CollisionWorld::CollisionWorld(const Scene& scene) {
  if (scene.robots.empty()) {
    throw InputError({scene.file.string(), "robot", "a scene without a robot", "at least one", ""});
  }
  model_ = scene.robots.front().model;
  X_WB_ = scene.robots.front().X_WB;
  add_robot_links(scene.robots.front());
  for (std::size_t i = 1; i < scene.robots.size(); ++i) {
    add_still_robot(scene.robots[i]);
  }
  add_objects(scene);
  list_pairs(scene);
}

void CollisionWorld::add_robot_links(const RobotInstance& robot) {
  for (int i = 0; i < robot.model->link_count(); ++i) {
    auto mesh = std::make_shared<TriangleMesh>(collision_mesh(robot.model->link(i)));
    if (!mesh->empty()) {
      bodies_.push_back({robot.model->link(i).name, i, Pose::Identity(), std::move(mesh)});
    }
  }
}

void CollisionWorld::add_still_robot(const RobotInstance& robot) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(robot.model->link_count()));
  robot.model->forward_kinematics(robot.configuration, X_BL);
  for (int i = 0; i < robot.model->link_count(); ++i) {
    auto mesh = std::make_shared<TriangleMesh>(collision_mesh(robot.model->link(i)));
    if (!mesh->empty()) {
      bodies_.push_back({robot.name + "/" + robot.model->link(i).name, -1,
                         robot.X_WB * X_BL[static_cast<std::size_t>(i)], std::move(mesh)});
    }
  }
}

void CollisionWorld::add_objects(const Scene& scene) {
  for (const SceneObject& object : scene.objects) {
    CollisionBody body{object.name, -1, object.X_PO, tessellate(object.shape)};
    if (object.attachment) {
      const RobotInstance* robot = find_robot(scene, object.attachment->robot);
      const std::optional<int> link =
          robot ? robot->model->find_link(object.attachment->link) : std::nullopt;
      if (!link) {
        throw InputError(
            {scene.file.string(), "object " + object.name,
             "an attachment to " + object.attachment->robot + "/" + object.attachment->link,
             "a robot of the scene and one of its links", ""});
      }
      if (robot == &scene.robots.front()) {
        body.link = *link;
        body.is_carried = true;
      } else {
        std::vector<Pose> X_BL(static_cast<std::size_t>(robot->model->link_count()));
        robot->model->forward_kinematics(robot->configuration, X_BL);
        body.X_FB = robot->X_WB * X_BL[static_cast<std::size_t>(*link)] * object.X_PO;
      }
    }
    if (!body.mesh->empty()) {
      bodies_.push_back(std::move(body));
    }
  }
}

bool CollisionWorld::must_not_touch(const Scene& scene, int a, int b) const {
  const CollisionBody& first = body(a);
  const CollisionBody& second = body(b);
  const int other_link = second.moves() ? second.link : 0;  // still bodies stand like the root
  bool moving = false;
  for (int v = 0; v < model_->variable_count() && !moving; ++v) {
    moving = model_->moves_between(v, first.link, other_link);
  }
  if (!moving) {
    return false;
  }
  for (const auto& [carried, other] : {std::pair(&first, &second), std::pair(&second, &first)}) {
    const SceneObject* object = find_object(scene, carried->name);
    if (object && object->attachment && carried->moves() &&
        std::ranges::count(object->attachment->touching, other->name) > 0) {
      return false;
    }
  }
  return !second.moves() ||
         !model_->description().allowed_collisions.reason(first.name, second.name);
}

void CollisionWorld::list_pairs(const Scene& scene) {
  const int count = static_cast<int>(bodies_.size());
  for (const bool still : {false, true}) {
    for (int a = 0; a < count; ++a) {
      for (int b = 0; b < count; ++b) {
        const bool candidate = body(a).moves() && body(b).moves() != still && (still || a < b);
        if (candidate && must_not_touch(scene, a, b)) {
          pairs_.push_back({a, b});
        }
      }
    }
  }
}

void CollisionWorld::place(const Configuration& q, std::vector<Pose>& X_BL,
                           std::vector<Pose>& X_WBody) const {
  model_->forward_kinematics(q, X_BL);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const CollisionBody& body = bodies_[i];
    if (!body.moves()) {
      X_WBody[i] = body.X_FB;
      continue;
    }
    X_WBody[i] = X_WB_ * X_BL[static_cast<std::size_t>(body.link)];
    if (body.is_carried) {
      X_WBody[i] = X_WBody[i] * body.X_FB;
    }
  }
}

}  // namespace handway::geometric
