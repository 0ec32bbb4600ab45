#include "octomap_mesh.h"

#include "handway/geometric/formats/octomap_reader.h"
#include "handway/geometric/mesh/point_cloud.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace handway::import_moveit {
namespace {

using geometric::OctomapData;
using geometric::TriangleMesh;
using geometric::YamlElement;

constexpr double kBytes = 256.0;

std::string bytes_of(const YamlElement& data) {
  std::string bytes;
  for (const YamlElement& item : data.items()) {
    const double value = item.number();
    if (value != std::floor(value) || value < -kBytes / 2 || value >= kBytes) {
      item.refuse(item.found(), "a byte, -128 to 255");
    }
    bytes += static_cast<char>(static_cast<std::uint8_t>(static_cast<int>(value) & 0xFF));
  }
  return bytes;
}

bool is_binary(const YamlElement& octomap) {
  const std::optional<YamlElement> binary = octomap.find("binary");
  if (!binary) {
    return true;
  }
  const std::string word = binary->text();
  return word == "True" || word == "1" || (word != "False" && word != "0" && binary->flag());
}

std::string tree_kind(const YamlElement& octomap) {
  std::string kind = octomap.text_or("id", "OcTree");
  if (kind != "OcTree" && kind != "ColorOcTree") {
    const YamlElement id = octomap.need("id");
    id.refuse(id.found(), "OcTree or ColorOcTree");
  }
  return kind;
}

double resolution_of(const YamlElement& octomap) {
  const YamlElement resolution = octomap.need("resolution");
  if (resolution.number() < geometric::kSmallestCell) {
    resolution.refuse(resolution.found(), "a size of cells of 0.001 m or more");
  }
  return resolution.number();
}

}  // namespace

std::shared_ptr<const TriangleMesh> octomap_mesh(const YamlElement& octomap) {
  const std::optional<YamlElement> data = octomap.find("data");
  if (!data || data->items().empty()) {
    return nullptr;
  }
  octomap.refuse_slips({"header", "binary", "id", "resolution", "data"});
  const OctomapData map{tree_kind(octomap), resolution_of(octomap), is_binary(octomap),
                        bytes_of(*data)};
  const std::optional<geometric::PointCloud> cells = geometric::octomap_points(map);
  if (!cells) {
    octomap.refuse(
        "an octomap whose data can't be read, with more than 20 million cells, or with cells "
        "farther away than 160 m",
        "octomap_msgs/Octomap of an OcTree or a ColorOcTree, as it was sent");
  }
  std::optional<TriangleMesh> surface = geometric::cells_around(*cells, {map.resolution, 0.0});
  if (!surface) {
    octomap.refuse("an octomap with more than 2 million free sides of cells", "a smaller one",
                   "Make it coarser or cut it");
  }
  return surface->empty() ? nullptr : std::make_shared<const TriangleMesh>(*std::move(surface));
}

}  // namespace handway::import_moveit
