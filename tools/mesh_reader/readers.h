#pragma once

#include "reply.h"

#include <filesystem>

namespace handway::mesh_reader {

/// Prepares assimp and Coin, once for all processes.
void prepare_assimp();
void prepare_inventor();

/// All triangles of the file in its root frame, as assimp reads it.
/// @throws Refusal, TooLarge
void read_by_assimp(const std::filesystem::path& file, Mesh& mesh);

/// All triangles of an Open Inventor or VRML file whose lengths, times `scale`, are millimetres; in
/// metres. Included files are searched in its own folder.
/// @throws Refusal, TooLarge
void read_inventor(const std::filesystem::path& file, double scale, Mesh& mesh);

}  // namespace handway::mesh_reader
