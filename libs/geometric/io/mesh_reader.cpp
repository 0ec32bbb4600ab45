#include "handway/geometric/io/mesh_reader.h"

#include "handway/geometric/io/files_read.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/mesh_import.h"
#include "io/mesh_cleaning.h"

#include <map>
#include <mutex>
#include <system_error>
#include <tuple>
#include <utility>

namespace handway::geometric {
namespace {

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
    ImportedMesh imported;
    try {
      imported = import_mesh(file_, MeshFormat::kAssimp);
    } catch (const InputError& error) {
      refuse(error.problem().found, error.problem().expected, error.problem().advice);
    }
    TriangleMesh& raw = imported.triangles;
    for (Eigen::Vector3d& vertex : raw.vertices) {
      vertex = vertex.cwiseProduct(scale);
      if (!vertex.allFinite()) {
        refuse("a vertex that is not finite", "coordinates in metres",
               "Export the mesh again, or check its scale");
      }
    }
    if (const auto problem = rounding_problem(imported.largest * scale.cwiseAbs().maxCoeff())) {
      refuse(problem->found, problem->expected, problem->advice);
    }
    if (scale.prod() < 0.0) {
      for (auto& triangle : raw.triangles) {
        std::swap(triangle[1], triangle[2]);
      }
    }
    auto mesh = std::make_shared<TriangleMesh>(cleaned(raw));
    if (mesh->empty()) {
      refuse("no triangle with an area", "a surface",
             "Points and lines alone can't be checked for collision");
    }
    return mesh;
  }

 private:
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
