#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/mesh/point_cloud.h"

#include <optional>
#include <string>

namespace handway::geometric {

/// An octomap as it is sent and stored (octomap_msgs/Octomap).
struct OctomapData {
  std::string kind = "OcTree";  ///< "OcTree" or "ColorOcTree".
  double resolution = 0.0;      ///< Edge of the smallest cells, m.
  bool is_binary = false;       ///< Occupied or free alone, instead of probabilities.
  std::string bytes;
};

/// Returns the centres of the occupied cells, each of the smallest size, with the colours of a
/// ColorOcTree. Cells of unknown state are free, as in MoveIt.
/// @returns nothing if the bytes are no such tree, it has more than kMostCloudPoints such cells, or
/// one is farther away than kLargestCloudCoordinate.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<PointCloud> octomap_points(
    const OctomapData& map);

}  // namespace handway::geometric
