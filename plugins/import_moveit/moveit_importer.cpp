#include "moveit_importer.h"

#include "handway/geometric/io/existing_file.h"
#include "moveit_problem.h"

namespace handway::import_moveit {

std::string MoveitImporter::name() const { return "a MoveIt scene or request (.yaml)"; }

bool MoveitImporter::can_read(const std::filesystem::path& file) const {
  return (geometric::has_extension(file, ".yaml") || geometric::has_extension(file, ".yml")) &&
         is_moveit_file(file);
}

planning::LoadedScene MoveitImporter::read(const std::filesystem::path& file) const {
  return read_moveit_problem(problem_files(std::filesystem::absolute(file)));
}

}  // namespace handway::import_moveit
