#include "view3d/region_drawings.h"

#include "view3d/coin_conversions.h"
#include "view3d/drawing_parts.h"
#include "view3d/shape_node.h"
#include "view3d/unlit_nodes.h"

#include <Inventor/nodes/SoAnnotation.h>
#include <Inventor/nodes/SoLineSet.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoSeparator.h>

#include <Eigen/Core>

#include <algorithm>
#include <iterator>
#include <span>

namespace handway::gui {
namespace {

constexpr float kSampleVeil = 0.30F;  // opacity of one sample
constexpr float kBoxLineWidth = 1.5F;
constexpr double kRounding = 0.005;  // of the way

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

Drawing make_region_node(const planning::RegionDraws& draws) {
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
  add_dots(*separator.get(), draws.fingertips, kFingertipColor, kSampleVeil, 5.0F);
  add_dots(*separator.get(), draws.palms, kPalmColor, kSampleVeil, 7.0F);
  separator->addChild(motion);
  return separator;
}

Drawing make_boxes_node(const std::vector<planning::PalmBox>& boxes,
                        std::pair<double, double> range) {
  std::vector<Eigen::Vector3d> corners;
  Edges searched;
  Edges given_up;
  const bool is_joined = range.second - range.first < kRounding;  // nothing is left to search
  for (const planning::PalmBox& box : boxes) {
    const bool is_within =
        is_joined || (box.step >= range.first - kRounding && box.step <= range.second + kRounding);
    const auto first = static_cast<int>(corners.size());
    std::ranges::copy(box_corners(box.X_WC, box.half_size), std::back_inserter(corners));
    for (const auto& [from, to] : kBoxEdges) {
      (is_within ? searched : given_up).emplace_back(first + from, first + to);
    }
  }
  auto separator = make_coin<SoSeparator>();
  for (const auto& [edges, color] :
       {std::pair(&given_up, kGivenUpColor), std::pair(&searched, kSearchedColor)}) {
    if (!edges->empty()) {
      separator->addChild(make_edges_node(corners, *edges, color, kBoxLineWidth));
    }
  }
  return separator;
}

}  // namespace handway::gui
