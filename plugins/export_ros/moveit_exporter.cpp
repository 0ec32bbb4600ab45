#include "moveit_exporter.h"

#include "messages.h"
#include "yaml_text.h"

namespace handway::export_ros {

std::vector<planning::ExportedFile> MoveItExporter::do_export(
    const planning::Motion& motion) const {
  std::vector<planning::ExportedFile> files;
  for (const RosVersion version : {RosVersion::kRos1, RosVersion::kRos2}) {
    const Message none = Message::array();
    const Message robot_trajectory = {
        {"joint_trajectory", joint_trajectory(motion, version)},
        {"multi_dof_joint_trajectory",
         {{"header", header(version)}, {"joint_names", none}, {"points", none}}}};
    const Message message = {{"model_id", motion.model->name()},
                             {"trajectory", Message::array({robot_trajectory})},
                             {"trajectory_start", start_state(motion, version)}};
    const char* end = version == RosVersion::kRos1 ? "_display_ros1.yaml" : "_display_ros2.yaml";
    files.push_back({motion.name + end, to_yaml(message)});
  }
  return files;
}

}  // namespace handway::export_ros
