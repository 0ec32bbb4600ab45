#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/formats/mesh_stream.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace handway::geometric {

/// A mesh exactly as in its file: neither joined nor cleaned.
struct ImportedMesh {
  TriangleMesh triangles;       ///< All parts in the file's root frame.
  Color color;                  ///< Colour of the first triangle (Inventor files only).
  bool includes_files = false;  ///< Parts of it come from other files.
  /// The largest coordinate between the file's numbers and the root frame, in the units of
  /// `triangles`: the libraries read in single precision, which rounds by up to 6e-8 of it.
  double largest = 0.0;
  std::vector<std::string> warnings;
};

/// Reads a mesh file by a third-party library, in a process of its own: errors in that library do
/// not end this program.
///
/// The process may take 0.8 s of processor time and 0.8 s more for each MB of the file, 768 MB of
/// memory and 64 bytes more for each byte of the file. It may return a million vertices and
/// triangles and one more for each byte of the file. The program handway-mesh-reader, which
/// starts these processes, lies in the folder handway beside this library, or at
/// $HANDWAY_MESH_READER; it is started once and serves until this program ends. May be called
/// from any thread.
///
/// @param scale of an Inventor file, from its lengths to millimetres; the mesh is in metres. Meshes
/// of other formats are not scaled, except by DAE's unit (see read_mesh()).
/// @returns finite vertices and indices that are in range.
/// @throws InputError if the file is missing, no regular file or larger than 1 GB, can't be read,
/// has a vertex that is not finite or an index beyond its points; if reading it crashes, or takes
/// longer or more memory than allowed; if the program to read it is missing.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT ImportedMesh import_mesh(const std::filesystem::path& file,
                                                                MeshFormat format,
                                                                double scale = 1.0);

/// Returns the problem of a mesh that single precision has rounded by more than 10 µm, without a
/// source; nothing if it has not. @param largest coordinate (m), see ImportedMesh.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<InputProblem> rounding_problem(double largest);

/// Returns whether the file's name has an extension of a mesh format of assimp.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool is_assimp_file(const std::filesystem::path& file);

}  // namespace handway::geometric
