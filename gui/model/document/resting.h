#pragma once

#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/geometric/scene/scene.h"
#include "model/document/scene_edits.h"

#include <optional>
#include <string>
#include <vector>

namespace handway::gui {

/// How far `upper` can sink along -z until it touches `lower`; both in the world.
/// Negative if it must be lifted because they overlap. Nothing if they are not
/// above each other anywhere. Exact for triangles: the least vertical distance is
/// found at a vertex over a face, a face over a vertex, or where two edges cross
/// in the view from above. Of `lower`, only what is not higher than the middle of
/// `upper` counts.
[[nodiscard]] std::optional<double> vertical_gap(const geometric::TriangleMesh& upper,
                                                 const geometric::TriangleMesh& lower);

/// The least vertical gap between an object that stands in the world and those of the scene
/// that it is above, m; negative where they overlap. Nothing if it is above none.
/// @param scene what is attached in it, and an object of that name, do not count.
[[nodiscard]] std::optional<double> gap_to_support(const geometric::Scene& scene,
                                                   const geometric::SceneObject& object);

/// From the floor (z = 0) to the lowest point of an object that stands in the world, m.
[[nodiscard]] double height_above_floor(const geometric::SceneObject& object);

/// Between an object that was put down and what it stands on, m.
inline constexpr double kRestingGap = 0.5e-3;

/// The objects sunk or lifted until they stand kRestingGap above other objects, or on the
/// floor (z = 0). Objects of a group that is named whole move together.
/// @param names of objects that stand in the world.
[[nodiscard]] SceneState dropped(SceneState state, const geometric::Configuration& q,
                                 const std::vector<std::string>& names);

/// By how much all of the objects together are to be raised so that those that stand in
/// the world keep kRestingGap to what they stand on; m. Those that are sunk into it by more
/// than 1 mm do not stand there by contact, and those in a link's frame are held: neither counts.
[[nodiscard]] double rise_to_clear(const SceneState& state, const std::vector<std::string>& names);

}  // namespace handway::gui
