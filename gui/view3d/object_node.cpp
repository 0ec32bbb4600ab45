#include "view3d/object_node.h"

#include "model/document/scene_edits.h"
#include "view3d/coin_conversions.h"
#include "view3d/shape_node.h"

#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoMatrixTransform.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSwitch.h>

namespace handway::gui {

namespace {

CoinRef<SoSeparator> make_looks(const geometric::SceneObject& object) {
  auto looks = make_coin<SoSeparator>();
  looks->renderCaching = SoSeparator::OFF;
  looks->addChild(make_material(object.color).get());
  looks->addChild(make_shape_node(object.shape).get());
  return looks;
}

}  // namespace

ObjectNode::ObjectNode(const geometric::SceneObject& object)
    : name_(object.name),
      shape_(object.shape),
      color_(object.color),
      root_(make_coin<SoSeparator>()),
      drawing_(make_looks(object), object.color),
      transform_(make_coin<SoMatrixTransform>()),
      look_(make_coin<SoSwitch>()) {
  root_->renderCaching = SoSeparator::OFF;
  look_->addChild(make_look_material(Look::kColliding).get());
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

bool ObjectNode::set_look(Look look) {
  const int child = look == Look::kPlain ? SO_SWITCH_NONE : 0;
  if (look_->whichChild.getValue() == child) {
    return false;
  }
  look_->whichChild = child;
  return true;
}

}  // namespace handway::gui
