#pragma once

#include <QString>

#include <cstddef>
#include <string>

namespace handway::gui {

/// Returns the displayed name of a joint: "ring_abduction" is "Ring abduction".
[[nodiscard]] QString joint_label(const std::string& joint);

/// Returns the displayed name of a finger, which is an index of device::Finger.
[[nodiscard]] QString finger_label(std::size_t finger);

}  // namespace handway::gui
