#include "handway/geometric/formats/mesh_reader.h"

#include "handway/geometric/formats/mesh_import.h"
#include "handway/geometric/io/disk_cache.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "mesh/vertex_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

namespace handway::geometric {
namespace {

bool is_inventor_file(const std::filesystem::path& file) {
  return has_extension(file, ".iv") || has_extension(file, ".wrl") || has_extension(file, ".vrml");
}

bool has_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  // The height over the longer side, relative to it, must exceed rounding.
  return ab.cross(ac).norm() > 1e-12 * std::max(ab.squaredNorm(), ac.squaredNorm());
}

/// `mesh` with equal vertices joined, and without triangles without area and unused vertices. Order
/// is kept.
TriangleMesh cleaned(const TriangleMesh& mesh) {
  VertexTable places;
  TriangleMesh result;
  result.triangles.reserve(mesh.triangles.size());
  for (const auto& [i, j, k] : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[i];
    const Eigen::Vector3d& b = mesh.vertices[j];
    const Eigen::Vector3d& c = mesh.vertices[k];
    if (has_area(a, b, c)) {
      const std::uint32_t first = places.number_of(a);
      const std::uint32_t second = places.number_of(b);
      result.triangles.push_back({first, second, places.number_of(c)});
    }
  }
  result.vertices = std::move(places.vertices());
  return result;
}

namespace fs = std::filesystem;

using FileKey = std::tuple<fs::path, std::uintmax_t, fs::file_time_type, double, double, double>;

class MeshCache {
 public:
  std::shared_ptr<const TriangleMesh> find(const FileKey& key) {
    const std::lock_guard lock(mutex_);
    const auto entry = meshes_.find(key);
    return entry == meshes_.end() ? nullptr : entry->second.lock();
  }

  /// Returns what another thread stored meanwhile, or `mesh`.
  std::shared_ptr<const TriangleMesh> store(const FileKey& key,
                                            std::shared_ptr<const TriangleMesh> mesh) {
    const std::lock_guard lock(mutex_);
    std::erase_if(meshes_, [](const auto& entry) { return entry.second.expired(); });
    std::weak_ptr<const TriangleMesh>& slot = meshes_[key];
    if (std::shared_ptr<const TriangleMesh> other = slot.lock()) {
      return other;
    }
    slot = mesh;
    return mesh;
  }

