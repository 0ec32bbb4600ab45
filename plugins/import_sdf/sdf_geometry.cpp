#include "sdf_geometry.h"

#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/mesh/shape.h"

#include <cstdlib>
#include <optional>
#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Ellipsoid.hh>
#include <sdf/Mesh.hh>
#include <sdf/Sphere.hh>
#include <sstream>
#include <string_view>
#include <system_error>

namespace handway::import_sdf {
namespace {

namespace fs = std::filesystem;
using geometric::Pose;
using geometric::Shape;

Eigen::Vector3d vector_of(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

// A model's folder as Gazebo finds it, or a package's.
std::optional<fs::path> model_folder(const std::string& name, const fs::path& folder) {
  if (const std::optional<fs::path> found = geometric::find_package(name, folder)) {
    return found;
  }
  for (const char* variable :
       {"GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH"}) {
    const char* value = std::getenv(variable);
    std::istringstream paths(value != nullptr ? value : "");
    for (std::string path; std::getline(paths, path, ':');) {
      std::error_code ignored;
      if (!path.empty() && fs::is_directory(fs::path(path) / name, ignored)) {
        return fs::path(path) / name;
      }
    }
  }
  return std::nullopt;
}

fs::path mesh_file(const std::string& uri, const fs::path& folder, const std::string& where) {
  const std::size_t colon = uri.find("://");
  if (colon == std::string::npos) {
    return geometric::existing_file((folder / uri).lexically_normal());
  }
  const std::string scheme = uri.substr(0, colon);
  const fs::path rest = uri.substr(colon + 3);
  if (scheme == "file") {
    return geometric::existing_file((rest.is_absolute() ? rest : folder / rest).lexically_normal());
  }
  const std::string name = rest.empty() ? "" : rest.begin()->string();
  const std::optional<fs::path> model =
      scheme == "model" || scheme == "package" ? model_folder(name, folder) : std::nullopt;
  if (!model) {
    throw geometric::InputError({where, "mesh", "\"" + uri + "\", but no folder \"" + name + "\"",
                                 "a relative path, file://, model:// or package://",
                                 "Name the folder that holds it with --package-path"});
  }
  return geometric::existing_file((*model / rest.lexically_relative(name)).lexically_normal());
}

geometric::Mesh mesh_of(const sdf::Mesh& from, const fs::path& folder, const std::string& where) {
  geometric::Mesh mesh;
  mesh.file = mesh_file(from.Uri(), folder, where);
  mesh.scale = vector_of(from.Scale());
  mesh.triangles = geometric::read_mesh(mesh.file, mesh.scale, where);
  return mesh;
}

}  // namespace

Pose pose_of(const ignition::math::Pose3d& pose) {
  Pose X = Pose::Identity();
  X.linear() = Eigen::Quaterniond(pose.Rot().W(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z())
                   .normalized()
                   .toRotationMatrix();
  X.translation() = vector_of(pose.Pos());
  return X;
}

std::vector<std::pair<Shape, Pose>> shapes_of(const sdf::Geometry& geometry, const fs::path& folder,
                                              const std::string& where) {
  if (const sdf::Box* box = geometry.BoxShape()) {
    return {{geometric::Box{vector_of(box->Size())}, Pose::Identity()}};
  }
  if (const sdf::Sphere* sphere = geometry.SphereShape()) {
    return {{geometric::Sphere{sphere->Radius()}, Pose::Identity()}};
  }
  if (const sdf::Cylinder* cylinder = geometry.CylinderShape()) {
    return {{geometric::Cylinder{cylinder->Radius(), cylinder->Length()}, Pose::Identity()}};
  }
  if (const sdf::Capsule* capsule = geometry.CapsuleShape()) {
    return geometric::capsule_shapes(capsule->Radius(), capsule->Length());
  }
  if (const sdf::Ellipsoid* ellipsoid = geometry.EllipsoidShape()) {
    return {{geometric::ellipsoid_mesh(vector_of(ellipsoid->Radii())), Pose::Identity()}};
  }
  if (const sdf::Mesh* mesh = geometry.MeshShape()) {
    return {{mesh_of(*mesh, folder, where), Pose::Identity()}};
  }
  return {};
}

}  // namespace handway::import_sdf
