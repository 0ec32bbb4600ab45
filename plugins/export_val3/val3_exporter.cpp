#include "val3_exporter.h"

#include "arm_moves.h"
#include "val3_files.h"

namespace handway::export_val3 {

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
