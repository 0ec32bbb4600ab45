#pragma once

#include "handway/execution/motion/motion_record.h"

#include <QString>

#include <vector>

namespace handway::gui {

/// Draws how far each joint was from where it should have been, over time, a plot a joint, as
/// `PATH.png` and `PATH.svg`.
/// @throws geometric::InputError if one can't be written.
void write_motion_figure(const std::vector<execution::RecordedDevice>& devices,
                         const QString& path);

}  // namespace handway::gui
