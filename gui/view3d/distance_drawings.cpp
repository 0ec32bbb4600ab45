#include "view3d/distance_drawings.h"

#include "handway/geometric/mesh/shape.h"
#include "view3d/coin_conversions.h"
#include "view3d/drawing_parts.h"
#include "view3d/unlit_nodes.h"

#include <Inventor/nodes/SoSeparator.h>

#include <algorithm>
#include <array>

namespace handway::gui {
namespace {

constexpr geometric::Color kMeasureColor{0.52F, 0.20F, 0.80F, 1.0F};

}  // namespace

Drawing make_clearance_node(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  constexpr double kFar = 0.03;  // m, from which on all is green
  const auto t = static_cast<float>(std::min(1.0, (a - b).norm() / kFar));
  const geometric::Color color{std::min(0.90F, 1.8F * (1.0F - t)), std::min(0.68F, 1.36F * t),
                               0.12F, 1.0F};
  const std::array ends{a, b};
  CoinRef<SoSeparator> separator = make_plain_line(ends, color, 2.5F);
  separator->addChild(make_dots_node(ends, {color}, 7.0F));
  return separator;
}

Drawing make_measure_node(std::span<const Eigen::Vector3d> points) {
  CoinRef<SoSeparator> separator = make_plain_line(points, kMeasureColor, 2.0F);
  separator->addChild(make_dots_node(points, {kMeasureColor}, kDotSize));
  return separator;
}

}  // namespace handway::gui
