#include "view3d/steps_node.h"

#include "view3d/coin_conversions.h"
#include "view3d/edges_node.h"
#include "view3d/unlit_style.h"
#include "view3d/vertices.h"

#include <Inventor/nodes/SoBaseColor.h>
#include <Inventor/nodes/SoDepthBuffer.h>
#include <Inventor/nodes/SoPointSet.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <span>
#include <utility>

namespace handway::gui {
namespace {

namespace lines = planning::algorithm_lines;

constexpr geometric::Color kNode{0.16F, 0.36F, 0.72F, 1.0F};
constexpr geometric::Color kEdge{0.42F, 0.52F, 0.70F, 1.0F};
constexpr geometric::Color kFree{0.11F, 0.66F, 0.36F, 1.0F};
constexpr geometric::Color kRefused{0.85F, 0.16F, 0.14F, 1.0F};

SoSeparator* make_nodes(const Microscope& microscope, int first, int last,
                        const geometric::Color& color, float size) {
  auto* separator = new SoSeparator;
  add_unlit_style(*separator, 1.0F, size);
  auto* base = new SoBaseColor;
  base->rgb = to_coin(color);
  separator->addChild(base);
  auto* set = new SoPointSet;
  set->vertexProperty = make_vertices(
      std::span(microscope.palms())
          .subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first)));
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
    all->addChild(make_edges_node(microscope.palms(), edges, kEdge, 1.5F));
  }
  const int nodes = run.nodes_after(done);
  all->addChild(make_nodes(microscope, 0, nodes, kNode, 6.0F));
  const planning::AlgorithmStep& step = microscope.step().step;
  if (step.to >= 0 && step.line != lines::kJoined) {
    const std::pair<int, int> edge(step.from, step.to);
    all->addChild(make_edges_node(microscope.palms(), std::span(&edge, 1),
                                  step.yes ? kFree : kRefused, 4.0F));
  }
  if (step.from >= 0 && step.to < 0) {
    all->addChild(make_nodes(microscope, step.from, step.from + 1, kFree, 11.0F));
  }
  return all;
}

}  // namespace handway::gui
