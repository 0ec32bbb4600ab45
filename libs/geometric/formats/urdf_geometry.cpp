#include "formats/urdf_geometry.h"

#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/formats/urdf.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

// "Write filename="…" if there is such a file nearby, else `otherwise`.
std::string mesh_advice(const std::string& filename, const fs::path& folder,
                        const std::string& otherwise) {
  std::optional<fs::path> found = find_file_below(folder, filename);
  found = found ? found : find_file_below(folder.parent_path(), filename);
  return found ? "Write filename=\"" + found->lexically_relative(folder).generic_string() +
                     "\": there is a file of this name"
               : otherwise;
}

/// The file that a robot file means by a mesh's `filename` (see read_urdf()).
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
  if (scheme != "package") {
    throw InputError({referenced_by, "mesh", "\"" + filename + "\"",
                      "a relative path, file:// or package://", "Copy the mesh beside the robot"});
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

  [[nodiscard]] LinkGeometry read(const urdf::GeometrySharedPtr& geometry,
                                  const urdf::Pose& origin) const {
    if (!geometry) {
      throw InputError({where_, element_, "a visual or collision without geometry",
                        "a box, sphere, cylinder or mesh", ""});
    }
    LinkGeometry result{shape(*geometry), pose_of(origin), {}};
    if (!result.X_LG.matrix().allFinite()) {
      throw InputError({where_, element_, "an origin that is not finite", "finite numbers", ""});
    }
    return result;
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

  // Where it is said to be, or else what the package path has of that name.
  [[nodiscard]] fs::path mesh_file(const std::string& filename) const {
    try {
      fs::path file = resolve_mesh_filename(filename, folder_, where_);
      if (!fs::exists(file)) {
        throw MissingMeshError({where_, element_, "no such file: " + file.string(), "a mesh",
                                mesh_advice(filename, folder_, "Check the path")});
      }
      return file;
    } catch (const MissingMeshError&) {
      const std::optional<fs::path> found = find_in_package_path(filename);
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
      LinkGeometry geometry = reader.read(visual->geometry, visual->origin);
      if (visual->material) {
        const urdf::Color& color = visual->material->color;
        geometry.color = {color.r, color.g, color.b, color.a};
      }
      result.visual.push_back(std::move(geometry));
    } catch (const InputError& fault) {
      files.drawing.add(fault);
    }
  }
  for (const urdf::CollisionSharedPtr& collision : link.collision_array) {
    result.collision.push_back(reader.read(collision->geometry, collision->origin));
  }
  return result;
}

}  // namespace handway::geometric
