#include "inventor_meshes.h"

#include "handway/geometric/formats/mesh_import.h"
#include "handway/geometric/io/disk_cache.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/vector.hpp>
#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace handway::import_kautham {
InventorMesh read_inventor_mesh(const std::filesystem::path& file, double scale) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    throw geometric::InputError(
        {file.string(), "", "no such file", "an Open Inventor or VRML file",
         "Put the mesh there or correct the name in the file that refers to it"});
  }
  geometric::ImportedMesh mesh =
      geometric::import_mesh(file, geometric::MeshFormat::kInventor, scale);
  if (std::optional<geometric::InputProblem> problem = geometric::rounding_problem(mesh.largest)) {
    problem->source = file.string();
    throw geometric::InputError(*std::move(problem));
  }
  return {std::make_shared<const geometric::TriangleMesh>(std::move(mesh.triangles)), mesh.color,
          mesh.includes_files, std::move(mesh.warnings)};
}

namespace {

// To be changed with the result of read_inventor_mesh().
constexpr int kVersion = 1;

/// A mesh in a form for archives.
struct Numbers {
  std::vector<double> vertices;          ///< x y z of each, m
  std::vector<std::uint32_t> triangles;  ///< Three vertices of each.
  geometric::Color color;

  template <typename Archive>
  void serialize(Archive& archive, unsigned /*version*/) {
    archive& vertices& triangles& color.red& color.green& color.blue& color.alpha;
  }
};

std::string archived(const InventorMesh& mesh) {
  Numbers numbers;
  numbers.color = mesh.color;
  for (const Eigen::Vector3d& vertex : mesh.triangles->vertices) {
    numbers.vertices.insert(numbers.vertices.end(), vertex.begin(), vertex.end());
  }
  for (const auto& triangle : mesh.triangles->triangles) {
    numbers.triangles.insert(numbers.triangles.end(), triangle.begin(), triangle.end());
  }
  std::ostringstream stream(std::ios::binary);
  boost::archive::binary_oarchive(stream, boost::archive::no_header) << std::as_const(numbers);
  return stream.str();
}

InventorMesh unarchived(const std::string& bytes) {
  std::istringstream stream(bytes, std::ios::binary);
  Numbers numbers;
  boost::archive::binary_iarchive(stream, boost::archive::no_header) >> numbers;
  geometric::TriangleMesh mesh;
  for (std::size_t i = 0; i + 2 < numbers.vertices.size(); i += 3) {
    mesh.vertices.emplace_back(numbers.vertices[i], numbers.vertices[i + 1],
                               numbers.vertices[i + 2]);
  }
  for (std::size_t i = 0; i + 2 < numbers.triangles.size(); i += 3) {
    mesh.triangles.push_back(
        {numbers.triangles[i], numbers.triangles[i + 1], numbers.triangles[i + 2]});
  }
  return {std::make_shared<const geometric::TriangleMesh>(std::move(mesh)), numbers.color};
}

std::optional<std::string> bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  return stream ? std::optional(std::move(bytes)) : std::nullopt;
}

InventorMesh read_or_remember(const std::filesystem::path& file, double scale) {
  geometric::note_file_read(file);
  const std::optional<std::string> bytes = bytes_of(file);
  if (!bytes) {
    return read_inventor_mesh(file, scale);
  }
  const geometric::CacheKey key =
      geometric::cache_key(fmt::format("Inventor mesh {}, scale {}", kVersion, scale), *bytes);
  const geometric::DiskCache cache = geometric::DiskCache::of_user();
  if (std::optional<InventorMesh> known = cache.read_as(key, unarchived)) {
    return *std::move(known);
  }
  InventorMesh mesh = read_inventor_mesh(file, scale);
  if (!mesh.includes_files && mesh.warnings.empty()) {
    cache.write(key, archived(mesh));
  }
  return mesh;
}

}  // namespace

const InventorMesh& InventorMeshes::load(const std::filesystem::path& file, double scale) {
  const auto key = std::pair(file.lexically_normal(), scale);
  auto found = meshes_.find(key);
  if (found == meshes_.end()) {
    found = meshes_.emplace(key, read_or_remember(key.first, scale)).first;
    for (const std::string& warning : found->second.warnings) {
      warnings_.push_back(key.first.filename().string() + ": " + warning);
    }
  }
  return found->second;
}

}  // namespace handway::import_kautham
