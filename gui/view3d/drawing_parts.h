#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/mesh/shape.h"
#include "view3d/coin_conversions.h"

#include <Eigen/Core>

#include <array>
#include <span>
#include <utility>
#include <vector>

class SoSeparator;

namespace handway::gui {

/// Line segments, given by the numbers of their end points.
using Edges = std::vector<std::pair<int, int>>;

inline constexpr geometric::Color kViolatedColor{0.86F, 0.16F, 0.14F, 1.0F};
inline constexpr geometric::Color kContactColor{0.93F, 0.05F, 0.60F, 1.0F};
inline constexpr float kEdgeWidth = 1.5F;  ///< px
inline constexpr float kAxisWidth = 3.0F;  ///< px
inline constexpr float kDotSize = 9.0F;    ///< px

/// The edges of a box, whose corners are numbered by their bits: 1 for x, 2 for y, 4 for z.
inline constexpr std::array<std::pair<int, int>, 12> kBoxEdges{{{0, 1},
                                                                {2, 3},
                                                                {4, 5},
                                                                {6, 7},
                                                                {0, 2},
                                                                {1, 3},
                                                                {4, 6},
                                                                {5, 7},
                                                                {0, 4},
                                                                {1, 5},
                                                                {2, 6},
                                                                {3, 7}}};

/// Returns the corners of a box, numbered as in kBoxEdges, in the frame that `X_WB` leads to.
[[nodiscard]] std::array<Eigen::Vector3d, 8> box_corners(const geometric::Pose& X_WB,
                                                         const Eigen::Vector3d& half_size);

/// Returns `a` with a share of its way to `b`, opaque.
[[nodiscard]] geometric::Color mixed(const geometric::Color& a, const geometric::Color& b,
                                     float share);

/// Adds a shape with faint faces.
void add_veil(SoSeparator& parent, const geometric::Shape& shape, const geometric::Pose& X_WS,
              geometric::Color color);

/// Adds a cone about `direction` (of length 1), open at its end. @param angle less than a right
/// one.
/// @param slant m, from the apex to the rim.
void add_open_cone(SoSeparator& parent, const Eigen::Vector3d& apex,
                   const Eigen::Vector3d& direction, double angle, double slant,
                   const geometric::Color& color);

/// Adds the axes of a frame: red, green and blue for x, y and z. @param length m.
void add_axes(SoSeparator& parent, const geometric::Pose& X_WF, double length);

/// Makes a dot at a point (world, m).
[[nodiscard]] SoSeparator* make_dot(const Eigen::Vector3d& point, const geometric::Color& color);

/// Makes a small ball at a point (world, m).
[[nodiscard]] SoSeparator* make_bead(const Eigen::Vector3d& place, const geometric::Color& color);

/// Makes an empty group whose content is seen through the robot, which would hide most of it.
[[nodiscard]] CoinRef<SoSeparator> make_seen_through();

/// Makes a line of one colour that is visible through everything.
[[nodiscard]] CoinRef<SoSeparator> make_plain_line(std::span<const Eigen::Vector3d> points,
                                                   const geometric::Color& rgb, float width);

}  // namespace handway::gui
