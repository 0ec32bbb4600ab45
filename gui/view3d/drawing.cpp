#include "view3d/drawing.h"

#include <Inventor/nodes/SoNode.h>

namespace handway::gui {
Drawing::Drawing(SoNode* node) : node_(node) {
  if (node_) {
    node_->ref();
  }
}

Drawing::~Drawing() {
  if (node_) {
    node_->unref();
  }
}

}  // namespace handway::gui
