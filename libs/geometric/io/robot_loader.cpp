#include "handway/geometric/io/robot_loader.h"

#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/urdf_reader.h"
#include "handway/geometric/robot/allowed_collision_sampling.h"

namespace handway::geometric {

std::shared_ptr<const RobotModel> load_robot(const std::filesystem::path& file) {
  if (!has_extension(file, ".urdf")) {
    throw InputError({file.string(), "", "a file called *" + file.extension().string(),
                      "a robot file (*.urdf)", "Convert xacro files with the xacro tool first"});
  }
  RobotDescription description = read_urdf(file);
  if (description.allowed_collisions.entries().empty()) {
    description.allowed_collisions = adjacent_links(RobotModel(description));
    if (!description.allowed_collisions.entries().empty()) {
      description.warnings.push_back(
          "no SRDF disables collisions between links: only links that a joint connects are "
          "allowed to touch");
    }
  }
  return std::make_shared<const RobotModel>(std::move(description));
}

}  // namespace handway::geometric
