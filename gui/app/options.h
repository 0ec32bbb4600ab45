#pragma once

#include "model/settings/options.h"

#include <optional>

namespace handway::gui {

/// Reads the command line. Prints help or what is wrong itself.
/// @param[out] exit_code what to end with if nothing is returned.
[[nodiscard]] std::optional<Options> parse_options(int argc, char** argv, int& exit_code);

}  // namespace handway::gui
