#pragma once

#include "handway/planning/extensions/exporter.h"

namespace handway::export_ros {

/// Exports trajectory_msgs/JointTrajectory for ROS 1 and ROS 2, each as YAML (for `rostopic pub`
/// and `ros2 topic pub`) and as JSON (for rosbridge): NAME_ros1.yaml, … A motion with stages also
/// has them as a list of `stage`, `step` and `trajectory`, one after another:
/// NAME_stages_ros1.yaml, …
class RosExporter final : public planning::Exporter {
 public:
  [[nodiscard]] std::string name() const override { return "ros"; }
  [[nodiscard]] std::string description() const override {
    return "trajectory_msgs/JointTrajectory for ROS 1 and 2, as YAML and JSON";
  }
  /// Rejects all outputs: trajectories have none.
  [[nodiscard]] std::string output_objection(const geometric::OutputStep& output) const override;

 private:
  [[nodiscard]] std::vector<planning::ExportedFile> do_export(
      const planning::Motion& motion, const planning::ExportOptions& options) const override;
};

/// Exports moveit_msgs/DisplayTrajectory for ROS 1 and ROS 2 as YAML, for RViz's motion planning
/// display: NAME_display_ros1.yaml and NAME_display_ros2.yaml.
class MoveItExporter final : public planning::Exporter {
 public:
  [[nodiscard]] std::string name() const override { return "moveit"; }
  [[nodiscard]] std::string description() const override {
    return "moveit_msgs/DisplayTrajectory for ROS 1 and 2, as YAML";
  }

 private:
  [[nodiscard]] std::vector<planning::ExportedFile> do_export(
      const planning::Motion& motion, const planning::ExportOptions& options) const override;
};

}  // namespace handway::export_ros
