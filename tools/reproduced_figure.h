#pragma once

#include "report_document.h"

#include <optional>
#include <string>
#include <vector>

namespace handway::tools {

/// A figure of the paper's, made again.
struct ReproducedFigure {
  int number = 0;  ///< In the paper.
  std::string caption;
  std::string text;  ///< What it is made of; may be empty.
  std::vector<ReportPicture> pictures;
  std::optional<ReportTable> table;  ///< Published figures beside ours, where there are some.
  std::string problem;               ///< Why not all of it is there; may be empty.
};

}  // namespace handway::tools
