#pragma once

#include "handway/planning/campaigns/run_record.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

/// The measured figures of J. Rosell, R. Suárez, C. Rosales and A. Pérez, "Autonomous motion
/// planning of a hand-arm robotic system based on captured human-like hand postures",
/// Autonomous Robots 31, 2011.
namespace handway::tools {

/// A row of Table 2 or 4: the means that were published, and what a run has for it.
struct PaperRow {
  std::string label;
  std::vector<double> published;  ///< A number a column; NaN: not applicable.
  std::function<double(const planning::RunRecord&)> value;
};

/// Columns: reduced search space, full search space. 100 runs.
[[nodiscard]] std::vector<PaperRow> paper_table_2();

/// Columns: problems 1 to 4. 1,000 runs.
[[nodiscard]] std::vector<PaperRow> paper_table_4();

/// A row of Table 3: the initial parameters with PMDs and, in the print in brackets, without.
struct PaperParameter {
  std::string label;
  std::string key;  ///< Ours.
  std::string with_pmds;
  std::string without_pmds;
};
[[nodiscard]] std::vector<PaperParameter> paper_table_3();

inline constexpr const char* kTable2Machine = "Core2 CPU at 3.00 GHz, Windows";
inline constexpr const char* kTable4Machine = "I5 with 4 cores and 4 GB, Windows 7, MPI";

}  // namespace handway::tools
