#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "model/document/scene_state.h"

#include <string>
#include <vector>

/// Objects that stand on others. What touches is a collision as soon as it is carried, so
/// that objects are put down with a small gap, from which a hand can lift them.
namespace handway::gui {

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
