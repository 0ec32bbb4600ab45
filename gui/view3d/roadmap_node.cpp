#include "view3d/roadmap_node.h"

#include "view3d/coin_conversions.h"
#include "view3d/unlit_nodes.h"

#include <Inventor/nodes/SoBaseColor.h>
#include <Inventor/nodes/SoDepthBuffer.h>
#include <Inventor/nodes/SoPointSet.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace handway::gui {
namespace {

constexpr std::array<geometric::Color, 6> kScale{{{0.16F, 0.40F, 0.78F, 1.0F},
                                                  {0.05F, 0.60F, 0.62F, 1.0F},
                                                  {0.36F, 0.63F, 0.15F, 1.0F},
                                                  {0.88F, 0.63F, 0.05F, 1.0F},
                                                  {0.86F, 0.31F, 0.13F, 1.0F},
                                                  {0.70F, 0.17F, 0.50F, 1.0F}}};

}  // namespace

geometric::Color pmd_color(int count, int most) {
  if (count <= 0) {
    return {0.47F, 0.50F, 0.55F, 1.0F};
  }
  const int steps = std::max(most, static_cast<int>(kScale.size())) - 1;
  const float place = static_cast<float>(std::min(count - 1, steps) * (kScale.size() - 1)) /
                      static_cast<float>(steps);
  const auto below = static_cast<std::size_t>(place);
  const geometric::Color& a = kScale.at(below);
  const geometric::Color& b = kScale.at(std::min(below + 1, kScale.size() - 1));
  const float t = place - static_cast<float>(below);
  return {a.red + t * (b.red - a.red), a.green + t * (b.green - a.green),
          a.blue + t * (b.blue - a.blue), 1.0F};
}

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

Drawing make_roadmap_node(const PalmRoadmap& roadmap) {
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

Drawing make_steps_node(const Microscope& microscope) {
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
