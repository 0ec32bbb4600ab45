#include "microscope/steps_node.h"

#include "view3d/coin_conversions.h"
#include "view3d/unlit_style.h"

#include <Inventor/nodes/SoBaseColor.h>
#include <Inventor/nodes/SoDepthBuffer.h>
#include <Inventor/nodes/SoLineSet.h>
#include <Inventor/nodes/SoPointSet.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <span>
#include <utility>

namespace handway::gui {
namespace {

namespace lines = planning::algorithm_lines;

const SbColor kNode(0.16F, 0.36F, 0.72F);
const SbColor kEdge(0.42F, 0.52F, 0.70F);
const SbColor kFree(0.11F, 0.66F, 0.36F);
const SbColor kRefused(0.85F, 0.16F, 0.14F);

SoVertexProperty* vertices_of(const std::vector<SbVec3f>& points) {
  auto* properties = new SoVertexProperty;
  properties->vertex.setValues(0, static_cast<int>(points.size()), points.data());
  return properties;
}

void add_color(SoGroup& group, const SbColor& color) {
  auto* node = new SoBaseColor;
  node->rgb = color;
  group.addChild(node);
}

SoSeparator* make_edges(const Microscope& microscope, std::span<const std::pair<int, int>> edges,
                        const SbColor& color, float width) {
  std::vector<SbVec3f> points;
  std::vector<int> counts(edges.size(), 2);
  for (const auto& [from, to] : edges) {
    points.push_back(to_coin(microscope.palms()[static_cast<std::size_t>(from)]));
    points.push_back(to_coin(microscope.palms()[static_cast<std::size_t>(to)]));
  }
  auto* separator = new SoSeparator;
  add_unlit_style(*separator, width);
  add_color(*separator, color);
  auto* set = new SoLineSet;
  set->vertexProperty = vertices_of(points);
  set->numVertices.setValues(0, static_cast<int>(counts.size()), counts.data());
  separator->addChild(set);
  return separator;
}

SoSeparator* make_nodes(const Microscope& microscope, int first, int last, const SbColor& color,
                        float size) {
  std::vector<SbVec3f> points;
  for (int node = first; node < last; ++node) {
    points.push_back(to_coin(microscope.palms()[static_cast<std::size_t>(node)]));
  }
  auto* separator = new SoSeparator;
  add_unlit_style(*separator, 1.0F, size);
  add_color(*separator, color);
  auto* set = new SoPointSet;
  set->vertexProperty = vertices_of(points);
  separator->addChild(set);
  return separator;
}

}  // namespace

CoinRef<SoSeparator> make_steps_node(const Microscope& microscope) {
  auto all = make_coin<SoSeparator>();
  auto* through = new SoDepthBuffer;
  through->test = FALSE;
  all->addChild(through);
  const std::size_t done = microscope.position() + 1;
  const RecordedRun& run = *microscope.run();
  const auto edges = run.edges_after(done);
  if (!edges.empty()) {
    all->addChild(make_edges(microscope, edges, kEdge, 1.5F));
  }
  const int nodes = run.nodes_after(done);
  all->addChild(make_nodes(microscope, 0, nodes, kNode, 6.0F));
  const planning::AlgorithmStep& step = microscope.step().step;
  if (step.to >= 0 && step.line != lines::kJoined) {
    const std::pair<int, int> edge(step.from, step.to);
    all->addChild(make_edges(microscope, std::span(&edge, 1), step.yes ? kFree : kRefused, 4.0F));
  }
  if (step.from >= 0 && step.to < 0) {
    all->addChild(make_nodes(microscope, step.from, step.from + 1, kFree, 11.0F));
  }
  return all;
}

}  // namespace handway::gui
