#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace handway::tools {

/// Describes the machine for reports of measured times: processor, cores, memory, system, compiler,
/// program version. Labels and values.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> machine_description();

/// The host's name; "unknown" if it has none.
[[nodiscard]] std::string host_name();

/// The processor's name in the system.
[[nodiscard]] std::string processor_name();

/// Returns free memory to the system and begins a new measurement of the peak.
void reset_peak_memory();

/// Largest resident memory of this process since reset_peak_memory(), or, if the system doesn't
/// report that, since its beginning; bytes.
[[nodiscard]] std::size_t peak_memory();

}  // namespace handway::tools
