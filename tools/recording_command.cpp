#include "commands.h"
#include "handway/device/recordings/recorded_table.h"
#include "handway/device/recordings/recording_contents.h"
#include "handway/geometric/io/alike_lines.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/plural.h"
#include "printing.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;
using device::RecordedTable;
using device::RecordingContents;
using device::RecordingVariable;
using Json = nlohmann::ordered_json;

/// Facts known of a file.
struct FileInfo {
  fs::path file;
  RecordingContents contents;
  std::optional<RecordedTable> table;
  std::string reason;  ///< Reason why there is no table.
};

/// Reads a file. One with several variables has no table unless it is clear which is meant.
FileInfo read_info(const fs::path& file) {
  FileInfo info{file, device::recording_contents(file), {}, {}};
  try {
    info.table = device::read_recorded_table(file);
  } catch (const geometric::InputError& error) {
    if (info.contents.variables.empty() || file.string().find('#') != std::string::npos) {
      throw;
    }
    info.reason = error.what();
  }
  return info;
}

double duration_of(const RecordedTable& table) {
  return table.times[table.times.size() - 1] - table.times[0];
}

double rate_of(const RecordedTable& table) {
  const double duration = duration_of(table);
  return duration > 0.0 ? static_cast<double>(table.times.size() - 1) / duration : 0.0;
}

std::string unit_of(const RecordedTable& table) {
  return table.glove ? device::to_string(table.glove->kind) + " of a glove" : "values of joints";
}

std::vector<std::string> raw_labels(const RecordedTable& table) {
  return table.raw ? device::labels_of(*table.raw) : std::vector<std::string>{};
}

Json table_json(const RecordedTable& table) {
  return {{"rows", table.times.size()},
          {"duration_s", duration_of(table)},
          {"rate_hz", rate_of(table)},
          {"values", unit_of(table)},
          {"columns", table.names},
          {"raw_columns", raw_labels(table)},
          {"warnings", geometric::merged_alike(table.warnings)}};
}

Json info_json(const FileInfo& info) {
  Json json{{"file", info.file.string()}, {"format", info.contents.kind.name}};
  if (info.table) {
    json.update(table_json(*info.table));
  } else {
    json["reason"] = info.reason;
  }
  Json variables = Json::array();
  for (const RecordingVariable& variable : info.contents.variables) {
    variables.push_back({{"name", variable.name},
                         {"shape", variable.shape},
                         {"type", variable.type},
                         {"problem", variable.problem}});
  }
  json["variables"] = variables;
  return json;
}

void print_info(const FileInfo& info) {
  print_out("{}: {}. {}\n", info.file.string(), info.contents.kind.name,
            info.contents.kind.description);
  if (info.table) {
    const RecordedTable& table = *info.table;
    print_out("  {} of {}, {:.4g} s at {:.4g} Hz\n  {}: {}\n",
              geometric::plural(table.times.size(), "row"), unit_of(table), duration_of(table),
              rate_of(table), geometric::plural(table.names.size(), "column"),
              fmt::join(table.names, ", "));
    if (const std::vector<std::string> raw = raw_labels(table); !raw.empty()) {
      print_out("  {}: {}\n", geometric::plural(raw.size(), "raw column"), fmt::join(raw, ", "));
    }
    for (const std::string& warning : geometric::merged_alike(table.warnings)) {
      print_out("  warning: {}\n", warning);
    }
  }
  for (const RecordingVariable& variable : info.contents.variables) {
    print_out("  variable {}, {}{}\n", to_string(variable), variable.type,
              variable.problem.empty() ? "" : "; not read: " + variable.problem);
  }
  if (!info.reason.empty()) {
    print_out("  no single table: {}\n", info.reason);
  }
}

int info(const std::vector<fs::path>& files, bool as_json) {
  Json all = Json::array();
  for (const fs::path& file : files) {
    const FileInfo read = read_info(file);
    if (as_json) {
      all.push_back(info_json(read));
    } else {
      print_info(read);
    }
  }
  if (as_json) {
    print_out("{}\n", all.dump(2, ' ', false, Json::error_handler_t::replace));
  }
  return kDone;
}

int convert(const std::vector<fs::path>& files, const fs::path& out) {
  std::vector<RecordedTable> tables;
  for (const fs::path& file : files) {
    tables.push_back(device::read_recorded_table(file));
  }
  const RecordedTable table = device::joined_tables(tables, files);
  device::write_recorded_table(table, out);
  for (const std::string& warning : geometric::merged_alike(table.warnings)) {
    print_out("warning: {}\n", warning);
  }
  print_out("{} of {}, {:.4g} s, in {}\n", geometric::plural(table.times.size(), "row"),
            geometric::plural(table.names.size(), "column"), duration_of(table), out.string());
  return kDone;
}

std::string check_ending(const std::string& file) {
  const std::vector<std::string> endings = device::recorded_table_endings();
  const bool known = std::ranges::any_of(
      endings, [&](const std::string& ending) { return geometric::has_extension(file, ending); });
  return known ? "" : fmt::format("{} must end in one of {}", file, fmt::join(endings, ", "));
}

void add_files(CLI::App& command, std::vector<fs::path>& files) {
  command
      .add_option("file", files,
                  "Recording of a glove, of landmarks or of a robot's joints; FILE#VARIABLE "
                  "chooses an array or a topic of a file with several")
      ->type_name("FILE")
      ->required();
}

}  // namespace

void add_recording_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "recording", "Show and convert recordings of gloves, landmarks and joints");
  command->require_subcommand(1);
  auto files = std::make_shared<std::vector<fs::path>>();

  CLI::App* shown = command->add_subcommand(
      "info", "Show format, length, columns, variables and warnings of recordings");
  auto as_json = std::make_shared<bool>(false);
  add_files(*shown, *files);
  shown->add_flag("--json", *as_json, "Print a list in JSON, one object for each file");
  shown->callback([files, as_json, &exit_code] { exit_code = info(*files, *as_json); });

  CLI::App* converted = command->add_subcommand(
      "convert", "Write recordings as CSV, NumPy or HDF5; several are put one after the other");
  auto out = std::make_shared<fs::path>();
  add_files(*converted, *files);
  converted
      ->add_option("--out", *out,
                   fmt::format("File to write, with one of the endings {}",
                               fmt::join(device::recorded_table_endings(), ", ")))
      ->check(check_ending)
      ->required();
  converted->callback([files, out, &exit_code] { exit_code = convert(*files, *out); });
}

}  // namespace handway::tools
