#include "view3d/path_node.h"

#include "model/settings/view_colors.h"
#include "view3d/coin_conversions.h"
#include "view3d/ghost.h"
#include "view3d/shape_node.h"
#include "view3d/unlit_nodes.h"

#include <Inventor/nodes/SoBaseColor.h>
#include <Inventor/nodes/SoComplexity.h>
#include <Inventor/nodes/SoDepthBuffer.h>
#include <Inventor/nodes/SoLineSet.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSphere.h>
#include <Inventor/nodes/SoTranslation.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace handway::gui {

geometric::Color color_along(std::size_t i, std::size_t count) {
  const geometric::Color& a = kStartColor;
  const geometric::Color& b = kGoalColor;
  const float t = count > 1 ? static_cast<float>(i) / static_cast<float>(count - 1) : 0.0F;
  return {a.red + t * (b.red - a.red), a.green + t * (b.green - a.green),
          a.blue + t * (b.blue - a.blue), 1.0F};
}

namespace {

constexpr float kBeadRadius = 0.005F;  // m
constexpr geometric::Color kExecutedColor{0.80F, 0.12F, 0.46F, 1.0F};
constexpr geometric::Color kContactColor{0.93F, 0.05F, 0.60F, 1.0F};

SoSeparator* make_line(std::span<const Eigen::Vector3d> points, float width) {
  auto* separator = new SoSeparator;
  add_unlit_style(*separator, width);
  SoVertexProperty* properties = make_vertices(points);
  std::vector<std::uint32_t> colors;
  colors.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    colors.push_back(packed_rgba(color_along(i, points.size())));
  }
  properties->orderedRGBA.setValues(0, static_cast<int>(colors.size()), colors.data());
  properties->materialBinding = SoVertexProperty::PER_VERTEX;
  auto* line = new SoLineSet;
  line->vertexProperty = properties;
  separator->addChild(line);
  return separator;
}

// For what is seen through the robot, which would hide most of it.
CoinRef<SoSeparator> make_seen_through() {
  auto separator = make_coin<SoSeparator>();
  auto* through = new SoDepthBuffer;
  through->test = FALSE;
  separator->addChild(through);
  return separator;
}

// Of one colour, seen through everything.
CoinRef<SoSeparator> make_plain_line(std::span<const Eigen::Vector3d> points,
                                     const geometric::Color& rgb, float width) {
  auto separator = make_seen_through();
  auto* drawing = new SoSeparator;
  add_unlit_style(*drawing, width);
  auto* color = new SoBaseColor;
  color->rgb = to_coin(rgb);
  drawing->addChild(color);
  auto* line = new SoLineSet;
  line->vertexProperty = make_vertices(points);
  drawing->addChild(line);
  separator->addChild(drawing);
  return separator;
}

SoSeparator* make_bead(const Eigen::Vector3d& place, const geometric::Color& color) {
  auto* separator = new SoSeparator;
  auto* translation = new SoTranslation;
  translation->translation = to_coin(place);
  separator->addChild(translation);
  separator->addChild(make_material(color).get());
  separator->addChild(new SoComplexity);
  auto* ball = new SoSphere;
  ball->radius = kBeadRadius;
  separator->addChild(ball);
  return separator;
}

}  // namespace

Drawing make_trail_node(std::span<const Eigen::Vector3d> points) {
  return CoinRef<SoSeparator>(make_line(points, 1.5F));
}

Drawing make_executed_node(std::span<const Eigen::Vector3d> points) {
  return make_plain_line(points, kExecutedColor, 2.0F);
}

Drawing make_optimized_node(std::span<const Eigen::Vector3d> points,
                            std::span<const Eigen::Vector3d> waypoints) {
  CoinRef<SoSeparator> separator = make_plain_line(points, kOptimizedColor, 4.0F);
  for (const Eigen::Vector3d& waypoint : waypoints) {
    separator->addChild(make_bead(waypoint, kOptimizedColor));
  }
  return separator;
}

Drawing make_path_node(std::span<const Eigen::Vector3d> points,
                       std::span<const Eigen::Vector3d> waypoints) {
  auto separator = make_seen_through();
  separator->addChild(make_line(points, 3.0F));
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    separator->addChild(make_bead(waypoints[i], color_along(i, waypoints.size())));
  }
  return separator;
}

Drawing make_contacts_node(std::span<const Eigen::Vector3d> points) {
  auto separator = make_seen_through();
  for (const Eigen::Vector3d& point : points) {
    separator->addChild(make_bead(point, kContactColor));
  }
  return separator;
}

Drawing make_clearance_node(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  constexpr double kFar = 0.03;  // m, from which on all is green
  const auto t = static_cast<float>(std::min(1.0, (a - b).norm() / kFar));
  const geometric::Color color{std::min(0.90F, 1.8F * (1.0F - t)), std::min(0.68F, 1.36F * t),
                               0.12F, 1.0F};
  auto separator = make_seen_through();
  auto* line = new SoSeparator;
  add_unlit_style(*line, 2.5F, 7.0F);
  auto* base = new SoBaseColor;
  base->rgb = to_coin(color);
  line->addChild(base);
  const std::array ends{a, b};
  auto* segment = new SoLineSet;
  segment->vertexProperty = make_vertices(ends);
  line->addChild(segment);
  auto* dots = new RoundPoints;
  dots->vertexProperty = make_vertices(ends);
  line->addChild(dots);
  separator->addChild(line);
  return separator;
}

namespace {

const geometric::Color kVolumeColor{0.36F, 0.44F, 0.78F, Ghost::kFaint};

}  // namespace

Drawing make_trails_node(std::span<const std::vector<Eigen::Vector3d>> trails) {
  auto all = make_coin<SoSeparator>();
  for (const std::vector<Eigen::Vector3d>& trail : trails) {
    all->addChild(make_trail_node(trail).node());
  }
  return all;
}

Drawing make_copies_node(const geometric::RobotInstance& robot,
                         std::span<const geometric::Configuration> postures) {
  const LinkShapes shapes = make_link_shapes(*robot.model);
  auto all = make_coin<SoSeparator>();
  for (std::size_t i = 0; i < postures.size(); ++i) {
    geometric::Color color = color_along(i, postures.size());
    color.alpha = Ghost::kFaint;
    RobotNode copy(robot.model, shapes, color);
    copy.place(robot.X_WB, postures[i]);
    all->addChild(copy.root());
  }
  return all;
}

Drawing make_volume_node(std::shared_ptr<const geometric::TriangleMesh> mesh) {
  auto all = make_coin<SoSeparator>();
  all->addChild(make_material(kVolumeColor).get());
  all->addChild(make_shape_node(geometric::Mesh{.file = {}, .triangles = std::move(mesh)}).get());
  return all;
}

}  // namespace handway::gui
