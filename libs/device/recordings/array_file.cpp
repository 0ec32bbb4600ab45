#include "recordings/array_file.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/table_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <functional>
#include <iterator>
#include <numeric>
#include <system_error>

namespace handway::device {
namespace {

using geometric::InputError;

constexpr std::size_t kHandPoints = 21;
constexpr std::size_t kMostNamed = 30;  // variables in a message

/// The part of a name behind its group: "qpos" of "/observations/qpos".
std::string leaf_of(const std::string& name) { return name.substr(name.find_last_of("/.") + 1); }

/// The group of a name with its separator: "/observations/" of "/observations/qpos".
std::string group_of(const std::string& name) {
  return name.substr(0, name.find_last_of("/.") + 1);
}

/// The group around a group; "/" of "/observations/".
std::string outer_group(const std::string& group) {
  return group.empty() ? group : group_of(group.substr(0, group.size() - 1));
}

std::size_t size_of(const RecordingVariable& variable) {
  return variable.shape.empty() ? 1 : variable.shape.front() * columns_of(variable);
}

/// Returns whether one dimension at most is greater than 1.
bool is_flat(const RecordingVariable& variable) {
  return std::ranges::count_if(variable.shape, [](std::size_t side) { return side > 1; }) <= 1;
}

bool is_raw(const RecordingVariable& variable) { return leaf_of(variable.name) == "raw"; }

/// Finds the nearest variable that fits: in a variable's own group, or in one around it.
const RecordingVariable* nearest(const std::vector<RecordingVariable>& all,
                                 const RecordingVariable& around,
                                 const std::function<bool(const RecordingVariable&)>& fits) {
  for (std::string group = group_of(around.name);; group = outer_group(group)) {
    const auto found = std::ranges::find_if(all, [&](const RecordingVariable& variable) {
      return group_of(variable.name) == group && variable.name != around.name &&
             variable.problem.empty() && fits(variable);
    });
    if (found != all.end() || group.empty()) {
      return found == all.end() ? nullptr : &*found;
    }
  }
}

/// Finds the variable of which all others are parts, as "state" of "episode_0/state" and
/// "episode_1/state".
const RecordingVariable* whole_of(const std::vector<RecordingVariable>& fitting) {
  for (const RecordingVariable& whole : fitting) {
    const bool has_all = std::ranges::all_of(fitting, [&](const RecordingVariable& part) {
      return &part == &whole || part.name.ends_with("/" + whole.name);
    });
    if (has_all) {
      return &whole;
    }
  }
  return nullptr;
}

/// Some columns of a variable: "qpos[0:7]".
struct ColumnRange {
  std::string_view variable;
  std::size_t first = 0;
  std::size_t end = 0;
};

std::optional<ColumnRange> column_range(std::string_view name) {
  const std::size_t open = name.rfind('[');
  const std::size_t colon = name.find(':', std::min(open, name.size()));
  if (open == std::string_view::npos || colon == std::string_view::npos || !name.ends_with(']')) {
    return std::nullopt;
  }
  ColumnRange range{name.substr(0, open)};
  const auto read = [](std::string_view digits, std::size_t& number) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return error == std::errc() && end == digits.data() + digits.size();
  };
  return read(name.substr(open + 1, colon - open - 1), range.first) &&
                 read(name.substr(colon + 1, name.size() - colon - 2), range.end)
             ? std::optional(range)
             : std::nullopt;
}

Series columns_of_series(const std::filesystem::path& file, Series series,
                         const ColumnRange& range) {
  const auto columns = static_cast<std::size_t>(series.values.cols());
  if (range.first >= range.end || range.end > columns) {
    throw InputError({file.string(), fmt::format("variable {}", range.variable),
                      fmt::format("columns {} to {}", range.first, range.end),
                      fmt::format("a part of its {} columns, counted from 0", columns), ""});
  }
  const std::size_t count = range.end - range.first;
  series.values =
      series.values
          .middleCols(static_cast<Eigen::Index>(range.first), static_cast<Eigen::Index>(count))
          .eval();
  if (!series.names.empty()) {
    const auto first = series.names.begin() + static_cast<std::ptrdiff_t>(range.first);
    series.names = {first, first + static_cast<std::ptrdiff_t>(count)};
  }
  series.variable.shape = {static_cast<std::size_t>(series.values.rows()), count};
  return series;
}

}  // namespace

std::size_t columns_of(const RecordingVariable& variable) {
  return variable.shape.empty() ? 1
                                : std::accumulate(variable.shape.begin() + 1, variable.shape.end(),
                                                  std::size_t{1}, std::multiplies<>());
}

bool has_landmarks(const RecordingVariable& variable) {
  std::vector<std::size_t> sides = variable.shape;
  if (sides.size() < 2) {
    return false;
  }
  sides.erase(sides.begin());
  std::erase(sides, std::size_t{1});
  return sides == std::vector<std::size_t>{kHandPoints, 3} ||
         sides == std::vector<std::size_t>{3 * kHandPoints};
}

