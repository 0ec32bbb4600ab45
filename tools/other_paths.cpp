#include "other_paths.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/table_text.h"
#include "handway/geometric/io/text_file.h"
#include "handway/planning/paths/path_file.h"
#include "on_all_cores.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;
using planning::PlanningProblem;

/// A path that has not been read yet.
struct PathSource {
  std::string planner;
  int problem = 0;
  std::uint64_t seed = 1;
  std::optional<double> time_s;
  fs::path file;                    ///< Empty: `rows` of a table.
  std::vector<std::size_t> rows{};  ///< Indices of lines.
};

/// A table with a header and the waypoints of many paths.
class PathTable {
 public:
  /// @throws InputError if it can't be read or has no column `problem`.
  explicit PathTable(fs::path file)
      : file_(std::move(file)), text_(geometric::read_text_file(file_, "a table of paths")) {
    std::vector<geometric::TextLine> lines = geometric::text_lines(text_);
    std::erase_if(lines, [](const geometric::TextLine& line) {
      return geometric::trimmed(line.text).empty();
    });
    if (lines.empty()) {
      return;
    }
    const char separator = geometric::separator_of(lines.front().text);
    for (const std::string& name : geometric::cell_names(lines.front().text, separator)) {
      columns_.emplace(name, columns_.size());
    }
    if (!columns_.contains("problem")) {
      throw InputError({fmt::format("{}:{}", file_.string(), lines.front().number), "header",
                        "no column \"problem\"",
                        "the columns problem, planner, seed and time_s, and one for each joint",
                        "Only \"problem\" and the joints are necessary"});
    }
    for (std::size_t i = 1; i < lines.size(); ++i) {
      rows_.push_back(geometric::cells(lines[i].text, separator));
      lines_.push_back(lines[i].number);
    }
  }

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] bool has(const std::string& column) const { return columns_.contains(column); }
  [[nodiscard]] std::string where(std::size_t row) const {
    return fmt::format("{}:{}", file_.string(), lines_[row]);
  }

  /// Returns a cell; empty if the table doesn't have it.
  [[nodiscard]] std::string_view cell(std::size_t row, const std::string& column) const {
    const auto found = columns_.find(column);
    return found == columns_.end() || found->second >= rows_[row].size()
               ? std::string_view()
               : rows_[row][found->second];
  }

  /// Returns a number; nothing for an empty cell.
  /// @throws InputError for a cell that is no number.
  [[nodiscard]] std::optional<double> number(std::size_t row, const std::string& column) const {
    const std::string_view text = cell(row, column);
    const std::optional<double> value = geometric::parse_cell(text);
    if (!value && !text.empty()) {
      throw InputError({where(row), column, fmt::format("\"{}\"", text), "a number", ""});
    }
    return value;
  }

 private:
  fs::path file_;
  std::string text_;
  std::map<std::string, std::size_t> columns_;
  std::vector<std::vector<std::string_view>> rows_;
  std::vector<std::size_t> lines_;
};

/// Index of each problem by its name.
using ProblemIndex = std::map<std::string, int, std::less<>>;

std::vector<PathSource> sources_in_table(const PathTable& table, const ProblemIndex& problems,
                                         const std::string& default_planner, OtherPaths& paths) {
  std::vector<PathSource> sources;
  std::optional<std::size_t> before;  // row
  for (std::size_t row = 0; row < table.size(); ++row) {
    const auto same = [&](const char* column) {
      return before && table.cell(row, column) == table.cell(*before, column);
    };
    const bool goes_on = same("problem") && same("planner") && same("seed");
    before = row;
    const auto problem = problems.find(table.cell(row, "problem"));
    if (problem == problems.end()) {
      if (!goes_on) {
        paths.skipped.push_back(fmt::format("{}: the campaign has no problem \"{}\"",
                                            table.where(row), table.cell(row, "problem")));
      }
      continue;
    }
    if (!goes_on) {
      const std::string_view planner = table.cell(row, "planner");
      const double seed = table.number(row, "seed").value_or(1.0);
      if (seed < 0.0 || seed != std::floor(seed) || seed > 1e15) {
        throw InputError(
            {table.where(row), "seed", fmt::format("{:g}", seed), "a whole number from 0 on", ""});
      }
      sources.push_back({planner.empty() ? default_planner : std::string(planner),
                         problem->second,
                         static_cast<std::uint64_t>(seed),
                         table.number(row, "time_s"),
                         {}});
    }
    sources.back().rows.push_back(row);
  }
  return sources;
}

