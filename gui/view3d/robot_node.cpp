#include "view3d/robot_node.h"

#include "model/meshes/shaded_meshes.h"
#include "view3d/coin_conversions.h"
#include "view3d/shape_node.h"

#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoMatrixTransform.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSwitch.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace handway::gui {
namespace {

CoinRef<SoMaterial> overriding(const geometric::Color& color, float glow) {
  CoinRef<SoMaterial> material = make_material(color);
  const SbColor diffuse = to_coin(color);
  material->emissiveColor = SbColor(diffuse[0] * glow, diffuse[1] * glow, diffuse[2] * glow);
  material->setOverride(TRUE);
  return material;
}

CoinRef<SoSeparator> make_geometry_node(const geometric::LinkGeometry& geometry) {
  auto separator = make_coin<SoSeparator>();
  separator->renderCaching = SoSeparator::OFF;
  auto* transform = new SoMatrixTransform;
  transform->matrix = to_coin(geometry.X_LG);
  separator->addChild(transform);
  separator->addChild(make_material(geometry.color).get());
  separator->addChild(make_shape_node(geometry.shape).get());
  return separator;
}

constexpr geometric::Color kColliding{0.86F, 0.13F, 0.11F, 1.0F};
constexpr geometric::Color kCollidingRed{0.98F, 0.80F, 0.05F, 1.0F};  // of what is red already

}  // namespace

BodyShape::BodyShape(const CoinRef<SoSeparator>& looks, const geometric::Color& color)
    : color_(color), root_(make_coin<SoSeparator>()), drawings_(make_coin<SoSwitch>()) {
  root_->renderCaching = SoSeparator::OFF;
  root_->addChild(drawings_.get());
  drawings_->addChild(looks.get());
  drawings_->whichChild = 0;
}

void BodyShape::stand_in(const std::shared_ptr<const geometric::TriangleMesh>& mesh) const {
  while (drawings_->getNumChildren() > 1) {
    drawings_->removeChild(1);
  }
  if (mesh) {
    auto drawing = make_coin<SoSeparator>();
    drawing->renderCaching = SoSeparator::OFF;
    drawing->addChild(make_material(color_).get());
    drawing->addChild(make_shape_node(geometric::Mesh{{}, Eigen::Vector3d::Ones(), mesh}).get());
    drawings_->addChild(drawing.get());
  }
  drawings_->whichChild = mesh ? 1 : 0;
}

CoinRef<SoMaterial> make_look_material(Look look, const geometric::Color& plain) {
  switch (look) {
    case Look::kColliding: {
      const bool is_red = plain.red > 0.5F && plain.green < 0.4F && plain.blue < 0.4F;
      return overriding(is_red ? kCollidingRed : kColliding, 0.25F);
    }
    case Look::kPlain:
      break;
  }
  return {};
}

LinkShapes make_link_shapes(const geometric::RobotModel& model) {
  LinkShapes shapes;
  for (int i = 0; i < model.link_count(); ++i) {
    const geometric::Link& link = model.link(i);
    auto separator = make_coin<SoSeparator>();
    separator->renderCaching = SoSeparator::OFF;
    const std::vector<geometric::LinkGeometry>& shown = shown_geometry(link);
    for (const geometric::LinkGeometry& geometry : shown) {
      separator->addChild(make_geometry_node(geometry).get());
    }
    shapes.emplace_back(separator, shown.empty() ? geometric::Color() : shown.front().color);
  }
  return shapes;
}

RobotNode::RobotNode(std::shared_ptr<const geometric::RobotModel> model, const LinkShapes& shapes,
                     std::optional<geometric::Color> ghost)
    : model_(std::move(model)),
      root_(make_coin<SoSeparator>()),
      plain_(ghost ? 0 : SO_SWITCH_NONE),
      X_WL_(static_cast<std::size_t>(model_->link_count()), geometric::Pose::Identity()) {
  root_->renderCaching = SoSeparator::OFF;
  for (const BodyShape& shape : shapes) {
    LinkNode node{make_coin<SoSwitch>(), make_coin<SoSeparator>(), make_coin<SoMatrixTransform>(),
                  make_coin<SoSwitch>()};
    node.visible->whichChild = SO_SWITCH_ALL;
    node.separator->renderCaching = SoSeparator::OFF;
    node.separator->addChild(node.transform.get());
    const CoinRef<SoMaterial> colliding = make_look_material(Look::kColliding);
    if (ghost) {
      node.look->addChild(overriding(*ghost, 0.15F).get());
      colliding->transparency = 1.0F - ghost->alpha;
    }
    node.look->addChild(colliding.get());
    node.look->whichChild = plain_;
    node.separator->addChild(node.look.get());
    node.separator->addChild(shape.get());
    node.visible->addChild(node.separator.get());
    root_->addChild(node.visible.get());
    links_.push_back(std::move(node));
  }
}

RobotNode::~RobotNode() = default;

void RobotNode::place(const geometric::Pose& X_WB, const geometric::Configuration& q) {
  model_->forward_kinematics(q, X_WL_);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    X_WL_[i] = X_WB * X_WL_[i];
    links_[i].transform->matrix = to_coin(X_WL_[i]);
  }
}

void RobotNode::move_from(int link, const geometric::Pose& X_WL) {
  const geometric::Pose motion = X_WL * X_WL_[static_cast<std::size_t>(link)].inverse();
  std::vector<bool> moves(links_.size(), false);
  for (std::size_t i = static_cast<std::size_t>(link); i < links_.size(); ++i) {
    const int parent = model_->parent(static_cast<int>(i));
    moves[i] =
        static_cast<int>(i) == link || (parent >= 0 && moves[static_cast<std::size_t>(parent)]);
    if (moves[i]) {
      X_WL_[i] = motion * X_WL_[i];
      links_[i].transform->matrix = to_coin(X_WL_[i]);
    }
  }
}

bool RobotNode::set_look(int link, Look look) {
  const int child = look == Look::kPlain ? plain_ : plain_ + 1;
  SoSwitch& node = *links_[static_cast<std::size_t>(link)].look.get();
  if (node.whichChild.getValue() == child) {
    return false;
  }
  node.whichChild = child;
  return true;
}

bool RobotNode::set_link_visible(int link, bool visible) {
  SoSwitch& node = *links_[static_cast<std::size_t>(link)].visible.get();
  const int child = visible ? SO_SWITCH_ALL : SO_SWITCH_NONE;
  if (node.whichChild.getValue() == child) {
    return false;
  }
  node.whichChild = child;
  return true;
}

std::optional<int> RobotNode::find_link(const SoNode* node) const {
  const auto found = std::ranges::find_if(
      links_, [&](const LinkNode& link) { return link.separator.get() == node; });
  return found == links_.end() ? std::nullopt
                               : std::optional(static_cast<int>(found - links_.begin()));
}

}  // namespace handway::gui
