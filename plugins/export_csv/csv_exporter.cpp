#include "csv_exporter.h"

#include "csv_table.h"

namespace handway::export_csv {

std::vector<planning::ExportedFile> CsvExporter::do_export(const planning::Motion& motion) const {
  const geometric::RobotModel& model = *motion.model;
  std::vector<std::string> columns = {"time"};
  for (int link = 1; link < model.link_count(); ++link) {
    if (model.drive(link).variable >= 0) {
      columns.push_back(model.joint(link).name);
    }
  }
  for (const char* rate : {".velocity", ".acceleration"}) {
    for (int v = 0; v < model.variable_count(); ++v) {
      columns.push_back(model.variable(v).name + rate);
    }
  }
  CsvTable table(columns);
  for (const planning::TrajectoryPoint& point : motion.trajectory.points) {
    std::vector<double> row;
    for (const geometric::JointValue& joint : geometric::joint_values(model, point.position)) {
      row.push_back(joint.value);
    }
    row.insert(row.end(), point.velocity.begin(), point.velocity.end());
    row.insert(row.end(), point.acceleration.begin(), point.acceleration.end());
    table.add_row(point.time, row);
  }
  return {{motion.name + ".csv", table.text()}};
}

}  // namespace handway::export_csv
