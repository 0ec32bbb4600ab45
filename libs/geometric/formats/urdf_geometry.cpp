#include "formats/urdf_geometry.h"

#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/formats/urdf.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

// Returns "Write filename="…"" if such a file is nearby, else `otherwise`.
std::string mesh_advice(const std::string& filename, const fs::path& folder,
                        const std::string& otherwise) {
  const fs::path file = with_slashes(filename);
  std::optional<fs::path> found = find_file_below(folder, file);
  found = found ? found : find_file_below(folder.parent_path(), file);
  return found ? "Write filename=\"" + found->lexically_relative(folder).generic_string() +
                     "\": there is a file of this name"
               : otherwise;
}

// Finds a file by the end of its name in the robot's folder or the one above, for robots that were
// copied out of their package, or whose package was renamed.
std::optional<fs::path> find_nearby(const std::string& filename, const fs::path& folder) {
  const fs::path whole = with_slashes(filename);
  for (auto begin = whole.begin(); begin != whole.end(); ++begin) {
    fs::path end;
    std::for_each(begin, whole.end(), [&](const fs::path& part) { end /= part; });
    for (const fs::path& top : {folder, folder.parent_path()}) {
      const fs::path file = existing_file(top / end.relative_path());
      std::error_code ignored;
      if (fs::is_regular_file(file, ignored)) {
        return file;
      }
    }
  }
  return std::nullopt;
}

/// Resolves a mesh's `filename` in a robot file (see read_urdf()).
/// @param folder of the robot file, absolute.
/// @param referenced_by "FILE:LINE", for messages.
/// @throws InputError if a package is not found or the scheme is unknown.
fs::path resolve_mesh_filename(const std::string& filename, const fs::path& folder,
                               const std::string& referenced_by) {
  const std::size_t colon = filename.find("://");
  if (colon == std::string::npos) {
    return existing_file((folder / filename).lexically_normal());
  }
  const std::string scheme = filename.substr(0, colon);
  const std::string rest = filename.substr(colon + 3);
  if (scheme == "file") {
    return existing_file(fs::path(rest).lexically_normal());
  }
  if (scheme != "package" && scheme != "model") {
    throw MissingMeshError({referenced_by, "mesh", "\"" + filename + "\"",
                            "a relative path, file:// or package://",
                            "Copy the mesh beside the robot"});
  }
  const std::string name = rest.substr(0, rest.find('/'));
  const std::optional<fs::path> package = find_package(name, folder);
  if (!package) {
    throw MissingMeshError(
        {referenced_by, "mesh", "\"" + filename + "\", but no folder \"" + name + "\"",
         "that folder at " + folder.string() +
             " or above, or in --package-path or "
             "$ROS_PACKAGE_PATH",
         mesh_advice(filename, folder, "Put the package there, or write a relative path")});
  }
  return existing_file((*package / fs::path(rest).lexically_relative(name)).lexically_normal());
}

class GeometryReader {
 public:
  GeometryReader(const std::string& link, std::filesystem::path folder, std::string referenced_by,
                 LinkFiles& files)
      : element_("link " + link),
        folder_(std::move(folder)),
        where_(std::move(referenced_by)),
        files_(files) {}

  // Reads a <visual> or <collision>; a capsule becomes three shapes.
  template <typename Element>
  [[nodiscard]] std::vector<LinkGeometry> read(const Element& element) const {
    if (!element.geometry) {
      throw InputError({where_, element_, "a visual or collision without geometry",
                        "a box, sphere, cylinder or mesh", ""});
    }
    const Pose X_LG = pose_of(element.origin);
    if (!X_LG.matrix().allFinite()) {
      throw InputError({where_, element_, "an origin that is not finite", "finite numbers", ""});
    }
    const Shape single = shape(*element.geometry);
    if (element.name != kCapsule) {
      return {{single, X_LG, {}}};
    }
    const auto& cylinder = std::get<Cylinder>(single);
    std::vector<LinkGeometry> parts;
    for (const auto& [part, X_GS] : capsule_shapes(cylinder.radius, cylinder.length)) {
      parts.push_back({part, X_LG * X_GS, {}});
    }
    return parts;
  }

 private:
  [[nodiscard]] Shape shape(const urdf::Geometry& geometry) const {
    switch (geometry.type) {
      case urdf::Geometry::BOX: {
        const urdf::Vector3& size = dynamic_cast<const urdf::Box&>(geometry).dim;
        return Box{{positive(size.x), positive(size.y), positive(size.z)}};
      }
      case urdf::Geometry::SPHERE:
        return Sphere{positive(dynamic_cast<const urdf::Sphere&>(geometry).radius)};
      case urdf::Geometry::CYLINDER: {
        const auto& cylinder = dynamic_cast<const urdf::Cylinder&>(geometry);
        return Cylinder{positive(cylinder.radius), positive(cylinder.length)};
      }
      case urdf::Geometry::MESH:
        break;
    }
    const auto& mesh = dynamic_cast<const urdf::Mesh&>(geometry);
    const Eigen::Vector3d scale(mesh.scale.x, mesh.scale.y, mesh.scale.z);
    const std::filesystem::path file = mesh_file(mesh.filename);
    if (differs_in_case(mesh.filename, file)) {
      files_.renamed.insert(mesh.filename);
    }
    return Mesh{file, scale, read_mesh(file, scale, where_)};
  }

