#pragma once

#include <filesystem>

namespace handway::tools {

/// Has the program `handway-figures` beside this one draw the figures of a folder or file: by
/// itself on a display, under xvfb-run without one.
/// @throws InputError if the program or xvfb-run isn't there or fails.
void draw_figures(const std::filesystem::path& source);

}  // namespace handway::tools
