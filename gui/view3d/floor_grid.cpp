#include "view3d/floor_grid.h"

#include "view3d/unlit_nodes.h"

#include <Inventor/SbVec3f.h>
#include <Inventor/nodes/SoLineSet.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace handway::gui {
namespace {

constexpr double kSpacing = 0.1;  // m
constexpr int kStrongEvery = 5;

class GridLines {
 public:
  GridLines(const Eigen::Vector3d& centre, double radius, const geometric::Color& color)
      : centre_(centre), radius_(radius), color_(color) {}

  // A line parallel to `along`, `offset` from the middle, in pieces that fade.
  void add(const Eigen::Vector3d& along, const Eigen::Vector3d& across, double offset,
           float strength) {
    const double half = std::sqrt(std::max(radius_ * radius_ - offset * offset, 0.0));
    const int pieces = std::max(2, static_cast<int>(std::ceil(2.0 * half / 0.25)));
    for (int i = 0; i <= pieces; ++i) {
      const double s = half * (2.0 * i / pieces - 1.0);
      const double from_middle = std::hypot(s, offset) / radius_;
      geometric::Color color = color_;
      color.alpha = strength * static_cast<float>(std::pow(1.0 - std::min(from_middle, 1.0), 1.2));
      points_.push_back(to_coin(Eigen::Vector3d(centre_ + s * along + offset * across)));
      colors_.push_back(packed_rgba(color));
    }
    counts_.push_back(pieces + 1);
  }

  [[nodiscard]] SoLineSet* make() const {
    auto* properties = new SoVertexProperty;
    properties->vertex.setValues(0, static_cast<int>(points_.size()), points_.data());
    properties->orderedRGBA.setValues(0, static_cast<int>(colors_.size()), colors_.data());
    properties->materialBinding = SoVertexProperty::PER_VERTEX;
    auto* lines = new SoLineSet;
    lines->vertexProperty = properties;
    lines->numVertices.setValues(0, static_cast<int>(counts_.size()), counts_.data());
    return lines;
  }

 private:
  Eigen::Vector3d centre_;
  double radius_;
  geometric::Color color_;
  std::vector<SbVec3f> points_;
  std::vector<std::uint32_t> colors_;
  std::vector<std::int32_t> counts_;
};

}  // namespace

CoinRef<SoSeparator> make_floor_grid(const Eigen::Vector3d& centre, double radius,
                                     const geometric::Color& color) {
  // Lines stand at whole multiples of the spacing in the world.
  const Eigen::Vector3d middle(std::round(centre.x() / kSpacing) * kSpacing,
                               std::round(centre.y() / kSpacing) * kSpacing, centre.z());
  GridLines grid(middle, radius, color);
  const int count = static_cast<int>(radius / kSpacing);
  const auto strength = [](long line) { return line % kStrongEvery == 0 ? 0.55F : 0.22F; };
  for (int i = -count; i <= count; ++i) {
    grid.add(Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), i * kSpacing,
             strength(std::lround(middle.y() / kSpacing) + i));
    grid.add(Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitX(), i * kSpacing,
             strength(std::lround(middle.x() / kSpacing) + i));
  }
  auto separator = make_coin<SoSeparator>();
  add_unlit_style(*separator.get(), 1.0F);
  separator->addChild(grid.make());
  return separator;
}

}  // namespace handway::gui
