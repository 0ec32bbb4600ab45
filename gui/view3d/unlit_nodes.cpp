#include "view3d/unlit_nodes.h"

#include "view3d/coin_conversions.h"

#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/elements/SoGLLazyElement.h>
#include <Inventor/nodes/SoDrawStyle.h>
#include <Inventor/nodes/SoGroup.h>
#include <Inventor/nodes/SoLightModel.h>
#include <Inventor/nodes/SoLineSet.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <GL/gl.h>

#include <cstdint>
#include <vector>

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

SoVertexProperty* make_vertices(std::span<const Eigen::Vector3d> points,
                                const std::vector<geometric::Color>& colors) {
  std::vector<SbVec3f> vertices;
  vertices.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    vertices.push_back(to_coin(point));
  }
  auto* properties = new SoVertexProperty;
  properties->vertex.setValues(0, static_cast<int>(vertices.size()), vertices.data());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    properties->orderedRGBA.set1Value(static_cast<int>(i), packed_rgba(colors[i]));
  }
  properties->materialBinding =
      colors.size() > 1 ? SoVertexProperty::PER_VERTEX : SoVertexProperty::OVERALL;
  return properties;
}

SO_NODE_SOURCE(RoundPoints);

void RoundPoints::initClass() { SO_NODE_INIT_CLASS(RoundPoints, SoPointSet, "PointSet"); }

RoundPoints::RoundPoints() {
  if (getClassTypeId() == SoType::badType()) {
    initClass();
  }
  SO_NODE_CONSTRUCTOR(RoundPoints);
}

void RoundPoints::GLRender(SoGLRenderAction* action) {
  glPushAttrib(GL_ENABLE_BIT | GL_COLOR_BUFFER_BIT | GL_POINT_BIT);
  glDisable(GL_MULTISAMPLE);  // under which some drivers draw squares
  glEnable(GL_POINT_SMOOTH);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  SoPointSet::GLRender(action);
  glPopAttrib();
  // Coin has to send its own state again: it can't know that it was put back.
  SoGLLazyElement::getInstance(action->getState())
      ->reset(action->getState(), SoLazyElement::ALL_MASK);
}

SoSeparator* make_line_node(std::span<const Eigen::Vector3d> points,
                            const std::vector<geometric::Color>& colors, float width) {
  auto* separator = new SoSeparator;
  add_unlit_style(*separator, width);
  auto* line = new SoLineSet;
  line->vertexProperty = make_vertices(points, colors);
  separator->addChild(line);
  return separator;
}

SoSeparator* make_dots_node(std::span<const Eigen::Vector3d> points,
                            const std::vector<geometric::Color>& colors, float size) {
  auto* separator = new SoSeparator;
  add_unlit_style(*separator, 1.0F, size);
  auto* dots = new RoundPoints;
  dots->vertexProperty = make_vertices(points, colors);
  separator->addChild(dots);
  return separator;
}

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
  auto* lines = new SoLineSet;
  lines->vertexProperty = make_vertices(ends, {color});
  lines->numVertices.setValues(0, static_cast<int>(two_each.size()), two_each.data());
  separator->addChild(lines);
  return separator;
}

}  // namespace handway::gui
