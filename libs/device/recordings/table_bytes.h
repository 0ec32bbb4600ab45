#pragma once

#include "handway/device/recordings/recorded_table.h"

#include <string>

/// Files of a table, as bytes: see write_recorded_table().

namespace handway::device {

[[nodiscard]] std::string npz_bytes(const RecordedTable& table);

/// From any thread.
[[nodiscard]] std::string hdf5_bytes(const RecordedTable& table);

}  // namespace handway::device
