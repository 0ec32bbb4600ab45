#pragma once

#include "cyberglove_commands.h"
#include "handway/device/glove/cyberglove.h"

namespace handway::device {

/// Brings a CyberGlove interface unit from any state to where it can be sampled: 22 or 18
/// sensors, neither time stamp nor status in its records.
/// @returns everything but `device`.
/// @throws DeviceError if nobody answers, something else than a CyberGlove does, there is no glove
/// on the unit, or the rate is too high for it.
[[nodiscard]] GloveInfo set_up_cyberglove(CyberGloveCommands& commands, const std::string& device,
                                          const CyberGloveSettings& settings,
                                          const std::stop_token& stop);

/// Whether the glove is on its unit and ready. Nothing if the unit doesn't answer.
[[nodiscard]] std::optional<bool> glove_is_ready(CyberGloveCommands& commands,
                                                 const std::stop_token& stop);

}  // namespace handway::device
