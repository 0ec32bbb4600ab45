#include "octomap_mesh.h"

#include "handway/geometric/io/number_text.h"

#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

namespace handway::import_moveit {
namespace {

using geometric::TriangleMesh;
using geometric::YamlElement;

constexpr std::size_t kMostTriangles = 4'000'000;
constexpr double kBytes = 256.0;
constexpr std::size_t kValueBytes = 4;  // bytes of a node's probability, and of its colour
constexpr std::size_t kColorBytes = 3;

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

/// The free sides of a tree's occupied cells, all of the finest size, so that corners meet corners.
template <typename Tree>
class Surface {
 public:
  Surface(const Tree& tree, const YamlElement& octomap) : tree_(tree), octomap_(octomap) {
    for (auto leaf = tree_.begin_leafs(); leaf != tree_.end_leafs(); ++leaf) {
      if (tree_.isNodeOccupied(*leaf)) {
        const auto cells = std::int64_t{1} << (tree_.getTreeDepth() - leaf.getDepth());
        // The key of a coarse leaf is that of a cell at its middle.
        const octomap::OcTreeKey& key = leaf.getKey();
        Cell lowest{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          lowest[axis] = static_cast<std::int64_t>(key[axis]) / cells * cells;
        }
        add_sides(lowest, cells);
      }
    }
  }

  [[nodiscard]] std::shared_ptr<const TriangleMesh> mesh() && {
    return mesh_.empty() ? nullptr : std::make_shared<const TriangleMesh>(std::move(mesh_));
  }

 private:
  using Cell = std::array<std::int64_t, 3>;

  void add_sides(const Cell& lowest, std::int64_t cells) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t u = (axis + 1) % 3;
      const std::size_t v = (axis + 2) % 3;
      for (const bool upper : {false, true}) {
        Cell cell = lowest;
        cell[axis] += upper ? cells - 1 : 0;
        for (cell[u] = lowest[u]; cell[u] < lowest[u] + cells; ++cell[u]) {
          for (cell[v] = lowest[v]; cell[v] < lowest[v] + cells; ++cell[v]) {
            add_side(cell, axis, upper);
          }
        }
      }
    }
  }

  void add_side(const Cell& cell, std::size_t axis, bool upper) {
    Cell neighbour = cell;
    neighbour[axis] += upper ? 1 : -1;
    if (is_occupied(neighbour)) {
      return;
    }
    if (mesh_.triangles.size() + 2 > kMostTriangles) {
      octomap_.refuse("an octomap with more than 2 million free sides of cells", "a smaller one",
                      "Make it coarser or cut it");
    }
    std::array<std::uint32_t, 4> corners{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      Cell corner = cell;
      corner[axis] += upper ? 1 : 0;
      corner[(axis + 1) % 3] += i == 1 || i == 2 ? 1 : 0;
      corner[(axis + 2) % 3] += i >= 2 ? 1 : 0;
      corners[i] = vertex(corner);
    }
    if (!upper) {
      std::swap(corners[1], corners[3]);
    }
    mesh_.triangles.push_back({corners[0], corners[1], corners[2]});
    mesh_.triangles.push_back({corners[0], corners[2], corners[3]});
  }

  [[nodiscard]] bool is_occupied(const Cell& cell) const {
    octomap::OcTreeKey key;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (cell[axis] < 0 || cell[axis] > 0xFFFF) {
        return false;
      }
      key[static_cast<unsigned>(axis)] = static_cast<octomap::key_type>(cell[axis]);
    }
    const auto* node = tree_.search(key);
    return node != nullptr && tree_.isNodeOccupied(node);
  }

  std::uint32_t vertex(const Cell& corner) {
    const auto [place, is_new] =
        numbers_.emplace(corner, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) {
      constexpr double kMiddle = 32768.0;  // the key of the cell above the origin
      mesh_.vertices.push_back(
          tree_.getResolution() *
          (Eigen::Vector3d(static_cast<double>(corner[0]), static_cast<double>(corner[1]),
                           static_cast<double>(corner[2]))
               .array() -
           kMiddle));
    }
    return place->second;
  }

  const Tree& tree_;
  const YamlElement& octomap_;
  std::map<Cell, std::uint32_t> numbers_;
  TriangleMesh mesh_;
};

[[noreturn]] void refuse(const YamlElement& octomap) {
  octomap.refuse("an octomap whose data can't be read",
                 "octomap_msgs/Octomap of an OcTree or a ColorOcTree, as it was sent");
}

template <typename Tree>
std::shared_ptr<const TriangleMesh> surface_of(const YamlElement& octomap, double resolution,
                                               const std::string& bytes, std::size_t node_bytes) {
  TreeBytes whole(bytes);
  if (is_binary(octomap) ? !whole.is_binary_node(0) : !whole.is_full_node(0, node_bytes)) {
    refuse(octomap);
  }
  Tree tree(resolution);
  std::istringstream stream(bytes);
  if (is_binary(octomap)) {
    if (!tree.readBinaryData(stream)) {
      refuse(octomap);
    }
  } else if (!tree.readData(stream) || !stream) {
    refuse(octomap);
  }
  return Surface<Tree>(tree, octomap).mesh();
}

}  // namespace

std::shared_ptr<const TriangleMesh> octomap_mesh(const YamlElement& octomap) {
  const std::optional<YamlElement> data = octomap.find("data");
  if (!data || data->items().empty()) {
    return nullptr;
  }
  octomap.refuse_slips({"header", "binary", "id", "resolution", "data"});
  const YamlElement resolution = octomap.need("resolution");
  if (resolution.number() <= 0.0) {
    resolution.refuse(resolution.found(), "a size of cells above 0 m");
  }
  const std::string kind = octomap.text_or("id", "OcTree");
  if (kind == "ColorOcTree") {
    return surface_of<octomap::ColorOcTree>(octomap, resolution.number(), bytes_of(*data),
                                            kValueBytes + kColorBytes);
  }
  if (kind != "OcTree") {
    const YamlElement id = octomap.need("id");
    id.refuse(id.found(), "OcTree or ColorOcTree");
  }
  return surface_of<octomap::OcTree>(octomap, resolution.number(), bytes_of(*data), kValueBytes);
}

}  // namespace handway::import_moveit
