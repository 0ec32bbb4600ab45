#include "handway/device/hand/joint_recording.h"

#include "glove/text_files.h"
#include "handway/geometric/formats/joint_table.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/plural.h"
#include "handway/geometric/io/table_times.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/math/units.h"
#include "recordings/array_recording.h"
#include "recordings/joint_series.h"
#include "recordings/recording_formats.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace handway::device {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;
using geometric::JointLookup;
using geometric::JointTable;
using geometric::RobotModel;

constexpr double kRate = 100.0;  // Hz, of rows without times
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kWhat = "a recording of a hand's joints";

JointLookup variables_of(const RobotModel& hand) {
  return [&hand](std::string_view name) { return hand.find_variable(name); };
}

void name_others(const JointTable& rows, std::vector<std::string>& warnings) {
  if (rows.others.empty()) {
    return;
  }
  constexpr std::ptrdiff_t kNamed = 5;
  const std::ptrdiff_t more = std::ssize(rows.others) - kNamed;
  const auto end = more > 0 ? std::next(rows.others.begin(), kNamed) : rows.others.end();
  warnings.push_back(fmt::format("passed over, as none of the hand's joints: {}{}",
                                 fmt::join(rows.others.begin(), end, ", "),
                                 more > 0 ? fmt::format(" and {} more", more) : ""));
}

// Joints without any value stay in the middle.
void fill_missing(const RobotModel& hand, JointTable& rows, std::vector<std::string>& warnings) {
  std::vector<std::string> missing;
  const geometric::Configuration neutral = hand.neutral();
  for (int v = 0; v < hand.variable_count(); ++v) {
    if (std::ranges::all_of(rows.values, [&](const auto& row) { return std::isnan(row[v]); })) {
      missing.push_back(hand.variable(v).name);
      std::ranges::for_each(rows.values, [&](auto& row) { row[v] = neutral[v]; });
    }
  }
  if (!missing.empty()) {
    warnings.push_back(
        fmt::format("no values of {}: taken to stand still", fmt::join(missing, ", ")));
  }
}

// Rows without gaps, at times that do not fall.
void keep_whole_rows(JointTable& rows, std::vector<std::string>& warnings) {
  JointTable kept;
  Eigen::VectorXd latest = Eigen::VectorXd::Constant(rows.values.front().size(), kUnknown);
  const bool has_times =
      std::isfinite(rows.times.front()) && std::ranges::any_of(rows.times, [&](double time) {
        return std::isfinite(time) && time != rows.times.front();
      });
  std::size_t gaps = 0;
  for (std::size_t i = 0; i < rows.values.size(); ++i) {
    const auto& row = rows.values[i];
    latest = rows.holds ? row.array().isNaN().select(latest, row).eval() : row;
    const double time = has_times ? rows.times[i] : static_cast<double>(i) / kRate;
    if (latest.array().isNaN().any() || std::isnan(time)) {
      ++gaps;
      continue;
    }
    kept.times.push_back(time);
    kept.values.push_back(latest);
    if (!rows.lines.empty()) {
      kept.lines.push_back(rows.lines[i]);
    }
  }
  if (gaps > 0) {
    warnings.push_back(geometric::plural(gaps, "row") + " left out, as a value is missing");
  }
  if (has_times) {
    std::ranges::move(
        geometric::settle_times(kept.times, rows.time_unit, rows.times_are_spelled, kept.lines),
        std::back_inserter(warnings));
  }
  const double begin = kept.times.empty() ? 0.0 : kept.times.front();
  std::ranges::transform(kept.times, kept.times.begin(),
                         [begin](double time) { return time - begin; });
  rows.times = std::move(kept.times);
  rows.values = std::move(kept.values);
}

// Finds a joint that several columns are named after.
void name_repeated(const RobotModel& hand, const JointTable& rows,
                   std::vector<std::string>& warnings) {
  for (int v = 0; v < hand.variable_count(); ++v) {
    if (rows.columns[static_cast<std::size_t>(v)] > 1) {
      warnings.push_back(fmt::format("{} columns are named after joint {}: the first is taken",
                                     rows.columns[static_cast<std::size_t>(v)],
                                     hand.variable(v).name));
    }
  }
}

// Single values that are not angles in any unit: their rows are left out.
void leave_out_absurd_rows(const RobotModel& hand, JointTable& rows,
                           std::vector<std::string>& warnings) {
  constexpr double kAbsurd = 1000.0;   // rad or degrees
  constexpr std::size_t kShare = 100;  // of rows: more make another unit
  std::vector<std::size_t> absurd;
  std::string first;
  for (std::size_t row = 0; row < rows.values.size(); ++row) {
    for (int v = 0; v < hand.variable_count(); ++v) {
      if (std::abs(rows.values[row][v]) > kAbsurd && (absurd.empty() || absurd.back() != row)) {
        first = absurd.empty()
                    ? fmt::format("{} has {:g}", hand.variable(v).name, rows.values[row][v])
                    : first;
        absurd.push_back(row);
      }
    }
  }
  if (absurd.empty() || absurd.size() * kShare > std::max(rows.values.size(), kShare)) {
    return;
  }
  const std::string where = rows.lines.empty() ? fmt::format("message {}", absurd.front() + 1)
                                               : fmt::format("line {}", rows.lines[absurd.front()]);
  warnings.push_back(fmt::format("{} left out, with values that are no angles: {} {}{}",
                                 geometric::plural(absurd.size(), "row"), where, first,
                                 absurd.size() > 1 ? ", …" : ""));
  for (const std::size_t row : absurd) {
    rows.values[row].setConstant(kUnknown);
    rows.times[row] = kUnknown;
  }
}

