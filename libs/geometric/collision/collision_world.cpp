#include "handway/geometric/collision/collision_world.h"

#include "collision/volumes/solid.h"
#include "handway/geometric/io/input_error.h"
#include "math/pose_columns.h"
#include "math/vector_units.h"

#include <algorithm>
#include <filesystem>
#include <span>
#include <utility>

namespace handway::geometric {
namespace {

constexpr double kNear = 1.0;  // m: single precision resolves a tenth of a micrometre there

void refuse_if_far(const Eigen::Vector3d& p, const std::filesystem::path& file,
                   const std::string& element) {
  if (!(p.lpNorm<Eigen::Infinity>() <= kFarthestPoint)) {
    throw InputError({file.string(), element,
                      "a point that is farther than 1000 km from the origin",
                      "coordinates in metres, up to 1000 km",
                      "Move the scene to the origin, or check the units"});
  }
}

// Returns the solids in a frame with its origin at `p`.
std::shared_ptr<const BodySolids> with_origin_at(const Eigen::Vector3d& p,
                                                 const BodySolids& solids) {
  auto moved = std::make_shared<BodySolids>(solids);
  for (std::vector<BodySolids::Part>* list : {&moved->parts, &moved->shells}) {
    for (BodySolids::Part& part : *list) {
      part.X_GB = part.X_GB * Eigen::Translation3d(p);
    }
  }
  for (Eigen::Vector3d& point : moved->points) {
    point -= p;
  }
  moved->box = {solids.box.lower - p, solids.box.upper - p};
  return moved;
}

// Single precision, used in many places, has enough digits for coordinates that are no larger than
// the mesh: if its frame is far away, the body gets a frame in the middle of the mesh.
CollisionBody centred(CollisionBody body, const std::filesystem::path& file) {
  const Aabb box = bounding_box(*body.mesh);
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(body.X_FB.translation()), box.lower, box.upper}) {
    refuse_if_far(p, file, body.name);
  }
  const double apart = box.centre().lpNorm<Eigen::Infinity>();
  if (apart > kNear && apart > box.size().maxCoeff()) {
    body.centre = box.centre();
    body.X_FB = body.X_FB * Eigen::Translation3d(body.centre);
    body.mesh = std::make_shared<const TriangleMesh>(
        transformed(*body.mesh, Pose(Eigen::Translation3d(-body.centre))));
    body.solids = with_origin_at(body.centre, *body.solids);
  }
  return body;
}

std::vector<LinkGeometry> scaled_shapes(std::span<const LinkGeometry> shapes, double scale) {
  std::vector<LinkGeometry> larger(shapes.begin(), shapes.end());
  for (LinkGeometry& geometry : larger) {
    geometry.shape = scaled(geometry.shape, scale);
  }
  return larger;
}

CollisionBody body_of(const SceneObject& object) {
  CollisionBody body{object.name, -1, object.X_PO, tessellate(object.shape)};
  const LinkGeometry shape{object.shape, Pose::Identity(), object.color};
  body.solids = make_body_solids({&shape, 1}, object.solid);
  return body;
}

}  // namespace

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
  for (const RobotInstance& robot : scene.robots) {
    refuse_if_far(robot.X_WB.translation(), scene.file, "robot " + robot.name);
    for (const Joint& joint : robot.model->description().joints) {
      refuse_if_far(joint.X_PJ.translation(), robot.file, "joint " + joint.name);
    }
  }
  model_ = scene.robots.front().model;
  X_WB_ = scene.robots.front().X_WB;
  allowed_collisions_ = scene.allowed_collisions;
  add_robot_links(scene.robots.front());
  for (std::size_t i = 1; i < scene.robots.size(); ++i) {
    add_still_robot(scene.robots[i]);
  }
  add_objects(scene);
  list_pairs();
  add_constraints(scene);
}

void CollisionWorld::add_constraints(const Scene& scene) {
  for (const PathConstraint& constraint : scene.constraints) {
    constraints_.emplace_back(constraint, scene);
  }
}

void CollisionWorld::add(CollisionBody body, const std::filesystem::path& file) {
  if (!body.mesh->empty()) {
    bodies_.push_back(centred(std::move(body), file));
  }
}

