#pragma once

#include "handway/planning/core/exporter.h"

namespace handway::export_ros {

/// moveit_msgs/DisplayTrajectory for ROS 1 and ROS 2 as YAML, for RViz's motion planning
/// display: NAME_display_ros1.yaml and NAME_display_ros2.yaml.
class MoveItExporter final : public planning::Exporter {
 public:
  [[nodiscard]] std::string name() const override { return "moveit"; }
  [[nodiscard]] std::string description() const override {
    return "moveit_msgs/DisplayTrajectory for ROS 1 and 2, as YAML";
  }

 private:
  [[nodiscard]] std::vector<planning::ExportedFile> do_export(
      const planning::Motion& motion) const override;
};

}  // namespace handway::export_ros
