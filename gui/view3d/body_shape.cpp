#include "view3d/body_shape.h"

#include "view3d/shape_node.h"

#include <Inventor/nodes/SoMaterial.h>

namespace handway::gui {

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

}  // namespace handway::gui
