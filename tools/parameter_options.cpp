#include "parameter_options.h"

#include "handway/geometric/io/input_error.h"
#include "handway/planning/core/request_parameters.h"
#include "numbers.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <variant>

namespace handway::tools {
namespace {

using geometric::BoundChoice;
using geometric::BoundParameter;

/// "FLOAT in [0.1 - 1000]", as CLI11 writes its ranges.
std::string type_of(const BoundParameter& parameter) {
  if (const auto* choice = std::get_if<BoundChoice>(&parameter.value)) {
    return fmt::format("{{{}}}", fmt::join(choice->options, ","));
  }
  const bool is_whole = std::holds_alternative<int*>(parameter.value);
  return fmt::format("{} in [{:g} - {:g}]", is_whole ? "INT" : "FLOAT", parameter.lower,
                     parameter.upper);
}

std::string text_of(const BoundParameter& parameter) {
  return parameter.unit.empty() ? parameter.help : parameter.help + ", " + parameter.unit;
}

CLI::Option* add_flag(CLI::App& command, std::string name, const BoundParameter& parameter) {
  bool* const member = std::get<bool*>(parameter.value);
  const bool usual = *member;
  if (usual) {
    name.insert(2, "no-");
  }
  return command.add_flag_callback(
      name, [member, usual] { *member = !usual; },
      usual ? "Do not: " + parameter.help : parameter.help);
}

}  // namespace

CLI::Option* add_parameter_option(CLI::App& command, const std::string& name,
                                  const BoundParameter& parameter) {
  if (std::holds_alternative<bool*>(parameter.value)) {
    return add_flag(command, name, parameter);
  }
  const auto set = [parameter, name](const std::string& text) {
    try {
      set_from_text(parameter, text);
    } catch (const geometric::InputError& error) {
      throw CLI::ValidationError(name, error.what());
    }
  };
  return command.add_option_function<std::string>(name, set, text_of(parameter))
      ->type_name(type_of(parameter))
      ->default_str(to_text(value_of(parameter)));
}

std::vector<CLI::Option*> add_parameter_options(CLI::App& command,
                                                const std::vector<BoundParameter>& parameters) {
  std::vector<CLI::Option*> options;
  for (const BoundParameter& parameter : parameters) {
    options.push_back(
        add_parameter_option(command, geometric::option_name(parameter.key), parameter));
  }
  return options;
}

void add_seed_option(CLI::App& command, std::uint64_t& seed) {
  command.add_option("--seed", seed, "Seed of all random choices")
      ->check(not_negative())
      ->capture_default_str();
}

void add_threads_option(CLI::App& command, int& threads, const std::string& result) {
  add_parameter_options(command, {planning::threads_parameter(threads, result)});
}

}  // namespace handway::tools
