#include "kautham_importer.h"

#include "handway/geometric/io/existing_file.h"
#include "kautham_scene.h"

#include <array>
#include <fstream>
#include <string_view>

namespace handway::import_kautham {

std::string KauthamImporter::name() const { return "Kautham 2013 (.xml, .rob)"; }

bool KauthamImporter::can_read(const std::filesystem::path& file) const {
  const bool is_robot = geometric::has_extension(file, ".rob");
  if (!is_robot && !geometric::has_extension(file, ".xml")) {
    return false;
  }
  std::array<char, 4096> head{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), head.size());
  const std::string_view begin(head.data(), static_cast<std::size_t>(stream.gcount()));
  return begin.find(is_robot ? "<Robot" : "<Problem") != std::string_view::npos;
}

planning::LoadedScene KauthamImporter::read(const std::filesystem::path& file) const {
  return geometric::has_extension(file, ".rob") ? make_robot_scene(file)
                                                : make_scene(read_kautham_problem(file));
}

}  // namespace handway::import_kautham
