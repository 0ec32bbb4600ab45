#include "view3d/scene_bodies.h"

#include "handway/geometric/scene/scene_difference.h"
#include "view3d/body_meshes.h"
#include "view3d/coin_conversions.h"
#include "view3d/robot_node.h"
#include "view3d/shape_node.h"

#include <Inventor/SbPlane.h>
#include <Inventor/SoPath.h>
#include <Inventor/actions/SoGetBoundingBoxAction.h>
#include <Inventor/nodes/SoClipPlane.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoMatrixTransform.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShapeHints.h>
#include <Inventor/nodes/SoSwitch.h>

#include <algorithm>
#include <utility>

namespace handway::gui {

using geometric::Configuration;
using geometric::Pose;

namespace {

constexpr float kLarge = 0.5F;  // m: diagonal of what is furniture

CoinRef<SoSeparator> make_looks(const geometric::SceneObject& object) {
  auto looks = make_coin<SoSeparator>();
  looks->renderCaching = SoSeparator::OFF;
  looks->addChild(make_material(object.color).get());
  looks->addChild(make_shape_node(object.shape).get());
  return looks;
}

// Makes a section plane, off at first. Cut objects are seen from inside.
CoinRef<SoSwitch> make_section() {
  auto section = make_coin<SoSwitch>();
  section->addChild(new SoClipPlane);
  auto* hints = new SoShapeHints;
  hints->vertexOrdering = SoShapeHints::COUNTERCLOCKWISE;
  hints->shapeType = SoShapeHints::UNKNOWN_SHAPE_TYPE;
  hints->setOverride(TRUE);
  section->addChild(hints);
  return section;
}

// The root link of a robot, or of a part that is mounted on it.
std::optional<int> base_link(const geometric::RobotInstance& robot, const std::string& name) {
  const auto part = std::ranges::find(robot.parts, name, &geometric::RobotPart::name);
  if (part != robot.parts.end()) {
    return robot.model->find_link(part->links.at(part->model->link(0).name));
  }
  return robot.name == name ? std::optional(0) : std::nullopt;
}

}  // namespace

StillSplit::StillSplit(CoinRef<SoSeparator> still, CoinRef<SoSeparator> moving)
    : still_(std::move(still)), moving_(std::move(moving)), first_(still_->getNumChildren()) {}

void StillSplit::begin(const RobotNode& robot) {
  X_WL_.assign(robot.link_poses().begin(), robot.link_poses().end());
  has_moved_.assign(X_WL_.size(), false);
}

bool StillSplit::note_motion(const RobotNode& robot) {
  if (X_WL_.size() != robot.link_poses().size()) {
    begin(robot);
    return true;
  }
  bool more = false;
  for (std::size_t i = 0; i < X_WL_.size(); ++i) {
    if (!has_moved_[i] && X_WL_[i].matrix() != robot.link_poses()[i].matrix()) {
      has_moved_[i] = true;
      more = true;
    }
  }
  return more;
}

bool StillSplit::moves(int link) const {
  const auto index = static_cast<std::size_t>(link);
  return index < has_moved_.size() && has_moved_[index];
}

void StillSplit::list(const RobotNode* robot, std::span<SoNode* const> still,
                      std::span<SoNode* const> moving) {
  for (SoSeparator* root : {still_.get(), moving_.get()}) {
    while (root->getNumChildren() > first_) {
      root->removeChild(root->getNumChildren() - 1);
    }
  }
  if (robot) {
    for (int i = 0; i < robot->model().link_count(); ++i) {
      (moves(i) ? moving_ : still_)->addChild(robot->link_root(i));
    }
  }
  for (SoNode* node : still) {
    still_->addChild(node);
  }
  for (SoNode* node : moving) {
    moving_->addChild(node);
  }
}

std::vector<SoNode*> StillSplit::still_bodies() const {
  std::vector<SoNode*> bodies;
  for (int i = first_; i < still_->getNumChildren(); ++i) {
    bodies.push_back(still_->getChild(i));
  }
  return bodies;
}

ObjectNode::ObjectNode(const geometric::SceneObject& object)
    : name_(object.name),
      shape_(object.shape),
      color_(object.color),
      root_(make_coin<SoSeparator>()),
      drawing_(make_looks(object), object.color),
      section_(make_coin<SoGroup>()),
      transform_(make_coin<SoMatrixTransform>()),
      look_(make_coin<SoSwitch>()) {
  root_->renderCaching = SoSeparator::OFF;
  look_->addChild(make_look_material(Look::kColliding, object.color).get());
  root_->addChild(section_.get());
  root_->addChild(transform_.get());
  root_->addChild(look_.get());
  root_->addChild(drawing_.get());
  place(object.X_PO);
}

ObjectNode::~ObjectNode() = default;

bool ObjectNode::draws(const geometric::SceneObject& object) const {
  return name_ == object.name && color_ == object.color && same_shape(shape_, object.shape);
}

void ObjectNode::place(const geometric::Pose& X_WO) { transform_->matrix = to_coin(X_WO); }

bool ObjectNode::is_large() const {
  SoGetBoundingBoxAction around{SbViewportRegion()};
  around.apply(drawing_.get());
  const SbBox3f box = around.getBoundingBox();
  return !box.isEmpty() && (box.getMax() - box.getMin()).length() > kLarge;
}

bool ObjectNode::set_look(Look look) {
  const int child = look == Look::kPlain ? SO_SWITCH_NONE : 0;
  if (look_->whichChild.getValue() == child) {
    return false;
  }
  look_->whichChild = child;
  return true;
}

void ObjectNode::cut_by(SoNode* section) {
  section_->removeAllChildren();
  if (section) {
    section_->addChild(section);
  }
}

SceneBodies::SceneBodies() : section_(make_section()) {}
SceneBodies::~SceneBodies() = default;

void SceneBodies::show(std::shared_ptr<const geometric::Scene> scene) {
  scene_ = std::move(scene);
  robots_.clear();
  objects_.clear();
  shapes_.clear();
  q_ = {};
  if (!scene_) {
    return;
  }
  for (const geometric::RobotInstance& robot : scene_->robots) {
    shapes_.push_back(make_link_shapes(*robot.model));
    robots_.push_back(std::make_unique<RobotNode>(robot.model, shapes_.back()));
    robots_.back()->place(robot.X_WB, robot.configuration);
  }
  make_objects();
}

void SceneBodies::update(std::shared_ptr<const geometric::Scene> scene) {
  scene_ = std::move(scene);
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    robots_[i]->place(scene_->robots[i].X_WB, scene_->robots[i].configuration);
  }
  make_objects();
}