std::string ArrayFile::listed() const {
  std::string text;
  for (std::size_t i = 0; i < std::min(variables_.size(), kMostNamed); ++i) {
    const std::string& problem = variables_[i].problem;
    text +=
        (i > 0 ? ", " : "") + to_string(variables_[i]) + (problem.empty() ? "" : " of " + problem);
  }
  if (variables_.size() > kMostNamed) {
    text += fmt::format(" and {} more", variables_.size() - kMostNamed);
  }
  return text.empty() ? "no array of numbers" : text;
}

Series ArrayFile::series(std::string_view name) const {
  const auto found = std::ranges::find(variables_, name, &RecordingVariable::name);
  if (found == variables_.end()) {
    if (const std::optional<ColumnRange> range = column_range(name)) {
      return columns_of_series(path_, series(range->variable), *range);
    }
    std::vector<std::string> known;
    std::ranges::transform(variables_, std::back_inserter(known), &RecordingVariable::name);
    const bool is_near = !geometric::nearest_name(name, known).empty();
    throw InputError({path_.string(), fmt::format("variable {}", name), "no variable of that name",
                      "one of " + listed(), is_near ? geometric::advise_name(name, known) : ""});
  }
  if (!found->problem.empty()) {
    throw InputError({path_.string(), fmt::format("variable {}", name), found->problem,
                      "an array of numbers", ""});
  }
  Series series = read(*found);
  series.variable = *found;
  series.names = column_names(*found);
  return series;
}

std::optional<RawColumns> ArrayFile::raw_columns(const RecordingVariable& variable) const {
  const auto raw = std::ranges::find_if(variables_, [&](const RecordingVariable& other) {
    return is_raw(other) && other.name != variable.name && other.problem.empty() &&
           group_of(other.name) == group_of(variable.name) && !other.shape.empty() &&
           !variable.shape.empty() && other.shape.front() == variable.shape.front();
  });
  if (raw == variables_.end()) {
    return std::nullopt;
  }
  const Series read = series(raw->name);
  if (read.names.empty() || read.values.rows() == 0) {
    return std::nullopt;
  }
  RawColumns columns = raw_columns_of_labels(read.names);
  columns.values = read.values;
  return columns;
}

std::vector<RecordingVariable> without_raw(std::vector<RecordingVariable> variables) {
  if (!std::ranges::all_of(variables, is_raw)) {
    std::erase_if(variables, is_raw);
  }
  return variables;
}

const RecordingVariable* NamedArrays::times_of(const RecordingVariable& variable) const {
  const std::size_t rows = variable.shape.empty() ? 0 : variable.shape.front();
  return nearest(variables_, variable, [rows](const RecordingVariable& other) {
    const auto time = geometric::time_name(leaf_of(other.name));
    return rows > 1 && other.type != kText && is_flat(other) && size_of(other) == rows && time &&
           time->plain && time->kind != geometric::TimeName::Kind::kDate;
  });
}

std::vector<std::string> NamedArrays::column_names(const RecordingVariable& variable) const {
  const auto own = std::ranges::find(variables_, fmt::format("{}_names", variable.name),
                                     &RecordingVariable::name);
  if (own != variables_.end() && own->type == kText && size_of(*own) == columns_of(variable)) {
    return words(*own);
  }
  const RecordingVariable* names =
      nearest(variables_, variable, [&variable](const RecordingVariable& other) {
        constexpr std::array kNames{"names", "joint_names", "columns", "joints", "name", "labels"};
        return other.type == kText && size_of(other) == columns_of(variable) &&
               std::ranges::count(kNames, leaf_of(other.name)) > 0;
      });
  return names == nullptr ? std::vector<std::string>{} : words(*names);
}

Series NamedArrays::read(const RecordingVariable& variable) const {
  Series series;
  series.values = numbers(variable);
  if (const RecordingVariable* times = times_of(variable)) {
    const Eigen::MatrixXd read = numbers(*times);
    series.times.assign(read.data(), read.data() + read.size());
    series.time_unit = geometric::time_name(leaf_of(times->name))->unit;
  }
  return series;
}

std::vector<std::string> NamedArrays::words(const RecordingVariable& /*variable*/) const {
  return {};
}

std::string only_variable(const ArrayFile& arrays, const std::vector<RecordingVariable>& fitting,
                          const std::string& expected,
                          const std::function<std::string(const std::string&)>& advice) {
  if (fitting.size() == 1) {
    return fitting.front().name;
  }
  if (const RecordingVariable* whole = whole_of(fitting)) {
    return whole->name;
  }
  std::string found;
  for (std::size_t i = 0; i < std::min(fitting.size(), kMostNamed); ++i) {
    found += (i > 0 ? ", " : "") + to_string(fitting[i]);
  }
  if (fitting.size() > kMostNamed) {
    found += fmt::format(" and {} more", fitting.size() - kMostNamed);
  }
  throw InputError({arrays.path().string(), "",
                    fitting.empty()
                        ? arrays.listed()
                        : fmt::format("{} variables that may be meant: {}", fitting.size(), found),
                    expected, advice(fitting.empty() ? "NAME" : fitting.front().name)});
}

}  // namespace handway::device