void CollisionWorld::add_padded(CollisionBody body, std::span<const LinkGeometry> shapes,
                                const Padding& padding, bool solid,
                                const std::filesystem::path& file) {
  body.padding = padding.distance;
  add(body, file);
  if (padding.scale == 1.0) {
    return;
  }
  Link larger;
  larger.collision = scaled_shapes(shapes, padding.scale);
  body.mesh = std::make_shared<TriangleMesh>(collision_mesh(larger));
  body.solids = make_body_solids(larger.collision, solid);
  body.is_scaled_copy = true;
  add(std::move(body), file);
}

void CollisionWorld::add_robot_links(const RobotInstance& robot) {
  for (int i = 0; i < robot.model->link_count(); ++i) {
    const Link& link = robot.model->link(i);
    CollisionBody body{link.name, i, Pose::Identity(),
                       std::make_shared<TriangleMesh>(collision_mesh(link))};
    body.solids = make_body_solids(link.collision);
    if (const auto padding = robot.padding.find(link.name); padding != robot.padding.end()) {
      add_padded(std::move(body), link.collision, padding->second, true, robot.file);
    } else {
      add(std::move(body), robot.file);
    }
  }
}

void CollisionWorld::add_still_robot(const RobotInstance& robot) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(robot.model->link_count()));
  robot.model->forward_kinematics(robot.configuration, X_BL);
  for (int i = 0; i < robot.model->link_count(); ++i) {
    Link link = robot.model->link(i);
    const auto found = robot.padding.find(link.name);
    const Padding padding = found == robot.padding.end() ? Padding() : found->second;
    if (padding.scale != 1.0) {
      link.collision = scaled_shapes(link.collision, padding.scale);
    }
    CollisionBody body{robot.name + "/" + link.name, -1,
                       robot.X_WB * X_BL[static_cast<std::size_t>(i)],
                       std::make_shared<TriangleMesh>(collision_mesh(link))};
    body.solids = make_body_solids(link.collision);
    body.padding = padding.distance;
    add(std::move(body), robot.file);
  }
}

void CollisionWorld::add_objects(const Scene& scene) {
  for (const SceneObject& object : scene.objects) {
    CollisionBody body = body_of(object);
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
        body.touching = object.attachment->touching;
        const auto padding = robot->padding.find(object.attachment->link);
        if (padding != robot->padding.end()) {
          const LinkGeometry shape{object.shape, Pose::Identity(), object.color};
          add_padded(std::move(body), {&shape, 1}, padding->second, object.solid, scene.file);
          continue;
        }
      } else {
        std::vector<Pose> X_BL(static_cast<std::size_t>(robot->model->link_count()));
        robot->model->forward_kinematics(robot->configuration, X_BL);
        body.X_FB = robot->X_WB * X_BL[static_cast<std::size_t>(*link)] * object.X_PO;
      }
    }
    add(std::move(body), scene.file);
  }
}

bool CollisionWorld::must_not_touch(int a, int b) const {
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
  const auto said = allowed_collisions_.find(std::minmax(first.name, second.name));
  if (said != allowed_collisions_.end()) {
    return !said->second;
  }
  for (const auto& [carried, other] : {std::pair(&first, &second), std::pair(&second, &first)}) {
    if (std::ranges::count(carried->touching, other->name) > 0) {
      return false;
    }
  }
  return !second.moves() ||
         !model_->description().allowed_collisions.reason(first.name, second.name);
}

void CollisionWorld::list_pairs() {
  pairs_.clear();
  moving_.clear();
  const int count = static_cast<int>(bodies_.size());
  // A body that is followed by a scaled copy is checked against moving bodies, the copy against
  // fixed ones.
  const auto is_checked_against = [&](int index, bool still) {
    const bool has_copy = index + 1 < count && body(index + 1).is_scaled_copy;
    return still ? !has_copy : !body(index).is_scaled_copy;
  };
  for (int i = 0; i < count; ++i) {
    if (body(i).moves()) {
      moving_.push_back(i);
    }
  }
  for (const bool still : {false, true}) {
    for (const int a : moving_) {
      for (int b = 0; b < count; ++b) {
        const bool candidate = body(b).moves() != still && (still || a < b);
        if (candidate && is_checked_against(a, still) && is_checked_against(b, still) &&
            must_not_touch(a, b)) {
          pairs_.push_back({a, b});
        }
      }
    }
  }
  list_paddings();
}

