#pragma once

#include <filesystem>
#include <vector>

namespace handway::tools {

/// What `handway bench` measures unless told otherwise: the scenes that ship, by name;
/// and, if $HANDWAY_REFERENCE_DIR is set, the published problems 1 to 4.
/// @throws InputError if that folder holds none of them.
[[nodiscard]] std::vector<std::filesystem::path> bench_scenes();

}  // namespace handway::tools
