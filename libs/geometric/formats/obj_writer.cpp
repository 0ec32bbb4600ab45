#include "handway/geometric/formats/obj_writer.h"

#include "handway/geometric/formats/cloud_reader.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/replace_file.h"

#include <algorithm>
#include <cctype>
#include <system_error>

namespace handway::geometric {
void write_obj(const TriangleMesh& mesh, const std::filesystem::path& file) {
  std::string text;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    text += "v " + number_text(v.x()) + ' ' + number_text(v.y()) + ' ' + number_text(v.z()) + '\n';
  }
  for (const auto& triangle : mesh.triangles) {
    text += 'f';
    for (const std::uint32_t corner : triangle) {
      text += ' ' + std::to_string(corner + 1);
    }
    text += '\n';
  }
  replace_file(file, text);
}

std::string file_name_of(const std::string& name) {
  std::string result = name;
  std::ranges::replace_if(
      result, [](unsigned char c) { return !std::isalnum(c) && c != '-' && c != '_'; }, '_');
  return result;
}

SavedMeshes::SavedMeshes(const std::filesystem::path& file)
    : beside_(std::filesystem::absolute(file).parent_path()),
      folder_(file.stem().string() + "_meshes") {}

std::filesystem::path SavedMeshes::new_file(const std::string& name, const char* extension) {
  const std::string stem = file_name_of(name);
  std::string unique = stem;
  for (int i = 2; !taken_.insert(unique).second; ++i) {
    unique = stem + "_" + std::to_string(i);
  }
  std::error_code error;
  std::filesystem::create_directories(beside_ / folder_, error);
  if (error) {
    throw OutputError({(beside_ / folder_).string(), "", error.message(), "a folder for meshes",
                       "Save where you may write"});
  }
  return folder_ / (unique + extension);
}

std::filesystem::path SavedMeshes::save(const std::string& name, const TriangleMesh& mesh) {
  const std::filesystem::path file = new_file(name, ".obj");
  write_obj(mesh, beside_ / file);
  return file;
}

std::filesystem::path SavedMeshes::save(const std::string& name, const PointCloud& cloud) {
  const std::filesystem::path file = new_file(name, ".ply");
  write_ply(cloud, beside_ / file);
  return file;
}

}  // namespace handway::geometric
