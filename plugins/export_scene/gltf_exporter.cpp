#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/planning/extensions/plugin.h"
#include "scene_exporters.h"

#include <assimp/Exporter.hpp>
#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace handway::export_scene {
namespace {

using geometric::Color;
using geometric::Pose;
using geometric::Shape;
using geometric::TriangleMesh;

const double kSmoothCosine = std::cos(geometric::radians(40.0));

aiVector3D vector_of(const Eigen::Vector3d& v) {
  return {static_cast<ai_real>(v.x()), static_cast<ai_real>(v.y()), static_cast<ai_real>(v.z())};
}

aiMatrix4x4 matrix_of(const Pose& X) {
  aiMatrix4x4 matrix;
  for (unsigned row = 0; row < 3; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      matrix[row][column] = static_cast<ai_real>(X.matrix()(row, column));
    }
  }
  return matrix;
}

// Normals of the corners of all triangles: the mean of those of adjacent triangles within the angle
// of the corner's own.
std::vector<Eigen::Vector3d> corner_normals(const TriangleMesh& mesh) {
  const TriangleMesh joined = geometric::welded(mesh);
  std::vector<Eigen::Vector3d> areas;  // normals, as long as twice the area
  std::vector<std::vector<std::size_t>> around(joined.vertices.size());
  for (const auto& [a, b, c] : joined.triangles) {
    for (const std::uint32_t corner : {a, b, c}) {
      around[corner].push_back(areas.size());
    }
    areas.push_back(
        (joined.vertices[b] - joined.vertices[a]).cross(joined.vertices[c] - joined.vertices[a]));
  }
  std::vector<Eigen::Vector3d> normals;
  for (std::size_t t = 0; t < joined.triangles.size(); ++t) {
    const Eigen::Vector3d own = areas[t].stableNormalized();
    for (const std::uint32_t corner : joined.triangles[t]) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const std::size_t other : around[corner]) {
        if (areas[other].dot(own) >= kSmoothCosine * areas[other].norm()) {
          sum += areas[other];
        }
      }
      normals.push_back(sum.isZero(0.0) ? Eigen::Vector3d(Eigen::Vector3d::UnitZ())
                                        : Eigen::Vector3d(sum.normalized()));
    }
  }
  return normals;
}

std::unique_ptr<aiMesh> mesh_of(const TriangleMesh& from, unsigned material) {
  auto mesh = std::make_unique<aiMesh>();
  mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  mesh->mMaterialIndex = material;
  const auto corners = static_cast<unsigned>(3 * from.triangles.size());
  mesh->mNumVertices = corners;
  mesh->mVertices = new aiVector3D[corners];
  mesh->mNormals = new aiVector3D[corners];
  mesh->mNumFaces = static_cast<unsigned>(from.triangles.size());
  mesh->mFaces = new aiFace[from.triangles.size()];
  const std::vector<Eigen::Vector3d> normals = corner_normals(from);
  unsigned corner = 0;
  for (std::size_t t = 0; t < from.triangles.size(); ++t) {
    aiFace& face = mesh->mFaces[t];
    face.mNumIndices = 3;
    face.mIndices = new unsigned[3];
    for (unsigned k = 0; k < 3; ++k, ++corner) {
      mesh->mVertices[corner] = vector_of(from.vertices[from.triangles[t].at(k)]);
      mesh->mNormals[corner] = vector_of(normals[corner]);
      face.mIndices[k] = corner;
    }
  }
  return mesh;
}

std::unique_ptr<aiMaterial> material_of(const Color& color) {
  auto material = std::make_unique<aiMaterial>();
  const aiColor4D base(color.red, color.green, color.blue, color.alpha);
  material->AddProperty(&base, 1, AI_MATKEY_BASE_COLOR);
  const ai_real metallic = 0;
  const auto roughness = static_cast<ai_real>(0.6);
  material->AddProperty(&metallic, 1, AI_MATKEY_METALLIC_FACTOR);
  material->AddProperty(&roughness, 1, AI_MATKEY_ROUGHNESS_FACTOR);
  if (color.alpha < 1.0F) {
    const aiString blend("BLEND");
    material->AddProperty(&blend, AI_MATKEY_GLTF_ALPHAMODE);
  }
  return material;
}

/// Collects visible geometry.
class SceneGraph {
 public:
  void add(const std::string& name, const Shape& shape, const Pose& X_W, const Color& color) {
    const std::shared_ptr<const TriangleMesh> triangles = geometric::tessellate(shape);
    if (triangles->empty()) {
      return;
    }
    auto node = std::make_unique<aiNode>(name);
    node->mTransformation = matrix_of(X_W);
    node->mNumMeshes = 1;
    node->mMeshes = new unsigned[1]{static_cast<unsigned>(meshes_.size())};
    meshes_.push_back(mesh_of(*triangles, material(color)));
    nodes_.push_back(std::move(node));
  }

