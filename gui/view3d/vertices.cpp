#include "view3d/vertices.h"

#include "view3d/coin_conversions.h"

#include <Inventor/nodes/SoVertexProperty.h>

#include <vector>

namespace handway::gui {

SoVertexProperty* make_vertices(std::span<const Eigen::Vector3d> points) {
  std::vector<SbVec3f> vertices;
  vertices.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    vertices.push_back(to_coin(point));
  }
  auto* properties = new SoVertexProperty;
  properties->vertex.setValues(0, static_cast<int>(vertices.size()), vertices.data());
  return properties;
}

}  // namespace handway::gui
