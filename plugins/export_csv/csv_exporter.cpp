#include "csv_exporter.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/table_text.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/paths/path_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <string_view>
#include <vector>

namespace handway::export_csv {
namespace {

/// Text in rows and columns: times by planning::csv_time(), other numbers as the shortest that read
/// back to the same bits.
class CsvTable {
 public:
  explicit CsvTable(const std::vector<std::string>& columns);

  /// @param time s, the first column. @param values of the next ones. @param stage text of the last
  /// column; null: there is none.
  void add_row(double time, const std::vector<double>& values,
               const planning::MotionStage* stage = nullptr);

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

CsvTable::CsvTable(const std::vector<std::string>& columns) {
  for (const std::string& column : columns) {
    text_.append(text_.empty() ? "" : ",").append(geometric::csv_cell(column));
  }
  text_ += '\n';
}

void CsvTable::add_row(double time, const std::vector<double>& values,
                       const planning::MotionStage* stage) {
  text_ += fmt::format("{},{}", planning::csv_time(time), fmt::join(values, ","));
  if (stage != nullptr) {
    text_.append(",").append(geometric::csv_cell(stage->name));
  }
  text_ += '\n';
}

}  // namespace

std::vector<planning::ExportedFile> CsvExporter::do_export(
    const planning::Motion& motion, const planning::ExportOptions& /*options*/) const {
  const geometric::RobotModel& model = *motion.model;
  std::vector<std::string> columns = {"time"};
  for (int link = 1; link < model.link_count(); ++link) {
    if (model.mimic_mapping(link).variable >= 0) {
      columns.push_back(model.joint(link).name);
    }
  }
  for (const char* rate : {".velocity", ".acceleration"}) {
    for (int v = 0; v < model.variable_count(); ++v) {
      columns.push_back(model.variable(v).name + rate);
    }
  }
  if (!motion.stages.empty()) {
    columns.emplace_back("stage");
  }
  CsvTable table(columns);
  for (const planning::TrajectoryPoint& point : motion.trajectory.points) {
    std::vector<double> row;
    for (const geometric::JointValue& joint : geometric::joint_values(model, point.position)) {
      row.push_back(joint.value);
    }
    row.insert(row.end(), point.velocity.begin(), point.velocity.end());
    row.insert(row.end(), point.acceleration.begin(), point.acceleration.end());
    table.add_row(point.time, row, stage_at(motion, point.time));
  }
  return {{motion.name + ".csv", table.text()}};
}

namespace {

std::string table_of(const planning::Motion& motion, const std::vector<int>& variables) {
  std::vector<std::string> columns = {"time"};
  for (const char* rate : {"", ".velocity"}) {
    for (const int v : variables) {
      columns.push_back(motion.model->variable(v).name + rate);
    }
  }
  if (!motion.stages.empty()) {
    columns.emplace_back("stage");
  }
  CsvTable table(columns);
  for (const planning::TrajectoryPoint& point : motion.trajectory.points) {
    std::vector<double> row;
    for (const Eigen::VectorXd* values : {&point.position, &point.velocity}) {
      for (const int v : variables) {
        row.push_back((*values)[v]);
      }
    }
    table.add_row(point.time, row, stage_at(motion, point.time));
  }
  return table.text();
}

}  // namespace

std::vector<planning::ExportedFile> SplitExporter::do_export(
    const planning::Motion& motion, const planning::ExportOptions& /*options*/) const {
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

HANDWAY_PLUGIN({.name = "export_csv", .version = HANDWAY_VERSION, .make_exporters = [] {
                  std::vector<std::unique_ptr<handway::planning::Exporter>> exporters;
                  exporters.push_back(std::make_unique<handway::export_csv::CsvExporter>());
                  exporters.push_back(std::make_unique<handway::export_csv::SplitExporter>());
                  return exporters;
                }});
