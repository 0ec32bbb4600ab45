#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/scene/triangle_mesh.h"

#include <filesystem>

namespace handway::geometric {

/// Writes a mesh as Wavefront OBJ, metres; the file is replaced whole.
/// @throws InputError if it can't be written.
HANDWAY_GEOMETRIC_EXPORT void write_obj(const TriangleMesh& mesh,
                                        const std::filesystem::path& file);

}  // namespace handway::geometric
