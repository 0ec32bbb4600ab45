#include "view3d/edges_node.h"

#include "view3d/coin_conversions.h"
#include "view3d/unlit_style.h"
#include "view3d/vertices.h"

#include <Inventor/nodes/SoBaseColor.h>
#include <Inventor/nodes/SoLineSet.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <cstdint>
#include <vector>

namespace handway::gui {

SoSeparator* make_edges_node(std::span<const Eigen::Vector3d> points,
                             std::span<const std::pair<int, int>> edges,
                             const geometric::Color& color, float width) {
  std::vector<Eigen::Vector3d> ends;
  ends.reserve(2 * edges.size());
  for (const auto& [from, to] : edges) {
    ends.push_back(points[static_cast<std::size_t>(from)]);
    ends.push_back(points[static_cast<std::size_t>(to)]);
  }
  const std::vector<std::int32_t> two_each(edges.size(), 2);
  auto* separator = new SoSeparator;
  add_unlit_style(*separator, width);
  auto* base = new SoBaseColor;
  base->rgb = to_coin(color);
  separator->addChild(base);
  auto* lines = new SoLineSet;
  lines->vertexProperty = make_vertices(ends);
  lines->numVertices.setValues(0, static_cast<int>(two_each.size()), two_each.data());
  separator->addChild(lines);
  return separator;
}

}  // namespace handway::gui
