#include "io/assimp_import.h"

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <stdexcept>

namespace handway::geometric {
namespace {

constexpr int kDeepestNode = 500;

void append_mesh(TriangleMesh& whole, const aiMesh& part, const aiMatrix4x4t<double>& X_RootNode) {
  const auto first = static_cast<std::uint32_t>(whole.vertices.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& v = part.mVertices[i];
    const aiVector3t<double> p = X_RootNode * aiVector3t<double>(v.x, v.y, v.z);
    whole.vertices.emplace_back(p.x, p.y, p.z);
  }
  // A node that mirrors turns its triangles inside out.
  const bool mirrored = X_RootNode.Determinant() < 0.0;
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) {
      continue;  // a point or a line
    }
    const auto corner = [&](int k) {
      if (face.mIndices[k] >= part.mNumVertices) {
        throw std::runtime_error("a triangle names a vertex that the file does not have");
      }
      return first + face.mIndices[k];
    };
    if (mirrored) {
      whole.triangles.push_back({corner(0), corner(2), corner(1)});
    } else {
      whole.triangles.push_back({corner(0), corner(1), corner(2)});
    }
  }
}

void append_node(TriangleMesh& whole, const aiScene& scene, const aiNode& node,
                 const aiMatrix4x4t<double>& X_RootParent, int depth) {
  if (depth > kDeepestNode) {
    throw std::runtime_error("nodes nested too deep");
  }
  const aiMatrix4x4& m = node.mTransformation;
  const aiMatrix4x4t<double> X_ParentNode(m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1,
                                          m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4);
  const aiMatrix4x4t<double> X_RootNode = X_RootParent * X_ParentNode;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    append_mesh(whole, *scene.mMeshes[node.mMeshes[i]], X_RootNode);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    append_node(whole, scene, *node.mChildren[i], X_RootNode, depth + 1);
  }
}

}  // namespace

TriangleMesh import_triangles(const std::filesystem::path& file) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate);
  if (!scene || !scene->mRootNode) {
    throw std::runtime_error(importer.GetErrorString());
  }
  TriangleMesh whole;
  append_node(whole, *scene, *scene->mRootNode, {}, 0);
  return whole;
}

bool can_import(const std::filesystem::path& file) {
  return file.has_extension() && Assimp::Importer().IsExtensionSupported(file.extension().string());
}

}  // namespace handway::geometric
