#include "val3_exporter.h"

#include "arm_moves.h"
#include "val3_files.h"

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

namespace handway::export_val3 {
namespace {

// The maker's name, or a model of six axes: TX40 to TX200, TX2-40 to TX2-160, RX60 to RX270.
bool names_a_staubli(const std::string& text) {
  static const std::regex kNames("st(a|ae|\xc3\xa4)ubli|(^|[^a-z0-9])(tx|tx2|rx)[-_ ]?[0-9]{2,3}",
                                 std::regex::ECMAScript | std::regex::icase);
  return std::regex_search(text, kNames);
}

}  // namespace

std::string Val3Exporter::robot_objection(const planning::Motion& motion) const {
  const geometric::RobotModel& model = *motion.model;
  std::vector<std::string> names{model.name(), model.description().file.filename().string()};
  for (const int v : motion.arm) {
    names.push_back(model.variable(v).child);
  }
  return std::ranges::any_of(names, names_a_staubli)
             ? std::string()
             : "a Stäubli arm: VAL3 runs on its controller alone";
}

std::vector<planning::ExportedFile> Val3Exporter::do_export(const planning::Motion& motion) const {
  const std::vector<ArmMove> moves = arm_moves(motion);
  const std::filesystem::path folder = motion.name;
  return {{folder / (motion.name + ".dtx"), data_file(moves)},
          {folder / "runPath.pgx", run_path_program()},
          {folder / "start.pgx", start_program()},
          {folder / "stop.pgx", stop_program()},
          {folder / (motion.name + ".pjx"), project_file(motion.name)}};
}

}  // namespace handway::export_val3
