#pragma once

#include "messages.h"

#include <string>

namespace handway::export_ros {

/// The message as YAML, arrays of plain values on a line; numbers read back to the same bits.
[[nodiscard]] std::string to_yaml(const Message& message);

}  // namespace handway::export_ros
