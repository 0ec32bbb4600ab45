#include "view3d/region_node.h"

#include "view3d/round_points.h"
#include "view3d/shape_node.h"
#include "view3d/unlit_style.h"
#include "view3d/vertices.h"

#include <Inventor/nodes/SoAnnotation.h>
#include <Inventor/nodes/SoLineSet.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <span>

namespace handway::gui {
namespace {

constexpr float kVeil = 0.30F;  // opacity of one sample

void add_dots(SoSeparator& parent, std::span<const Eigen::Vector3d> points, geometric::Color color,
              float opacity, float width) {
  auto* separator = new SoSeparator;
  add_unlit_style(*separator, 1.0F, width);
  color.alpha = opacity;
  separator->addChild(make_material(color).get());
  auto* dots = new RoundPoints;
  dots->vertexProperty = make_vertices(points);
  separator->addChild(dots);
  parent.addChild(separator);
}

}  // namespace

CoinRef<SoSeparator> make_region_node(const planning::RegionDraws& draws) {
  auto separator = make_coin<SoSeparator>();
  auto* motion = new SoAnnotation;  // the clouds and the robot would hide most of it
  add_unlit_style(*motion, 2.5F);
  motion->addChild(make_material(kStraightColor).get());
  auto* line = new SoLineSet;
  line->vertexProperty = make_vertices(draws.motion);
  motion->addChild(line);
  if (!draws.centres.empty()) {
    add_dots(*motion, draws.centres, kStraightColor, 1.0F, 8.0F);
  }
  add_dots(*separator.get(), draws.fingertips, kFingertipColor, kVeil, 5.0F);
  add_dots(*separator.get(), draws.palms, kPalmColor, kVeil, 7.0F);
  separator->addChild(motion);
  return separator;
}

}  // namespace handway::gui
