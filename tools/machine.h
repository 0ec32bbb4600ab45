#pragma once

#include <string>
#include <utility>
#include <vector>

namespace handway::tools {

/// What measured times depend on, for reports: processor, cores, memory, system, compiler,
/// program version. Labels and values.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> machine_description();

/// The host's name; "unknown" if it has none.
[[nodiscard]] std::string host_name();

/// The processor as the system calls it.
[[nodiscard]] std::string processor_name();

}  // namespace handway::tools
