#include "handway/device/glove/raw_columns.h"

#include <fmt/format.h>

#include <cstddef>

namespace handway::device {

std::vector<std::string> labels_of(const RawColumns& columns) {
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < columns.names.size(); ++i) {
    const std::string& unit = columns.units.at(i);
    labels.push_back(unit.empty() ? columns.names[i]
                                  : fmt::format("{} [{}]", columns.names[i], unit));
  }
  return labels;
}

RawColumns raw_columns_of_labels(const std::vector<std::string>& labels) {
  RawColumns columns;
  for (const std::string& label : labels) {
    const std::size_t open = label.rfind(" [");
    const bool has_unit = label.ends_with(']') && open != std::string::npos && open > 0;
    columns.add(has_unit ? label.substr(0, open) : label,
                has_unit ? label.substr(open + 2, label.size() - open - 3) : "");
  }
  return columns;
}

RawColumns rows_of(const RawColumns& columns, const std::vector<Eigen::Index>& rows) {
  return {columns.names, columns.units, columns.values(rows, Eigen::all)};
}

}  // namespace handway::device
