#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/mesh/point_cloud.h"
#include "handway/geometric/mesh/shape.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace handway::geometric {

/// The points of a file.
struct ReadCloud {
  PointCloud cloud;
  std::vector<std::string> warnings;  ///< Contents of the file that the cloud has not.
};

/// Reads the points of a file, in metres, in the file's axes:
/// - PCD (.pcd): fields x, y, z and rgb or rgba; ascii, binary, binary_compressed;
/// - PLY (.ply): x, y, z and red, green, blue of its vertices; ASCII and both binary forms;
/// - text (.xyz, .pts, .asc, .txt, .csv): three numbers a line, or x y z r g b; cells after them
///   are left out. Lines with another number of cells in front of the points are left out (a
///   header, a count);
/// - NumPy (.npy): arrays n×3 or n×6 (with colours), or h×w×3 of an organised cloud;
/// - octomap (.bt, .ot): the centres of the occupied cells.
///
/// Points that are not finite are left out: a camera has measured nothing there.
/// @param referenced_by the place that names the file, for messages ("scene.yaml:12").
/// @throws InputError if the file is missing, damaged or larger than 2 GB, has no points or more
/// than kMostCloudPoints, or a coordinate beyond kLargestCloudCoordinate.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT ReadCloud read_cloud(const std::filesystem::path& file,
                                                            const std::string& referenced_by = "");

/// Returns whether a file is a point cloud, by its name; a PLY file if it has no faces, a NumPy
/// file if its shape is that of points, and not of the 21 landmarks of hands.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool is_cloud_file(const std::filesystem::path& file);

/// Returns the cells for points unless others are asked for: those of an octomap, or of 10 mm.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT CloudCells usual_cells(const PointCloud& cloud);

/// Makes the body of points. @param source of the points, for messages.
/// @throws InputError if there are no points, or too many cells around them.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Cloud make_cloud(std::shared_ptr<const PointCloud> points,
                                                        const CloudCells& cells,
                                                        const std::string& source);

/// Writes points as a binary PLY file, with their colours.
/// @throws OutputError if that fails; an old file is then as it was.
HANDWAY_GEOMETRIC_EXPORT void write_ply(const PointCloud& cloud, const std::filesystem::path& file);

}  // namespace handway::geometric