void SceneBodies::make_objects() {
  std::vector<std::unique_ptr<ObjectNode>> old = std::move(objects_);
  objects_.clear();
  for (const geometric::SceneObject& object : scene_->objects) {
    const auto same =
        std::ranges::find_if(old, [&](const auto& node) { return node && node->draws(object); });
    objects_.push_back(same == old.end() ? std::make_unique<ObjectNode>(object) : std::move(*same));
    objects_.back()->place(object.X_PO);
    objects_.back()->cut_by(object.attachment ? nullptr : section_.get());
  }
}

void SceneBodies::set_section(const std::optional<Eigen::Hyperplane<double, 3>>& plane) {
  section_->whichChild = plane ? SO_SWITCH_ALL : SO_SWITCH_NONE;
  if (plane) {  // Coin draws what is above a plane
    static_cast<SoClipPlane*>(section_->getChild(0))->plane =
        SbPlane(to_coin(Eigen::Vector3d(-plane->normal())), static_cast<float>(plane->offset()));
  }
}

void SceneBodies::place(const Configuration& q) {
  q_ = q;
  robots_.front()->place(scene_->robots.front().X_WB, q);
  place_attached();
}

void SceneBodies::place_attached() {
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const geometric::SceneObject& object = scene_->objects[i];
    if (!object.attachment) {
      continue;
    }
    for (std::size_t r = 0; r < robots_.size(); ++r) {
      const auto link = robots_[r]->model().find_link(object.attachment->link);
      if (scene_->robots[r].name == object.attachment->robot && link) {
        const Pose& X_WL = robots_[r]->link_poses()[static_cast<std::size_t>(*link)];
        objects_[i]->place(X_WL * object.X_PO);
      }
    }
  }
}

void SceneBodies::preview(const SceneItem& item, const Pose& X_WO) {
  for (const auto& object : objects_) {
    if (item.kind == SceneItem::Kind::kObject && object->name() == item.name) {
      object->place(X_WO);
    }
  }
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const std::optional<int> base = item.kind == SceneItem::Kind::kRobot
                                        ? base_link(scene_->robots[i], item.robot)
                                        : std::nullopt;
    if (base) {
      robots_[i]->move_from(*base, X_WO);
      place_attached();
    }
  }
}

void SceneBodies::stand_in(const BodyMeshes& meshes) {
  for (std::size_t robot = 0; robot < shapes_.size(); ++robot) {
    for (std::size_t link = 0; link < shapes_[robot].size(); ++link) {
      const bool known = robot < meshes.links.size() && link < meshes.links[robot].size();
      shapes_[robot][link].stand_in(known ? meshes.links[robot][link] : nullptr);
    }
  }
  for (const auto& object : objects_) {
    const auto mesh = meshes.objects.find(object->name());
    object->stand_in(mesh == meshes.objects.end() ? nullptr : mesh->second);
  }
}

