/// The plugin: it knows SDF files, and loads the reader when the first one is read. libsdformat
/// takes some 50 ms to load, which only those pay who read such a file.
#include "handway/geometric/io/input_error.h"
#include "handway/planning/extensions/plugin.h"
#include "sdf_file.h"

#include <boost/dll/runtime_symbol_info.hpp>
#include <boost/dll/shared_library.hpp>

#include <exception>
#include <filesystem>
#include <string>

namespace handway::import_sdf {
namespace {

using ReadSdf = void(const std::filesystem::path& file, geometric::RobotDescription& robot);

// The library with the reader, in a folder beside this one; it stays loaded.
const boost::dll::shared_library& reader_library() {
  static const auto& library = *new boost::dll::shared_library(
      boost::dll::this_line_location().parent_path() / "import_sdf" / "sdf_reader.so");
  return library;
}

geometric::RobotDescription read_sdf(const std::filesystem::path& file) {
  const boost::dll::shared_library* library = nullptr;
  try {
    library = &reader_library();
  } catch (const std::exception& error) {
    throw geometric::InputError({file.string(), "", "an SDF file", "the library that reads it",
                                 std::string("It can't be loaded: ") + error.what()});
  }
  geometric::RobotDescription robot;
  library->get<ReadSdf>("handway_read_sdf")(file, robot);
  return robot;
}

}  // namespace
}  // namespace handway::import_sdf

HANDWAY_PLUGIN({.name = "import_sdf",
                .version = HANDWAY_VERSION,
                .make_robot_readers = []() -> std::vector<handway::geometric::RobotReader> {
                  return {{"an SDF model (.sdf)", handway::import_sdf::is_sdf_file,
                           handway::import_sdf::read_sdf}};
                }});
