#include "view3d/roadmap_node.h"

#include "view3d/coin_conversions.h"
#include "view3d/pmd_colors.h"
#include "view3d/round_points.h"
#include "view3d/unlit_style.h"

#include <Inventor/nodes/SoBaseColor.h>
#include <Inventor/nodes/SoLineSet.h>
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

SoSeparator* make_edges(const PalmRoadmap& roadmap) {
  auto* separator = new SoSeparator;
  add_unlit_style(*separator, kLineWidth);
  auto* color = new SoBaseColor;
  color->rgb = to_coin(kEdgeColor);
  separator->addChild(color);
  std::vector<SbVec3f> ends;
  for (const auto& [from, to] : roadmap.roadmap.edges) {
    ends.push_back(to_coin(roadmap.palms[static_cast<std::size_t>(from)]));
    ends.push_back(to_coin(roadmap.palms[static_cast<std::size_t>(to)]));
  }
  const std::vector<std::int32_t> two_each(roadmap.roadmap.edges.size(), 2);
  auto* vertices = new SoVertexProperty;
  vertices->vertex.setValues(0, static_cast<int>(ends.size()), ends.data());
  auto* lines = new SoLineSet;
  lines->vertexProperty = vertices;
  lines->numVertices.setValues(0, static_cast<int>(two_each.size()), two_each.data());
  separator->addChild(lines);
  return separator;
}

SoSeparator* make_dots(const PalmRoadmap& roadmap) {
  auto* separator = new SoSeparator;
  add_unlit_style(*separator, kLineWidth, kDotWidth);
  const int most = most_pmds(roadmap);
  std::vector<SbVec3f> places;
  std::vector<std::uint32_t> colors;
  for (std::size_t i = 0; i < roadmap.palms.size(); ++i) {
    places.push_back(to_coin(roadmap.palms[i]));
    colors.push_back(packed_rgba(pmd_color(roadmap.roadmap.nodes[i].pmd_count, most)));
  }
  auto* vertices = new SoVertexProperty;
  vertices->vertex.setValues(0, static_cast<int>(places.size()), places.data());
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
    separator->addChild(make_edges(roadmap));
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