  // Returns the file where MuJoCo would find it, if the URDF names MuJoCo's folder.
  [[nodiscard]] std::optional<fs::path> mesh_of_compiler(const std::string& filename) const {
    if (!files_.compiler) {
      return std::nullopt;
    }
    const std::size_t scheme = filename.find("://");
    const fs::path written =
        with_slashes(scheme == std::string::npos ? filename : filename.substr(scheme + 3));
    const fs::path name = files_.compiler->strips_path ? written.filename() : written;
    fs::path file =
        existing_file((folder_ / files_.compiler->mesh_folder / name).lexically_normal());
    std::error_code ignored;
    return fs::is_regular_file(file, ignored) ? std::optional(std::move(file)) : std::nullopt;
  }

  // Returns the file at its given path, or else one of that name from the package path.
  [[nodiscard]] fs::path mesh_file(const std::string& filename) const {
    if (std::optional<fs::path> file = mesh_of_compiler(filename)) {
      files_.by_compiler.insert(filename);
      return *std::move(file);
    }
    try {
      fs::path file = resolve_mesh_filename(filename, folder_, where_);
      if (!fs::exists(file)) {
        throw MissingMeshError({where_, element_, "no such file: " + file.string(), "a mesh",
                                mesh_advice(filename, folder_, "Check the path")});
      }
      return file;
    } catch (const MissingMeshError&) {
      std::optional<fs::path> found = find_in_package_path(filename);
      found = found ? found : find_nearby(filename, folder_);
      if (!found) {
        throw;
      }
      files_.found.insert(filename + " is " + found->string());
      return *found;
    }
  }

  [[nodiscard]] double positive(double size) const {
    if (!std::isfinite(size) || size <= 0.0) {
      throw InputError(
          {where_, element_, "a geometry of size " + std::to_string(size), "a size above 0 m", ""});
    }
    return size;
  }

  std::string element_;
  std::filesystem::path folder_;
  std::string where_;
  LinkFiles& files_;
};

}  // namespace

Pose pose_of(const urdf::Pose& pose) {
  Pose X = Pose::Identity();
  X.translation() = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  X.linear() =
      Eigen::Quaterniond(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z)
          .normalized()
          .toRotationMatrix();
  return X;
}

Link link_of(const urdf::Link& link, const std::filesystem::path& folder,
             const std::string& referenced_by, LinkFiles& files) {
  const GeometryReader reader(link.name, folder, referenced_by, files);
  Link result{link.name, {}, {}};
  for (const urdf::VisualSharedPtr& visual : link.visual_array) {
    try {
      for (LinkGeometry& geometry : reader.read(*visual)) {
        if (visual->material) {
          const urdf::Color& color = visual->material->color;
          geometry.color = {color.r, color.g, color.b, color.a};
        }
        result.visual.push_back(std::move(geometry));
      }
    } catch (const InputError& fault) {
      files.drawing.add(fault);
    }
  }
  for (const urdf::CollisionSharedPtr& collision : link.collision_array) {
    try {
      std::ranges::move(reader.read(*collision), std::back_inserter(result.collision));
    } catch (const MissingMeshError& fault) {
      files.missing.add(fault.problem(),
                        dynamic_cast<const urdf::Mesh&>(*collision->geometry).filename);
    }
  }
  return result;
}

void MissingMeshes::add(const InputProblem& problem, const std::string& name) {
  first_ = first_.value_or(problem);
  names_.insert(name);
}

void MissingMeshes::refuse() const {
  if (!first_) {
    return;
  }
  InputProblem problem = *first_;
  if (names_.size() > 1) {
    problem.found += fmt::format(" ({} collision meshes are missing in all)", names_.size());
  }
  throw MissingMeshError(problem);
}

std::string LinkFiles::found_elsewhere() const {
  constexpr std::size_t kMostNamed = 3;
  if (found.empty()) {
    return "";
  }
  std::vector<std::string> named(found.begin(), found.end());
  const std::size_t others = named.size() - std::min(kMostNamed, named.size());
  named.resize(named.size() - others);
  return fmt::format("meshes that are not where the file says were looked for: {}{}",
                     fmt::join(named, ", "),
                     others > 0 ? fmt::format(", and {} more", others) : "");
}

}  // namespace handway::geometric
