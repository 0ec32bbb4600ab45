#include "ros_exporter.h"

#include "messages.h"
#include "yaml_text.h"

namespace handway::export_ros {

std::vector<planning::ExportedFile> RosExporter::do_export(const planning::Motion& motion) const {
  std::vector<planning::ExportedFile> files;
  for (const RosVersion version : {RosVersion::kRos1, RosVersion::kRos2}) {
    const Message message = joint_trajectory(motion, version);
    const std::string stem = motion.name + (version == RosVersion::kRos1 ? "_ros1" : "_ros2");
    files.push_back({stem + ".yaml", to_yaml(message)});
    files.push_back({stem + ".json", message.dump() + "\n"});
  }
  return files;
}

}  // namespace handway::export_ros
