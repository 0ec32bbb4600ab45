#pragma once

#include "handway/geometric/io/parameter.h"

#include <cstdint>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace handway::tools {

/// Adds an option for each setting: `--period-ms 4` for "period_ms". A switch that is off becomes a
/// flag that turns it on, `--jerk`; one that is on, a flag that turns it off, `--no-blend`. The
/// members that the settings are bound to outlive the command. @returns the options.
std::vector<CLI::Option*> add_parameter_options(
    CLI::App& command, const std::vector<geometric::BoundParameter>& parameters);

/// Adds the option of one setting under a name of its own. @returns the option.
CLI::Option* add_parameter_option(CLI::App& command, const std::string& name,
                                  const geometric::BoundParameter& parameter);

/// Adds `--seed`.
void add_seed_option(CLI::App& command, std::uint64_t& seed);

/// Adds `--threads`. @param result that does not depend on it: "the path".
void add_threads_option(CLI::App& command, int& threads, const std::string& result);

}  // namespace handway::tools
