#include "io/saved_meshes.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/obj_writer.h"

#include <algorithm>
#include <cctype>
#include <system_error>

namespace handway::geometric {

std::string file_name_of(const std::string& name) {
  std::string result = name;
  std::ranges::replace_if(
      result, [](unsigned char c) { return !std::isalnum(c) && c != '-' && c != '_'; }, '_');
  return result;
}

SavedMeshes::SavedMeshes(const std::filesystem::path& file)
    : beside_(std::filesystem::absolute(file).parent_path()),
      folder_(file.stem().string() + "_meshes") {}

std::filesystem::path SavedMeshes::save(const std::string& name, const TriangleMesh& mesh) {
  const std::string stem = file_name_of(name);
  std::string unique = stem;
  for (int i = 2; !taken_.insert(unique).second; ++i) {
    unique = stem + "_" + std::to_string(i);
  }
  std::error_code error;
  std::filesystem::create_directories(beside_ / folder_, error);
  if (error) {
    throw InputError({(beside_ / folder_).string(), "", error.message(), "a folder for meshes",
                      "Save where you may write"});
  }
  const std::filesystem::path file = folder_ / (unique + ".obj");
  write_obj(mesh, beside_ / file);
  return file;
}

}  // namespace handway::geometric
