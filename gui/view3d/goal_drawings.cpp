#include "view3d/goal_drawings.h"

#include "handway/geometric/mesh/shape.h"
#include "model/settings/options.h"
#include "view3d/coin_conversions.h"
#include "view3d/drawing_parts.h"
#include "view3d/unlit_nodes.h"

#include <Inventor/nodes/SoSeparator.h>

#include <array>
#include <cstddef>

namespace handway::gui {
namespace {

constexpr geometric::Color kReachedColor{0.13F, 0.60F, 0.28F, 1.0F};

const geometric::Color& color_of(PoseReached reached) {
  switch (reached) {
    case PoseReached::kYes:
      return kReachedColor;
    case PoseReached::kNo:
      return kViolatedColor;
    default:
      return kGoalColor;
  }
}

}  // namespace

Drawing make_goal_poses_node(const geometric::Scene& scene, std::span<const PoseReached> reached) {
  constexpr double kAxis = 0.1;      // m
  constexpr double kVisible = 2e-3;  // m, of tolerances
  auto separator = make_coin<SoSeparator>();
  for (std::size_t i = 0; i < scene.goal_poses.size(); ++i) {
    const geometric::PoseGoal& goal = scene.goal_poses[i];
    const geometric::Color& color =
        color_of(i < reached.size() ? reached[i] : PoseReached::kUnknown);
    add_axes(*separator.get(), goal.X_WG, kAxis);
    if (goal.position_tolerance.maxCoeff() >= kVisible) {
      add_veil(*separator.get(), geometric::Box{2.0 * goal.position_tolerance.cwiseMax(1e-4)},
               goal.X_WG, color);
    }
    separator->addChild(make_dot(goal.X_WG.translation(), color));
  }
  return separator;
}

Drawing make_reach_node(const Eigen::Vector3d& target, const Eigen::Vector3d& tool, bool reached) {
  auto separator = make_coin<SoSeparator>();
  const geometric::Color& color = color_of(reached ? PoseReached::kYes : PoseReached::kNo);
  if (!reached) {
    separator->addChild(
        make_edges_node(std::array{target, tool}, Edges{{0, 1}}, color, kAxisWidth));
  }
  separator->addChild(make_dot(target, color));
  return separator;
}

}  // namespace handway::gui
