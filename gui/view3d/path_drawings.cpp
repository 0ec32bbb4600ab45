#include "view3d/path_drawings.h"

#include "model/settings/options.h"
#include "view3d/coin_conversions.h"
#include "view3d/drawing_parts.h"
#include "view3d/ghost.h"
#include "view3d/robot_node.h"
#include "view3d/shape_node.h"
#include "view3d/unlit_nodes.h"

#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoSeparator.h>

#include <utility>

namespace handway::gui {
namespace {

constexpr geometric::Color kExecutedColor{0.80F, 0.12F, 0.46F, 1.0F};
const geometric::Color kVolumeColor{0.36F, 0.44F, 0.78F, Ghost::kFaint};

// In the colours from start to goal.
SoSeparator* make_line(std::span<const Eigen::Vector3d> points, float width) {
  std::vector<geometric::Color> colors;
  for (std::size_t i = 0; i < points.size(); ++i) {
    colors.push_back(color_along(i, points.size()));
  }
  return make_line_node(points, colors, width);
}

}  // namespace

geometric::Color color_along(std::size_t i, std::size_t count) {
  return mixed(kStartColor, kGoalColor,
               count > 1 ? static_cast<float>(i) / static_cast<float>(count - 1) : 0.0F);
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

Drawing make_trail_node(std::span<const Eigen::Vector3d> points) {
  return CoinRef<SoSeparator>(make_line(points, 1.5F));
}

Drawing make_trails_node(std::span<const std::vector<Eigen::Vector3d>> trails) {
  auto all = make_coin<SoSeparator>();
  for (const std::vector<Eigen::Vector3d>& trail : trails) {
    all->addChild(make_trail_node(trail).node());
  }
  return all;
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
