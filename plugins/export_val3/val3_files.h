#pragma once

#include "arm_moves.h"

#include <string>
#include <vector>

/// The files of a VAL3 application, in the XML form of SRC controllers s7 and s8:
/// projects (Project/3), programs (Program/2) and data (Data/2).
namespace handway::export_val3 {

/// How far (deg) the arm may stand from the first point when the program starts.
inline constexpr double kStartTolerance = 0.1;

/// NAME.pjx: the programs and the data that belong together.
[[nodiscard]] std::string project_file(const std::string& name);

/// NAME.dtx: `jPath` (deg), `mMove`, `nPause` (s), one of each for every point, `nPoints`,
/// `nTolerance` (deg) and `tHand`. No move blends into the next.
[[nodiscard]] std::string data_file(const std::vector<ArmMove>& moves);

/// start.pgx: waits for power and calls runPath.
[[nodiscard]] std::string start_program();

/// stop.pgx: forgets what is left to do.
[[nodiscard]] std::string stop_program();

/// runPath.pgx: refuses to run unless the arm stands at the first point and all points are
/// in range; then goes from point to point.
[[nodiscard]] std::string run_path_program();

}  // namespace handway::export_val3