 private:
  std::mutex mutex_;
  std::map<FileKey, std::weak_ptr<const TriangleMesh>> meshes_;
};

/// Triangles exactly as in their file, m.
struct ReadMesh {
  TriangleMesh triangles;
  double largest = 0.0;  ///< See ImportedMesh.
};

constexpr int kRevision = 1;  // to change with what is made of a file

// The content of a file that refers to no other file.
std::optional<std::string> worth_remembering(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  const bool is_whole = ending == ".stl" || ending == ".ply" || ending == ".obj";
  if (error || size > DiskCache::kBudget || !is_whole) {
    return std::nullopt;
  }
  std::string content(size, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(content.data(), static_cast<std::streamsize>(size));
  return stream ? std::optional(std::move(content)) : std::nullopt;
}

template <typename Value>
void append_bytes(std::string& bytes, const Value* values, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
}

template <typename Value>
void take_bytes(std::string_view& bytes, Value* values, std::size_t count) {
  if (bytes.size() / sizeof(Value) < count) {
    throw std::length_error("fewer bytes than they say");
  }
  const std::string_view taken = bytes.substr(0, count * sizeof(Value));
  std::ranges::copy(taken, reinterpret_cast<char*>(values));
  bytes.remove_prefix(taken.size());
}

std::string to_bytes(const ReadMesh& mesh) {
  const auto& [vertices, triangles] = mesh.triangles;
  const std::array<std::uint64_t, 2> counts{vertices.size(), triangles.size()};
  std::string bytes;
  append_bytes(bytes, &mesh.largest, 1);
  append_bytes(bytes, counts.data(), counts.size());
  append_bytes(bytes, vertices.data(), vertices.size());
  append_bytes(bytes, triangles.data(), triangles.size());
  return bytes;
}

ReadMesh from_bytes(const std::string& entry) {
  std::string_view bytes(entry);
  ReadMesh mesh;
  std::array<std::uint64_t, 2> counts{};
  take_bytes(bytes, &mesh.largest, 1);
  take_bytes(bytes, counts.data(), counts.size());
  mesh.triangles.vertices.resize(std::min<std::uint64_t>(counts[0], bytes.size()));
  mesh.triangles.triangles.resize(std::min<std::uint64_t>(counts[1], bytes.size()));
  take_bytes(bytes, mesh.triangles.vertices.data(), counts[0]);
  take_bytes(bytes, mesh.triangles.triangles.data(), counts[1]);
  return mesh;
}

class MeshSource {
 public:
  MeshSource(fs::path file, std::string referenced_by)
      : file_(std::move(file)), referenced_by_(std::move(referenced_by)) {}

  [[noreturn]] void refuse(const std::string& found, const std::string& expected,
                           const std::string& advice = "") const {
    if (referenced_by_.empty()) {
      throw InputError({file_.string(), "mesh", found, expected, advice});
    }
    throw InputError({referenced_by_, "mesh " + file_.string(), found, expected, advice});
  }

  [[nodiscard]] std::shared_ptr<const TriangleMesh> read(const Eigen::Vector3d& scale) const {
    const bool is_uniform = scale.x() == scale.y() && scale.y() == scale.z() && scale.x() > 0.0;
    ReadMesh unscaled = is_uniform ? read_or_remember() : import();
    TriangleMesh& mesh = unscaled.triangles;
    for (Eigen::Vector3d& vertex : mesh.vertices) {
      vertex = vertex.cwiseProduct(scale);
      if (!vertex.allFinite()) {
        refuse("a vertex that is not finite", "coordinates in metres",
               "Export the mesh again, or check its scale");
      }
    }
    if (const auto problem = rounding_problem(unscaled.largest * scale.cwiseAbs().maxCoeff())) {
      refuse(problem->found, problem->expected, problem->advice);
    }
    if (scale.prod() < 0.0) {
      for (auto& triangle : mesh.triangles) {
        std::swap(triangle[1], triangle[2]);
      }
    }
    auto cleaned_mesh =
        std::make_shared<TriangleMesh>(is_uniform ? std::move(mesh) : cleaned(mesh));
    if (cleaned_mesh->empty()) {
      refuse("no triangle with an area", "a surface",
             "Points and lines alone can't be checked for collision");
    }
    return cleaned_mesh;
  }

 private:
  [[nodiscard]] ReadMesh import() const {
    try {
      constexpr double kMetres = 1000.0;  // of an Inventor file, in millimetres
      ImportedMesh imported = is_inventor_file(file_)
                                  ? import_mesh(file_, MeshFormat::kInventor, kMetres)
                                  : import_mesh(file_, MeshFormat::kAssimp);
      return {std::move(imported.triangles), imported.largest};
    } catch (const InputError& error) {
      refuse(error.problem().found, error.problem().expected, error.problem().advice);
    }
  }

  // Cleaned mesh. A file that needs no other is read once for all uniform scales.
  [[nodiscard]] ReadMesh read_or_remember() const {
    const std::optional<std::string> content = worth_remembering(file_);
    if (!content) {
      ReadMesh mesh = import();
      mesh.triangles = cleaned(mesh.triangles);
      return mesh;
    }
    const DiskCache cache = DiskCache::of_user();
    const CacheKey key = cache_key(fmt::format("triangles {}", kRevision), *content);
    if (std::optional<ReadMesh> known = cache.read_as(key, from_bytes)) {
      return *std::move(known);
    }
    ReadMesh mesh = import();
    mesh.triangles = cleaned(mesh.triangles);
    cache.write(key, to_bytes(mesh));
    return mesh;
  }

  fs::path file_;
  std::string referenced_by_;
};

}  // namespace

std::shared_ptr<const TriangleMesh> read_mesh(const fs::path& file, const Eigen::Vector3d& scale,
                                              const std::string& referenced_by) {
  static MeshCache cache;
  const MeshSource source(file, referenced_by);
  if (!scale.allFinite() || (scale.array() == 0.0).any()) {
    source.refuse("a scale that is zero or not finite", "three numbers other than 0");
  }
  std::error_code error;
  const fs::path canonical = fs::canonical(file, error);
  if (error) {
    source.refuse(error == std::errc::no_such_file_or_directory ? "no such file" : error.message(),
                  "a mesh file", "Check the path");
  }
  if (!fs::is_regular_file(canonical, error)) {
    source.refuse("something that is not a file", "a mesh file");
  }
  note_file_read(canonical);
  std::error_code ignored;
  const FileKey key(canonical, fs::file_size(canonical, ignored),
                    fs::last_write_time(canonical, ignored), scale.x(), scale.y(), scale.z());
  if (std::shared_ptr<const TriangleMesh> known = cache.find(key)) {
    return known;
  }
  return cache.store(key, source.read(scale));
}

bool is_mesh_file(const fs::path& file) { return is_assimp_file(file); }

}  // namespace handway::geometric
