#pragma once

#include "handway/device/export.h"

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

/// Numbers of a source as they were sent or stored, beside the values that were derived from them.

namespace handway::device {

/// Columns of a source, with its names and in its units.
struct RawColumns {
  std::vector<std::string> names;
  std::vector<std::string> units;  ///< "deg", "m"; empty if unknown. One for each name.
  Eigen::MatrixXd values = {};     ///< NaN: missing. Shape [rows, names].

  /// Adds the name and the unit of a column.
  void add(std::string name, std::string unit) {
    names.push_back(std::move(name));
    units.push_back(std::move(unit));
  }
};

/// Labels of columns in files: "NAME [UNIT]", or the name alone if the unit is unknown.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::vector<std::string> labels_of(const RawColumns& columns);
/// Names and units of labels, without values.
[[nodiscard]] HANDWAY_DEVICE_EXPORT RawColumns
raw_columns_of_labels(const std::vector<std::string>& labels);

/// Returns some rows of columns.
[[nodiscard]] HANDWAY_DEVICE_EXPORT RawColumns rows_of(const RawColumns& columns,
                                                       const std::vector<Eigen::Index>& rows);

}  // namespace handway::device
