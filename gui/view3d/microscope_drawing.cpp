#include "view3d/microscope_drawing.h"

#include "handway/geometric/mesh/shape.h"
#include "view3d/drawing_parts.h"
#include "view3d/unlit_nodes.h"

#include <Inventor/nodes/SoSeparator.h>

#include <cstddef>
#include <span>
#include <utility>

namespace handway::gui {
namespace {

namespace lines = planning::algorithm_lines;

constexpr geometric::Color kNode{0.16F, 0.36F, 0.72F, 1.0F};
constexpr geometric::Color kEdge{0.42F, 0.52F, 0.70F, 1.0F};
constexpr geometric::Color kFree{0.11F, 0.66F, 0.36F, 1.0F};
constexpr geometric::Color kRefused{0.85F, 0.16F, 0.14F, 1.0F};

}  // namespace

Drawing make_steps_node(const Microscope& microscope) {
  auto all = make_seen_through();
  const std::size_t done = microscope.position() + 1;
  const RecordedRun& run = *microscope.run();
  const auto edges = run.edges_after(done);
  if (!edges.empty()) {
    all->addChild(make_edges_node(microscope.palms(), edges, kEdge, 1.5F));
  }
  const int nodes = run.nodes_after(done);
  const std::span palms(microscope.palms());
  all->addChild(make_dots_node(palms.first(static_cast<std::size_t>(nodes)), {kNode}, 6.0F));
  const planning::AlgorithmStep& step = microscope.step().step;
  if (step.to >= 0 && step.line != lines::kJoined) {
    const std::pair<int, int> edge(step.from, step.to);
    all->addChild(make_edges_node(microscope.palms(), std::span(&edge, 1),
                                  step.yes ? kFree : kRefused, 4.0F));
  }
  if (step.from >= 0 && step.to < 0) {
    all->addChild(
        make_dots_node(palms.subspan(static_cast<std::size_t>(step.from), 1), {kFree}, 11.0F));
  }
  return all;
}

}  // namespace handway::gui