void CollisionWorld::list_paddings() {
  paddings_.clear();
  for (const auto& [a, b] : pairs_) {
    paddings_.push_back(body(b).moves() ? 0.0 : body(a).padding + body(b).padding);
  }
  if (std::ranges::all_of(paddings_, [](double padding) { return padding == 0.0; })) {
    paddings_.clear();
  }
}

std::vector<CollisionBody>::const_iterator CollisionWorld::find_still_body(
    std::string_view name) const {
  return std::ranges::find_if(bodies_, [&](const CollisionBody& candidate) {
    return !candidate.moves() && candidate.name == name;
  });
}

std::vector<CollisionBody>::const_iterator CollisionWorld::needed_still_body(
    std::string_view name) const {
  const auto found = find_still_body(name);
  if (found == bodies_.end()) {
    throw InputError({"scene", "object " + std::string(name), "no object that stands still",
                      "the name of one", "A carried object moves with its link"});
  }
  return found;
}

CollisionWorld CollisionWorld::with_object_at(std::string_view name, const Pose& X_WO) const {
  const auto index = static_cast<std::size_t>(needed_still_body(name) - bodies_.begin());
  CollisionWorld changed = *this;
  CollisionBody& body = changed.bodies_[index];
  refuse_if_far(X_WO.translation(), "scene", "object " + body.name);
  body.X_FB = X_WO * Eigen::Translation3d(body.centre);
  return changed;
}

CollisionWorld CollisionWorld::with_object(const SceneObject& object) const {
  if (object.attachment || find_still_body(object.name) != bodies_.end()) {
    throw InputError({"scene", "object " + object.name,
                      object.attachment ? "an attachment" : "a name that is taken",
                      "a new object that stands still", ""});
  }
  CollisionWorld changed = *this;
  CollisionBody body = body_of(object);
  if (!body.mesh->empty()) {
    changed.bodies_.push_back(centred(std::move(body), "scene"));
    changed.list_pairs();
  }
  return changed;
}

CollisionWorld CollisionWorld::without_object(std::string_view name) const {
  const auto index = needed_still_body(name) - bodies_.begin();
  CollisionWorld changed = *this;
  changed.bodies_.erase(changed.bodies_.begin() + index);
  changed.list_pairs();
  return changed;
}

CollisionWorld CollisionWorld::with_change(const ObjectChange& change) const {
  switch (change.kind) {
    case ObjectChange::Kind::kRemoved:
      return without_object(change.object.name);
    case ObjectChange::Kind::kAdded:
      return with_object(change.object);
    default:
      return with_object_at(change.object.name, change.object.X_PO);
  }
}

CollisionWorld CollisionWorld::with_constraints_of(const Scene& scene) const {
  CollisionWorld changed = *this;
  changed.constraints_.clear();
  changed.add_constraints(scene);
  return changed;
}

PairIndices CollisionWorld::pairs_with(std::string_view still_body) const {
  const auto index = static_cast<int>(find_still_body(still_body) - bodies_.begin());
  PairIndices pairs;
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    if (pairs_[p].b == index) {
      pairs.push_back(static_cast<int>(p));
    }
  }
  return pairs;
}

void CollisionWorld::place(const Configuration& q, std::vector<Pose>& X_BL,
                           std::vector<Pose>& X_WBody) const {
  std::ranges::transform(bodies_, X_WBody.begin(), &CollisionBody::X_FB);
  place_moving(q, X_BL, X_WBody);
}

namespace {

// Sets the poses of the moving bodies from those of their links.
HANDWAY_VECTOR_UNITS void place_on_links(std::span<const CollisionBody> bodies,
                                         std::span<const int> moving, const Pose& X_WB,
                                         std::span<const Pose> X_BL, std::span<Pose> X_WBody) {
  const PoseColumns base(X_WB);
  for (const int index : moving) {
    const CollisionBody& body = bodies[static_cast<std::size_t>(index)];
    PoseColumns X = base;
    X.multiply(X_BL[static_cast<std::size_t>(body.link)]);
    if (body.is_carried || !body.centre.isZero(0.0)) {
      X.multiply(body.X_FB);
    }
    X.store(X_WBody[static_cast<std::size_t>(index)]);
  }
}

}  // namespace

void CollisionWorld::place_moving(const Configuration& q, std::vector<Pose>& X_BL,
                                  std::vector<Pose>& X_WBody) const {
  model_->forward_kinematics(q, X_BL);
  place_on_links(bodies_, moving_, X_WB_, X_BL, X_WBody);
}

}  // namespace handway::geometric
