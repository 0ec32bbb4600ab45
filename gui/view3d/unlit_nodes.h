#pragma once

#include "handway/geometric/mesh/shape.h"

#include <Inventor/nodes/SoPointSet.h>

#include <Eigen/Core>

#include <span>
#include <utility>
#include <vector>

class SoGroup;
class SoSeparator;
class SoVertexProperty;

namespace handway::gui {

/// Adds a style such that all later nodes in `group` are drawn in their plain colours, without
/// lighting, with lines `line_width` and points `point_size` pixels wide.
void add_unlit_style(SoGroup& group, float line_width, float point_size = 1.0F);

/// Points [m, W] for a Coin line or point set.
/// @param colors one of all points, or one of each; empty: those of what is drawn before.
[[nodiscard]] SoVertexProperty* make_vertices(std::span<const Eigen::Vector3d> points,
                                              const std::vector<geometric::Color>& colors = {});

/// Points drawn as discs with smooth edges.
class RoundPoints : public SoPointSet {
  SO_NODE_HEADER(RoundPoints);

 public:
  static void initClass();
  RoundPoints();

  void GLRender(SoGLRenderAction* action) override;

 protected:
  ~RoundPoints() override = default;
};

/// A line through points [m, W]. @param colors as for make_vertices(). @param width [pixels]
[[nodiscard]] SoSeparator* make_line_node(std::span<const Eigen::Vector3d> points,
                                          const std::vector<geometric::Color>& colors, float width);
/// A dot at each of the points [m, W]. @param size [pixels]
[[nodiscard]] SoSeparator* make_dots_node(std::span<const Eigen::Vector3d> points,
                                          const std::vector<geometric::Color>& colors, float size);

/// Straight lines between points that are given by their numbers.
/// @param points [m, W]
/// @param width of the lines [pixels]
[[nodiscard]] SoSeparator* make_edges_node(std::span<const Eigen::Vector3d> points,
                                           std::span<const std::pair<int, int>> edges,
                                           const geometric::Color& color, float width);

}  // namespace handway::gui