// No joint turns by more than a whole turn, so the unit is degrees.
void turn_to_radians(const RobotModel& hand, Eigen::MatrixXd& values,
                     std::vector<std::string>& warnings) {
  std::vector<int> turning;
  for (int v = 0; v < hand.variable_count(); ++v) {
    if (hand.variable(v).type != geometric::JointType::kPrismatic) {
      turning.push_back(v);
    }
  }
  if (turning.empty() ||
      values(Eigen::all, turning).lpNorm<Eigen::Infinity>() <= 2.0 * std::numbers::pi) {
    return;
  }
  values(Eigen::all, turning) *= geometric::kDegree;
  warnings.emplace_back("angles beyond a whole turn: all are taken for degrees");
}

}  // namespace

namespace {

// Values in a file with arrays or topics, or in text.
JointTable read_rows(const fs::path& given, const RobotModel& hand,
                     std::vector<std::string>& warnings) {
  const RecordingFile file(given);
  const JointLookup lookup = variables_of(hand);
  if (const std::unique_ptr<ArrayFile> arrays = open_arrays(file)) {
    return read_joint_series(*arrays, file.variable(), {lookup, hand.variable_count(), hand.name()},
                             warnings);
  }
  return geometric::read_joint_table(given, lookup, hand.variable_count(), kWhat);
}

// Returns whether a file with arrays or topics has one with values of half of the joints.
bool has_joint_arrays(const ArrayFile& arrays, const std::string& variable,
                      const RobotModel& hand) {
  const JointLookup lookup = variables_of(hand);
  const std::vector<RecordingVariable> fitting =
      joint_variables(arrays, {lookup, hand.variable_count(), hand.name()});
  return std::ranges::any_of(fitting, [&](const RecordingVariable& one) {
    return (variable.empty() || one.name == variable) &&
           2 * columns_of(one) >= static_cast<std::size_t>(hand.variable_count());
  });
}

}  // namespace

Recording read_joint_recording(const fs::path& file, const RobotModel& hand) {
  Recording recording;
  JointTable rows = read_rows(file, hand, recording.warnings);
  const bool messages = rows.lines.empty();
  const auto is_known = [](const Eigen::VectorXd& row) { return !row.array().isNaN().all(); };
  if (std::ranges::none_of(rows.values, is_known)) {
    throw InputError({file.string(), "", "no values of joints of " + hand.name(),
                      messages ? "messages with names and positions of its joints"
                               : "a header with the names of its joints, and rows of their values",
                      fmt::format("Its joints are {}", fmt::join(OwnJoints(hand).joints(), ", "))});
  }
  recording.header.kind = RecordingKind::kAngles;
  recording.header.origin = "joints of " + hand.name();
  name_others(rows, recording.warnings);
  name_repeated(hand, rows, recording.warnings);
  if (rows.is_cut_off) {
    recording.warnings.push_back(
        fmt::format("the last {} is not whole and is left out", messages ? "message" : "row"));
  }
  leave_out_absurd_rows(hand, rows, recording.warnings);
  fill_missing(hand, rows, recording.warnings);
  keep_whole_rows(rows, recording.warnings);
  if (rows.values.empty()) {
    throw InputError({file.string(), "", "no row without gaps", "rows with all joints", ""});
  }
  recording.times = Eigen::VectorXd::Map(rows.times.data(), std::ssize(rows.times));
  recording.values.resize(std::ssize(rows.values), hand.variable_count());
  for (Eigen::Index row = 0; row < recording.values.rows(); ++row) {
    recording.values.row(row) = rows.values[static_cast<std::size_t>(row)];
  }
  if (!rows.units_are_named) {
    turn_to_radians(hand, recording.values, recording.warnings);
  }
  return recording;
}

bool is_joint_recording(const fs::path& file, const RobotModel& hand) {
  const RecordingFile recording(file);
  if (const std::unique_ptr<ArrayFile> arrays = open_arrays(recording)) {
    return recordable_variables(*arrays).empty() &&
           has_joint_arrays(*arrays, recording.variable(), hand);
  }
  const std::string head = geometric::head_of(file);
  if (has_joint_messages(head)) {
    return true;
  }
  std::set<int> named;
  for (const TextLine& line : text_lines(head)) {
    const std::string_view header = trimmed(line.text);
    for (const std::string& name : geometric::cell_names(line.text, separator_of(header))) {
      if (const auto variable = geometric::joint_of_column(variables_of(hand), name)) {
        named.insert(*variable);
      }
    }
    if (!named.empty()) {
      break;
    }
  }
  return !named.empty() && 2 * std::ssize(named) >= hand.variable_count();
}

OwnJoints::OwnJoints(const RobotModel& hand) {
  for (int v = 0; v < hand.variable_count(); ++v) {
    joints_.push_back(hand.variable(v).name);
  }
  lower_ = hand.lower();
  upper_ = hand.upper();
}

std::vector<bool> OwnJoints::driven() const { return std::vector<bool>(joints_.size(), true); }

MappedPostures OwnJoints::map_recording(const Recording& recording,
                                        const std::stop_token& /*stop*/) const {
  return within_limits(recording.values);
}

}  // namespace handway::device
