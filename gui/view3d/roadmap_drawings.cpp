#include "view3d/roadmap_drawings.h"

#include "view3d/coin_conversions.h"
#include "view3d/drawing_parts.h"
#include "view3d/robot_node.h"
#include "view3d/unlit_nodes.h"

#include <Inventor/nodes/SoSeparator.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace handway::gui {
namespace {

constexpr std::array<geometric::Color, 6> kScale{{{0.16F, 0.40F, 0.78F, 1.0F},
                                                  {0.05F, 0.60F, 0.62F, 1.0F},
                                                  {0.36F, 0.63F, 0.15F, 1.0F},
                                                  {0.88F, 0.63F, 0.05F, 1.0F},
                                                  {0.86F, 0.31F, 0.13F, 1.0F},
                                                  {0.70F, 0.17F, 0.50F, 1.0F}}};

constexpr float kDotWidth = 6.0F;
constexpr float kLineWidth = 1.0F;
constexpr geometric::Color kEdgeColor{0.52F, 0.58F, 0.67F, 1.0F};

SoSeparator* make_dots(const PalmRoadmap& roadmap) {
  const int most = most_pmds(roadmap);
  std::vector<geometric::Color> colors;
  for (const auto& node : roadmap.roadmap.nodes) {
    colors.push_back(pmd_color(node.pmd_count, most));
  }
  return make_dots_node(roadmap.palms, colors, kDotWidth);
}

}  // namespace

geometric::Color pmd_color(int count, int most) {
  if (count <= 0) {
    return {0.47F, 0.50F, 0.55F, 1.0F};
  }
  const int steps = std::max(most, static_cast<int>(kScale.size())) - 1;
  const float place = static_cast<float>(std::min(count - 1, steps) * (kScale.size() - 1)) /
                      static_cast<float>(steps);
  const auto below = static_cast<std::size_t>(place);
  return mixed(kScale.at(below), kScale.at(std::min(below + 1, kScale.size() - 1)),
               place - static_cast<float>(below));
}

int most_pmds(const PalmRoadmap& roadmap) {
  int most = 0;
  for (const auto& node : roadmap.roadmap.nodes) {
    most = std::max(most, node.pmd_count);
  }
  return most;
}

Drawing make_roadmap_node(const PalmRoadmap& roadmap) {
  auto separator = make_coin<SoSeparator>();
  if (!roadmap.roadmap.edges.empty()) {
    separator->addChild(
        make_edges_node(roadmap.palms, roadmap.roadmap.edges, kEdgeColor, kLineWidth));
  }
  separator->addChild(make_dots(roadmap));
  return separator;
}

}  // namespace handway::gui
