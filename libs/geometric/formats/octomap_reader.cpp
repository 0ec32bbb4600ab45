#include "handway/geometric/formats/octomap_reader.h"

#include "formats/cloud_formats.h"
#include "handway/geometric/io/number_text.h"

#include <fmt/format.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

constexpr std::size_t kValueBytes = 4;  // bytes of a node's probability, and of its colour
constexpr std::size_t kColorBytes = 3;

/// Checks that bytes hold a complete tree of at most 16 levels: the library assumes that.
class TreeBytes {
 public:
  explicit TreeBytes(const std::string& bytes) : bytes_(bytes) {}

  // Two bits for each child; both are set if it has children itself.
  [[nodiscard]] bool is_binary_node(int depth) {
    if (depth == kLevels || bytes_.size() - at_ < 2) {
      return false;
    }
    const unsigned bits = byte(at_) | byte(at_ + 1) << 8U;
    at_ += 2;
    for (unsigned child = 0; child < 8; ++child) {
      if ((bits >> (2 * child) & 3U) == 3U && !is_binary_node(depth + 1)) {
        return false;
      }
    }
    return true;
  }

  // The node's data, then a bit for each child.
  [[nodiscard]] bool is_full_node(int depth, std::size_t data) {
    if (bytes_.size() - at_ < data + 1) {
      return false;
    }
    const unsigned bits = byte(at_ + data);
    at_ += data + 1;
    for (unsigned child = 0; child < 8; ++child) {
      if ((bits >> child & 1U) != 0 && (depth == kLevels || !is_full_node(depth + 1, data))) {
        return false;
      }
    }
    return true;
  }

 private:
  static constexpr int kLevels = 16;

  [[nodiscard]] unsigned byte(std::size_t at) const {
    return static_cast<unsigned char>(bytes_[at]);
  }

  const std::string& bytes_;
  std::size_t at_ = 0;
};

void add_color(const octomap::OcTreeNode& /*node*/, std::size_t /*count*/, PointCloud& /*cloud*/) {}

void add_color(const octomap::ColorOcTreeNode& node, std::size_t count, PointCloud& cloud) {
  const octomap::ColorOcTreeNode::Color color = node.getColor();
  cloud.colors.insert(cloud.colors.end(), count, {color.r, color.g, color.b});
}

/// Adds the centres of the smallest cells in a leaf. @returns false if there are too many, or they
/// are too far away.
template <typename Leaf>
bool add_leaf(const Leaf& leaf, std::size_t edge, double resolution, PointCloud& cloud) {
  const std::size_t count = edge * edge * edge;
  if (count > kMostCloudPoints - cloud.size()) {
    return false;
  }
  constexpr double kMiddle = 32768.0;  // the key of the cell above the origin
  // The key of a coarse leaf is that of a cell at its middle.
  std::array<double, 3> lowest{};
  for (unsigned axis = 0; axis < 3; ++axis) {
    const std::size_t key = leaf.getKey()[axis] / edge * edge;
    lowest.at(axis) = static_cast<double>(key) - kMiddle + 0.5;
    const double farthest = std::abs(lowest.at(axis)) + static_cast<double>(edge);
    if (resolution * farthest > static_cast<double>(kLargestCloudCoordinate)) {
      return false;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t row = i / edge;
    const std::size_t layer = row / edge;
    const Eigen::Vector3d place(lowest[0] + static_cast<double>(i % edge),
                                lowest[1] + static_cast<double>(row % edge),
                                lowest[2] + static_cast<double>(layer));
    cloud.points.emplace_back((resolution * place).cast<float>());
  }
  add_color(*leaf, count, cloud);
  return true;
}

template <typename Tree>
std::optional<PointCloud> points_of(const OctomapData& map, std::size_t node_bytes) {
  TreeBytes whole(map.bytes);
  if (map.is_binary ? !whole.is_binary_node(0) : !whole.is_full_node(0, node_bytes)) {
    return std::nullopt;
  }
  Tree tree(map.resolution);
  std::istringstream stream(map.bytes);
  if (map.is_binary ? !tree.readBinaryData(stream) : !tree.readData(stream) || !stream) {
    return std::nullopt;
  }
  PointCloud cloud;
  cloud.cell = map.resolution;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const std::size_t edge = std::size_t{1} << (tree.getTreeDepth() - leaf.getDepth());
    if (tree.isNodeOccupied(*leaf) && !add_leaf(leaf, edge, map.resolution, cloud)) {
      return std::nullopt;
    }
  }
  return cloud;
}

/// The header of a file .bt or .ot: lines of a key and a value up to `data`.
class OctomapFileHeader {
 public:
  OctomapFileHeader(std::string_view content, const std::string& source)
      : rest_(content), source_(source) {}

  OctomapData read() {
    constexpr std::string_view kBegin = "# Octomap OcTree ";
    if (!rest_.starts_with(kBegin)) {
      refuse_cloud(source_, "", "another beginning", "an octomap (.bt or .ot)");
    }
    OctomapData map;
    map.is_binary = rest_.substr(kBegin.size()).starts_with("binary");
    constexpr int kMostLines = 100;
    for (int i = 0; i < kMostLines && !rest_.empty(); ++i) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      const std::vector<std::string_view> words = cells(trimmed(rest_.substr(0, end)), ' ');
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      if (!words.empty() && words.front() == "data") {
        map.bytes = rest_;
        check(map);
        return map;
      }
      if (words.size() == 2 && words.front() == "id") {
        map.kind = words.back();
      } else if (words.size() == 2 && words.front() == "res") {
        map.resolution = parse_number(words.back()).value_or(0.0);
      }
    }
    refuse_cloud(source_, "data", "no such line", "the header of an octomap");
  }

 private:
  void check(const OctomapData& map) const {
    if (map.kind != "OcTree" && map.kind != "ColorOcTree") {
      refuse_cloud(source_, "id", fmt::format("\"{:.40}\"", map.kind), "OcTree or ColorOcTree");
    }
    if (map.resolution < kSmallestCell || map.resolution > kLargestCell) {
      refuse_cloud(source_, "res", fmt::format("{:g}", map.resolution),
                   fmt::format("{:g} to {:g} m", kSmallestCell, kLargestCell));
    }
  }

  std::string_view rest_;
  const std::string& source_;
};

}  // namespace

ReadCloud read_octomap_file(std::string_view content, const std::string& source) {
  std::optional<PointCloud> cells = octomap_points(OctomapFileHeader(content, source).read());
  if (!cells) {
    refuse_cloud(source, "data",
                 "damaged data, more than 20 million cells, or cells farther away than 160 m",
                 "an octomap", "Save it again, or make it coarser");
  }
  return {*std::move(cells), {}};
}

std::optional<PointCloud> octomap_points(const OctomapData& map) {
  return map.kind == "ColorOcTree" ? points_of<octomap::ColorOcTree>(map, kValueBytes + kColorBytes)
                                   : points_of<octomap::OcTree>(map, kValueBytes);
}

}  // namespace handway::geometric
