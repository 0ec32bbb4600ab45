#pragma once

#include <filesystem>

namespace handway::import_sdf {

/// Returns whether the file's name ends in .sdf, or in .world or .xml with <sdf near its beginning.
[[nodiscard]] bool is_sdf_file(const std::filesystem::path& file);

}  // namespace handway::import_sdf
