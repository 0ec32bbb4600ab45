#include "view3d/unlit_style.h"

#include <Inventor/nodes/SoDrawStyle.h>
#include <Inventor/nodes/SoGroup.h>
#include <Inventor/nodes/SoLightModel.h>

namespace handway::gui {

void add_unlit_style(SoGroup& group, float line_width, float point_size) {
  auto* unlit = new SoLightModel;
  unlit->model = SoLightModel::BASE_COLOR;
  group.addChild(unlit);
  auto* style = new SoDrawStyle;
  style->lineWidth = line_width;
  style->pointSize = point_size;
  group.addChild(style);
}

}  // namespace handway::gui