  // Owns all added elements.
  std::unique_ptr<aiScene> scene(const std::string& name) && {
    auto scene = std::make_unique<aiScene>();
    scene->mRootNode = new aiNode(name);
    // From z up to y up.
    aiMatrix4x4::RotationX(static_cast<ai_real>(-std::numbers::pi / 2.0),
                           scene->mRootNode->mTransformation);
    std::vector<aiNode*> children;
    for (auto& node : nodes_) {
      children.push_back(node.release());
    }
    scene->mRootNode->addChildren(static_cast<unsigned>(children.size()), children.data());
    scene->mNumMeshes = static_cast<unsigned>(meshes_.size());
    scene->mMeshes = new aiMesh*[meshes_.size()];
    std::ranges::transform(meshes_, scene->mMeshes, [](auto& mesh) { return mesh.release(); });
    scene->mNumMaterials = static_cast<unsigned>(materials_.size());
    scene->mMaterials = new aiMaterial*[materials_.size()];
    std::ranges::transform(materials_, scene->mMaterials,
                           [](auto& material) { return material.release(); });
    return scene;
  }

 private:
  unsigned material(const Color& color) {
    const auto known = std::ranges::find(colors_, color);
    if (known != colors_.end()) {
      return static_cast<unsigned>(known - colors_.begin());
    }
    colors_.push_back(color);
    materials_.push_back(material_of(color));
    return static_cast<unsigned>(colors_.size() - 1);
  }

  std::vector<std::unique_ptr<aiNode>> nodes_;
  std::vector<std::unique_ptr<aiMesh>> meshes_;
  std::vector<std::unique_ptr<aiMaterial>> materials_;
  std::vector<Color> colors_;
};

std::vector<Pose> link_poses(const geometric::RobotInstance& robot,
                             const geometric::Configuration& q) {
  std::vector<Pose> X_WL(static_cast<std::size_t>(robot.model->link_count()));
  robot.model->forward_kinematics(q, X_WL);
  for (Pose& X : X_WL) {
    X = robot.X_WB * X;
  }
  return X_WL;
}

void add_robot(const geometric::RobotInstance& robot, const std::vector<Pose>& X_WL,
               SceneGraph& graph) {
  for (int i = 0; i < robot.model->link_count(); ++i) {
    const geometric::Link& link = robot.model->link(i);
    const auto& seen = link.visual.empty() ? link.collision : link.visual;
    for (const geometric::LinkGeometry& geometry : seen) {
      graph.add(robot.name + "/" + link.name, geometry.shape,
                X_WL[static_cast<std::size_t>(i)] * geometry.X_LG, geometry.color);
    }
  }
}

}  // namespace

std::vector<std::filesystem::path> GltfExporter::do_write(const geometric::Scene& scene,
                                                          const std::filesystem::path& folder,
                                                          const std::string& stem) const {
  SceneGraph graph;
  std::vector<std::vector<Pose>> X_WL;
  for (const geometric::RobotInstance& robot : scene.robots) {
    const bool is_first = X_WL.empty();
    X_WL.push_back(link_poses(robot, is_first && scene.start ? *scene.start : robot.configuration));
    add_robot(robot, X_WL.back(), graph);
  }
  for (const geometric::SceneObject& object : scene.objects) {
    if (scene.display.of(object.name).hidden) {
      continue;
    }
    Pose X_W = object.X_PO;
    if (object.attachment) {
      const geometric::RobotInstance* robot = find_robot(scene, object.attachment->robot);
      const auto index = static_cast<std::size_t>(robot - scene.robots.data());
      const int link = robot->model->find_link(object.attachment->link).value();
      X_W = X_WL[index][static_cast<std::size_t>(link)] * X_W;
    }
    graph.add(object.name, object.shape, X_W, object.color);
  }
  const std::unique_ptr<aiScene> made = std::move(graph).scene(stem);
  Assimp::Exporter exporter;
  const std::filesystem::path file = folder / (stem + ".glb");
  const aiExportDataBlob* blob = exporter.ExportToBlob(made.get(), "glb2");
  if (blob == nullptr) {
    throw geometric::InputError(
        {file.string(), "", exporter.GetErrorString(), "a scene that assimp can write", ""});
  }
  geometric::replace_file(file, std::string(static_cast<const char*>(blob->data), blob->size));
  return {file};
}

}  // namespace handway::export_scene

HANDWAY_PLUGIN({.name = "export_scene", .version = HANDWAY_VERSION, .make_scene_exporters = []() {
                  std::vector<std::unique_ptr<handway::planning::SceneExporter>> exporters;
                  exporters.push_back(std::make_unique<handway::export_scene::GltfExporter>());
                  exporters.push_back(
                      std::make_unique<handway::export_scene::MoveitSceneExporter>());
                  return exporters;
                }});