std::vector<PathSource> sources_in_folder(const fs::path& folder, const ProblemIndex& problems,
                                          OtherPaths& paths) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && planning::is_path_file(entry.path())) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  const std::string own_name =
      fs::absolute(folder / "").lexically_normal().parent_path().filename();
  std::vector<PathSource> sources;
  for (const fs::path& file : files) {
    const fs::path name = file.lexically_relative(folder).replace_extension();
    const fs::path rest = name.lexically_relative(*name.begin());
    if (const auto whole = problems.find(name.generic_string()); whole != problems.end()) {
      sources.push_back({own_name, whole->second, 1, std::nullopt, file});
    } else if (const auto found = problems.find(rest.generic_string()); found != problems.end()) {
      sources.push_back({name.begin()->string(), found->second, 1, std::nullopt, file});
    } else {
      paths.skipped.push_back(fmt::format("{}: the campaign has no problem \"{}\" or \"{}\"",
                                          file.string(), name.generic_string(),
                                          rest.generic_string()));
    }
  }
  return sources;
}

// Joints that the table does not have stay at the start.
// @throws InputError if one of them is planned.
planning::Path path_in_table(const PathTable& table, const PathSource& source,
                             const PlanningProblem& problem) {
  const geometric::RobotModel& model = problem.model();
  const geometric::JointIndices planned = problem.planned_joints();
  planning::Path path;
  for (const std::size_t row : source.rows) {
    geometric::Configuration q = path.empty() ? problem.start : path.waypoints.back();
    for (int v = 0; v < model.variable_count(); ++v) {
      const std::string& joint = model.variable(v).name;
      const std::optional<double> value = table.number(row, joint);
      if (!value && std::ranges::count(planned, v) > 0) {
        throw InputError({table.where(row), joint, "no value", "a value of each planned joint",
                          "Name the columns as the robot's joints"});
      }
      q[v] = value.value_or(problem.start[v]);
    }
    path.waypoints.push_back(path.empty() ? q : model.nearest_equivalent(path.waypoints.back(), q));
  }
  return path;
}

planning::RunRecord record_of(const PathSource& source, int planner, const planning::Path& path,
                              const PlanningProblem& problem) {
  planning::RunRecord record;
  record.spec = {source.problem, planner, source.seed};
  record.solved = true;
  record.status = to_string(planning::PlanStatus::kSolved);
  record.time_s = source.time_s.value_or(std::numeric_limits<double>::quiet_NaN());
  record.cpu_s = record.time_s;
  record.min_clearance = std::numeric_limits<double>::quiet_NaN();
  record.smoothing_s = record.min_clearance;
  record.path = to_csv(path, problem.model());
  measure_lengths(path, problem.model(), record);
  check_again(problem, path, record);
  record.resolution = record.fault.empty() ? planning::PlanRequest{}.resolution : 0.0;
  return record;
}

std::vector<std::string> planners_of(const std::vector<PathSource>& sources) {
  std::vector<std::string> planners;
  for (const PathSource& source : sources) {
    if (std::ranges::count(planners, source.planner) == 0) {
      planners.push_back(source.planner);
    }
  }
  return planners;
}

}  // namespace

OtherPaths read_other_paths(const fs::path& paths, const planning::RunExecutor& executor) {
  ProblemIndex problems;
  for (const planning::CampaignProblem& problem : executor.campaign().problems) {
    problems.emplace(problem.name, static_cast<int>(problems.size()));
  }
  OtherPaths other;
  std::optional<PathTable> table;
  std::vector<PathSource> sources;
  if (std::error_code ignored; fs::is_directory(paths, ignored)) {
    sources = sources_in_folder(paths, problems, other);
  } else {
    table.emplace(paths);
    sources = sources_in_table(*table, problems, paths.stem().string(), other);
  }
  if (sources.empty()) {
    throw InputError(
        {paths.string(), "",
         other.skipped.empty() ? "no path"
                               : fmt::format("no path that can be checked: "
                                             "{}",
                                             other.skipped.front()),
         fmt::format("paths of problems such as \"{}\"", executor.campaign().problems.front().name),
         ""});
  }
  other.planners = planners_of(sources);
  std::vector<std::optional<planning::RunRecord>> records(sources.size());
  std::vector<std::string> faults(sources.size());
  on_all_cores(sources.size(), [&](std::size_t i) {
    const PathSource& source = sources[i];
    const auto planner = std::ranges::find(other.planners, source.planner) - other.planners.begin();
    const std::shared_ptr<const PlanningProblem> problem = executor.problem(source.problem);
    try {
      const planning::Path path = table ? path_in_table(*table, source, *problem)
                                        : planning::read_path(problem->model(), source.file);
      records[i] = record_of(source, static_cast<int>(planner), path, *problem);
    } catch (const InputError& error) {
      faults[i] = error.what();
    }
  });
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (records[i]) {
      other.records.push_back(std::move(*records[i]));
    } else {
      other.skipped.push_back(faults[i]);
    }
  }
  return other;
}

}  // namespace handway::tools
