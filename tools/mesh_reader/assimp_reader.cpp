#include "readers.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace handway::mesh_reader {
namespace {

constexpr int kDeepestNode = 500;
constexpr const char* kExpected = "a mesh file such as STL, OBJ, DAE, PLY or glTF";
constexpr const char* kAdvice = "Open the file in a mesh viewer, or export it again";

[[noreturn]] void refuse(const std::string& found) { throw Refusal("", found, kExpected, kAdvice); }

// Files that a mesh names may be of any kind.
class RegularFiles final : public Assimp::DefaultIOSystem {
 public:
  bool Exists(const char* file) const override {
    std::error_code error;
    return std::filesystem::is_regular_file(file, error);
  }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    const bool reads = std::string_view(mode).find_first_of("wa+") == std::string_view::npos;
    return reads && Exists(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
  }
};

using Matrix = aiMatrix4x4t<double>;

// Largest enlargement by a frame, along one of its axes.
double enlargement(const Matrix& X) {
  return std::sqrt(
      std::max({X.a1 * X.a1 + X.b1 * X.b1 + X.c1 * X.c1, X.a2 * X.a2 + X.b2 * X.b2 + X.c2 * X.c2,
                X.a3 * X.a3 + X.b3 * X.b3 + X.c3 * X.c3}));
}

double largest_coordinate(double x, double y, double z) {
  return std::max({std::abs(x), std::abs(y), std::abs(z)});
}

void append_mesh(Mesh& whole, const aiMesh& part, const Matrix& X_RootNode) {
  const double scale = enlargement(X_RootNode);
  const std::uint32_t first = whole.vertex_count();
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& v = part.mVertices[i];
    const aiVector3t<double> p = X_RootNode * aiVector3t<double>(v.x, v.y, v.z);
    whole.add_vertex({p.x, p.y, p.z});
    whole.largest = std::max({whole.largest, scale * largest_coordinate(v.x, v.y, v.z),
                              largest_coordinate(p.x, p.y, p.z)});
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
        refuse("a triangle that names a vertex which the file does not have");
      }
      return first + face.mIndices[k];
    };
    if (mirrored) {
      whole.add_triangle({corner(0), corner(2), corner(1)});
    } else {
      whole.add_triangle({corner(0), corner(1), corner(2)});
    }
  }
}

void append_node(Mesh& whole, const aiScene& scene, const aiNode& node, const Matrix& X_RootParent,
                 int depth) {
  if (depth > kDeepestNode) {
    refuse("nodes nested more than " + std::to_string(kDeepestNode));
  }
  const aiMatrix4x4& m = node.mTransformation;
  const Matrix X_ParentNode(m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4,
                            m.d1, m.d2, m.d3, m.d4);
  const Matrix X_RootNode = X_RootParent * X_ParentNode;
  whole.largest =
      std::max(whole.largest, enlargement(X_RootParent) * largest_coordinate(m.a4, m.b4, m.c4));
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    append_mesh(whole, *scene.mMeshes[node.mMeshes[i]], X_RootNode);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    append_node(whole, scene, *node.mChildren[i], X_RootNode, depth + 1);
  }
}

// Made before the processes that use it, each of which has its own copy.
Assimp::Importer& importer() {
  static Assimp::Importer importer;
  return importer;
}

std::string in_small_letters(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// Returns the text of an STL file with keywords in capital letters in small ones, which assimp
// requires. Nothing for other files.
std::optional<std::string> stl_in_small_letters(const std::filesystem::path& file) {
  constexpr std::size_t kHead = 5;
  std::ifstream stream(file, std::ios::binary);
  std::string head(kHead, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(kHead));
  if (in_small_letters(file.extension().string()) != ".stl" || in_small_letters(head) != "solid" ||
      !stream) {
    return std::nullopt;
  }
  std::string text = head;
  text.append(std::istreambuf_iterator<char>(stream), {});
  const bool is_text = text.find('\0') == std::string::npos;
  const bool is_small = text.find("facet") != std::string::npos && head == "solid";
  return is_text && !is_small ? std::optional(in_small_letters(std::move(text))) : std::nullopt;
}

}  // namespace

void prepare_assimp() {
  importer().SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer().SetIOHandler(new RegularFiles);
}

void read_by_assimp(const std::filesystem::path& file, Mesh& mesh) {
  const std::optional<std::string> text = stl_in_small_letters(file);
  const aiScene* scene =
      text ? importer().ReadFileFromMemory(text->data(), text->size(), aiProcess_Triangulate, "stl")
           : importer().ReadFile(file.string(), aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    const std::string why = importer().GetErrorString();
    if (why.find("bad_alloc") != std::string::npos) {
      throw std::bad_alloc();
    }
    refuse(why.empty() ? "something unreadable" : why);
  }
  append_node(mesh, *scene, *scene->mRootNode, {}, 0);
}

}  // namespace handway::mesh_reader
