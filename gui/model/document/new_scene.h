#pragma once

#include "handway/planning/core/plugin.h"

#include <string>

namespace handway::gui {

/// A scene with nothing but a robot of the library, and the first hand basis of the
/// library that fits it. @throws InputError if there is no such robot.
[[nodiscard]] planning::LoadedScene new_scene(const std::string& robot,
                                              const planning::Extensions& extensions);

}  // namespace handway::gui
