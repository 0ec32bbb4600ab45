#include "view3d/roadmap_node.h"

#include "view3d/coin_conversions.h"
#include "view3d/edges_node.h"
#include "view3d/pmd_colors.h"
#include "view3d/round_points.h"
#include "view3d/unlit_style.h"
#include "view3d/vertices.h"

#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace handway::gui {
namespace {

constexpr float kDotWidth = 6.0F;
constexpr float kLineWidth = 1.0F;
constexpr geometric::Color kEdgeColor{0.52F, 0.58F, 0.67F, 1.0F};

SoSeparator* make_dots(const PalmRoadmap& roadmap) {
  auto* separator = new SoSeparator;
  add_unlit_style(*separator, kLineWidth, kDotWidth);
  const int most = most_pmds(roadmap);
  std::vector<std::uint32_t> colors;
  for (const auto& node : roadmap.roadmap.nodes) {
    colors.push_back(packed_rgba(pmd_color(node.pmd_count, most)));
  }
  SoVertexProperty* vertices = make_vertices(roadmap.palms);
  vertices->orderedRGBA.setValues(0, static_cast<int>(colors.size()), colors.data());
  vertices->materialBinding = SoVertexProperty::PER_VERTEX;
  auto* dots = new RoundPoints;
  dots->vertexProperty = vertices;
  separator->addChild(dots);
  return separator;
}

}  // namespace

CoinRef<SoSeparator> make_roadmap_node(const PalmRoadmap& roadmap) {
  auto separator = make_coin<SoSeparator>();
  if (!roadmap.roadmap.edges.empty()) {
    separator->addChild(
        make_edges_node(roadmap.palms, roadmap.roadmap.edges, kEdgeColor, kLineWidth));
  }
  separator->addChild(make_dots(roadmap));
  return separator;
}

int most_pmds(const PalmRoadmap& roadmap) {
  int most = 0;
  for (const auto& node : roadmap.roadmap.nodes) {
    most = std::max(most, node.pmd_count);
  }
  return most;
}

}  // namespace handway::gui
