#pragma once

#include <filesystem>

namespace handway::tools {

/// Runs the program `handway-figures` beside this one, which draws pictures of robots: for the file
/// of a film strip, or for the folder of a basis. It runs on a display, or under xvfb-run without
/// one.
/// @throws InputError if the program or xvfb-run is missing or fails.
void draw_pictures(const std::filesystem::path& source);

}  // namespace handway::tools
