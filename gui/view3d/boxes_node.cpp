#include "view3d/boxes_node.h"

#include "view3d/coin_conversions.h"
#include "view3d/unlit_style.h"

#include <Inventor/nodes/SoLineSet.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <array>
#include <cstdint>

namespace handway::gui {
namespace {

constexpr float kLineWidth = 1.5F;
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

SbVec3f corner(const planning::PalmBox& box, int number) {
  const auto side = [number](int bit) { return (number & bit) != 0 ? 1.0 : -1.0; };
  return to_coin(Eigen::Vector3d(
      box.X_WC * box.half_size.cwiseProduct(Eigen::Vector3d(side(1), side(2), side(4)))));
}

}  // namespace

CoinRef<SoSeparator> make_boxes_node(const std::vector<planning::PalmBox>& boxes,
                                     std::pair<double, double> range) {
  std::vector<SbVec3f> ends;
  std::vector<std::uint32_t> colors;
  const bool is_joined = range.second - range.first < kRounding;  // nothing is left to search
  for (const planning::PalmBox& box : boxes) {
    const bool searched =
        is_joined || (box.step >= range.first - kRounding && box.step <= range.second + kRounding);
    for (const auto& [from, to] : kEdges) {
      ends.push_back(corner(box, from));
      ends.push_back(corner(box, to));
      colors.push_back(packed_rgba(searched ? kSearchedColor : kGivenUpColor));
    }
  }
  const std::vector<std::int32_t> two_each(colors.size(), 2);
  auto* vertices = new SoVertexProperty;
  vertices->vertex.setValues(0, static_cast<int>(ends.size()), ends.data());
  vertices->orderedRGBA.setValues(0, static_cast<int>(colors.size()), colors.data());
  vertices->materialBinding = SoVertexProperty::PER_FACE;
  auto* lines = new SoLineSet;
  lines->vertexProperty = vertices;
  lines->numVertices.setValues(0, static_cast<int>(two_each.size()), two_each.data());
  auto separator = make_coin<SoSeparator>();
  add_unlit_style(*separator.get(), kLineWidth);
  separator->addChild(lines);
  return separator;
}

}  // namespace handway::gui
