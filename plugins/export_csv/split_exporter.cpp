#include "split_exporter.h"

#include "csv_table.h"
#include "handway/geometric/io/input_error.h"

namespace handway::export_csv {
namespace {

std::string table_of(const planning::Motion& motion, const std::vector<int>& variables) {
  std::vector<std::string> columns = {"time"};
  for (const char* rate : {"", ".velocity"}) {
    for (const int v : variables) {
      columns.push_back(motion.model->variable(v).name + rate);
    }
  }
  CsvTable table(columns);
  for (const planning::TrajectoryPoint& point : motion.trajectory.points) {
    std::vector<double> row;
    for (const Eigen::VectorXd* values : {&point.position, &point.velocity}) {
      for (const int v : variables) {
        row.push_back((*values)[v]);
      }
    }
    table.add_row(point.time, row);
  }
  return table.text();
}

}  // namespace

std::vector<planning::ExportedFile> SplitExporter::do_export(const planning::Motion& motion) const {
  if (motion.arm.empty() || motion.hand.empty()) {
    throw geometric::InputError({"robot " + motion.model->name(), "",
                                 motion.arm.empty() ? "no arm" : "no hand",
                                 "joints of an arm and of a hand",
                                 "Groups \"arm\" and \"hand\" of the SRDF file tell them"});
  }
  return {{motion.name + "_arm.csv", table_of(motion, motion.arm)},
          {motion.name + "_hand.csv", table_of(motion, motion.hand)}};
}

}  // namespace handway::export_csv
