#include "view3d/region_node.h"

#include "view3d/shape_node.h"
#include "view3d/unlit_nodes.h"

#include <Inventor/nodes/SoAnnotation.h>
#include <Inventor/nodes/SoLineSet.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <array>
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
  add_dots(*separator.get(), draws.fingertips, kFingertipColor, kVeil, 5.0F);
  add_dots(*separator.get(), draws.palms, kPalmColor, kVeil, 7.0F);
  separator->addChild(motion);
  return separator;
}

namespace {

constexpr float kBoxLineWidth = 1.5F;
constexpr double kRounding = 0.005;  // of the way

// Corners are numbered by their bits: 1 for x, 2 for y, 4 for z.
constexpr std::array<std::pair<int, int>, 12> kEdges{{{0, 1},
                                                      {2, 3},
                                                      {4, 5},
                                                      {6, 7},
                                                      {0, 2},
                                                      {1, 3},
                                                      {4, 6},
                                                      {5, 7},
                                                      {0, 4},
                                                      {1, 5},
                                                      {2, 6},
                                                      {3, 7}}};

Eigen::Vector3d corner(const planning::PalmBox& box, int number) {
  const auto side = [number](int bit) { return (number & bit) != 0 ? 1.0 : -1.0; };
  return box.X_WC * box.half_size.cwiseProduct(Eigen::Vector3d(side(1), side(2), side(4)));
}

}  // namespace

Drawing make_boxes_node(const std::vector<planning::PalmBox>& boxes,
                        std::pair<double, double> range) {
  std::vector<Eigen::Vector3d> corners;
  std::vector<std::pair<int, int>> searched;
  std::vector<std::pair<int, int>> given_up;
  const bool is_joined = range.second - range.first < kRounding;  // nothing is left to search
  for (const planning::PalmBox& box : boxes) {
    const bool is_within =
        is_joined || (box.step >= range.first - kRounding && box.step <= range.second + kRounding);
    const auto first = static_cast<int>(corners.size());
    for (int number = 0; number < 8; ++number) {
      corners.push_back(corner(box, number));
    }
    for (const auto& [from, to] : kEdges) {
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
