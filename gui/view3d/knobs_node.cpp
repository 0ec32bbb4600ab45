#include "view3d/knobs_node.h"

#include "view3d/coin_conversions.h"
#include "view3d/unlit_style.h"

#include <Inventor/nodes/SoBaseColor.h>
#include <Inventor/nodes/SoDepthBuffer.h>
#include <Inventor/nodes/SoPointSet.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoVertexProperty.h>

namespace handway::gui {
namespace {

const SbColor kRim(0.20F, 0.22F, 0.26F);
const SbColor kPlain(1.0F, 1.0F, 1.0F);
const SbColor kHotKnob(1.0F, 0.74F, 0.10F);
constexpr float kRimSize = 11.0F;  // pixels
constexpr float kSize = 8.0F;

void add_square(SoSeparator& root, const Eigen::Vector3d& point, const SbColor& color, float size) {
  auto* square = new SoSeparator;
  add_unlit_style(*square, 1.0F, size);
  auto* paint = new SoBaseColor;
  paint->rgb = color;
  square->addChild(paint);
  auto* properties = new SoVertexProperty;
  properties->vertex = to_coin(point);
  auto* dot = new SoPointSet;
  dot->vertexProperty = properties;
  square->addChild(dot);
  root.addChild(square);
}

}  // namespace

CoinRef<SoSeparator> make_knobs_node(std::span<const Eigen::Vector3d> points,
                                     std::optional<int> hot) {
  auto root = make_coin<SoSeparator>();
  root->renderCaching = SoSeparator::OFF;
  auto* in_front = new SoDepthBuffer;
  in_front->test = FALSE;
  root->addChild(in_front);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_hot = hot == static_cast<int>(i);
    add_square(*root.get(), points[i], kRim, kRimSize + (is_hot ? 2.0F : 0.0F));
    add_square(*root.get(), points[i], is_hot ? kHotKnob : kPlain, kSize + (is_hot ? 2.0F : 0.0F));
  }
  return root;
}

}  // namespace handway::gui