bool SceneBodies::set_colliding(const std::vector<std::string>& bodies, const StillSplit& split) {
  bool changed = false;
  const auto look_of = [&bodies](const std::string& body) {
    return std::ranges::find(bodies, body) == bodies.end() ? Look::kPlain : Look::kColliding;
  };
  for (std::size_t r = 0; r < robots_.size(); ++r) {
    const std::string& robot = scene_->robots[r].name;
    for (int i = 0; i < robots_[r]->model().link_count(); ++i) {
      const std::string& link = robots_[r]->model().link(i).name;
      const bool differs = robots_[r]->set_look(i, look_of(r == 0 ? link : robot + "/" + link));
      changed |= differs && !(r == 0 && split.moves(i));
    }
  }
  for (const auto& object : objects_) {
    const Look look = look_of(object->name());
    changed |= object->set_look(look != Look::kPlain && object->is_large() ? Look::kPlain : look);
  }
  return changed;
}

std::vector<SoSeparator*> SceneBodies::outlined(const std::vector<std::string>& bodies) const {
  std::vector<SoSeparator*> large;
  for (const auto& object : objects_) {
    if (std::ranges::count(bodies, object->name()) > 0 && object->is_large()) {
      large.push_back(object->root());
    }
  }
  return large;
}

std::vector<SoNode*> SceneBodies::shown() const {
  std::vector<SoNode*> nodes;
  for (const auto& robot : robots_) {
    nodes.push_back(robot->root());
  }
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (!scene_->display.of(scene_->objects[i].name).hidden) {
      nodes.push_back(objects_[i]->root());
    }
  }
  return nodes;
}

std::vector<SoNode*> SceneBodies::objects_without(const std::vector<std::string>& names) const {
  std::vector<SoNode*> nodes;
  for (const auto& object : objects_) {
    if (!scene_->display.of(object->name()).hidden &&
        std::ranges::count(names, object->name()) == 0) {
      nodes.push_back(object->root());
    }
  }
  return nodes;
}

std::vector<SoNode*> SceneBodies::opaque() const {
  std::vector<SoNode*> nodes = shown();
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (scene_->objects[i].color.alpha < 1.0F) {
      std::erase(nodes, objects_[i]->root());
    }
  }
  return nodes;
}

SceneBodies::Others SceneBodies::others() const {
  Others others;
  for (std::size_t r = 1; r < robots_.size(); ++r) {
    others.still.push_back(robots_[r]->root());
  }
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const geometric::SceneObject& object = scene_->objects[i];
    if (!scene_->display.of(object.name).hidden) {
      const bool apart = object.attachment || object.color.alpha < 1.0F;
      (apart ? others.moving : others.still).push_back(objects_[i]->root());
    }
  }
  return others;
}

std::vector<SoSeparator*> SceneBodies::parts_of(const Selection& selection) const {
  const SceneItem& item = selection.item;
  std::vector<SoSeparator*> parts;
  for (std::size_t r = 0; r < robots_.size(); ++r) {
    const geometric::RobotInstance& robot = scene_->robots[r];
    const bool is_here = item.robot == robot.name;
    const auto part = std::ranges::find(robot.parts, item.robot, &geometric::RobotPart::name);
    if (item.kind == SceneItem::Kind::kRobot && part != robot.parts.end()) {
      for (const auto& [own, composed] : part->links) {
        parts.push_back(robots_[r]->link_root(*robot.model->find_link(composed)));
      }
    } else if (is_here && item.kind == SceneItem::Kind::kRobot) {
      parts.push_back(robots_[r]->root());
    } else if (const auto link = robots_[r]->model().find_link(item.name);
               is_here && item.kind == SceneItem::Kind::kLink && link) {
      parts.push_back(robots_[r]->link_root(*link));
    }
  }
  for (const auto& object : objects_) {
    if (std::ranges::count(selection.objects, object->name()) > 0) {
      parts.push_back(object->root());
    }
  }
  return parts;
}

SceneItem SceneBodies::item_of(const SoPath& path) const {
  for (int i = 0; i < path.getLength(); ++i) {
    const SoNode* node = path.getNode(i);
    for (const auto& object : objects_) {
      if (object->root() == node) {
        return {SceneItem::Kind::kObject, "", object->name()};
      }
    }
    for (std::size_t r = 0; r < robots_.size(); ++r) {
      if (const auto link = robots_[r]->find_link(node)) {
        return {SceneItem::Kind::kLink, scene_->robots[r].name,
                robots_[r]->model().link(*link).name};
      }
    }
  }
  return {};
}

}  // namespace handway::gui
