#pragma once

#include <cstddef>

namespace handway::tools {

/// Gives back what is free and begins a new measurement of the peak.
void reset_peak_memory();

/// The most memory that this process has had resident since reset_peak_memory(), or,
/// where the system can't tell that, since its beginning; bytes.
[[nodiscard]] std::size_t peak_memory();

}  // namespace handway::tools
