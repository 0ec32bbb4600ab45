#include "handway/device/recordings/recorded_table.h"

#include "glove/recording_mark.h"
#include "glove/text_files.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/formats/joint_table.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/plural.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/table_text.h"
#include "handway/geometric/io/table_times.h"
#include "recordings/array_recording.h"
#include "recordings/joint_series.h"
#include "recordings/recording_formats.h"
#include "recordings/table_bytes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace handway::device {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;
using geometric::JointTable;

constexpr double kRateWithoutTimes = 100.0;  // Hz

RecordedTable table_of_recording(Recording recording) {
  RecordedTable table;
  for (const int sensor : recording.header.sensors) {
    table.names.emplace_back(cyberglove_sensors()[static_cast<std::size_t>(sensor)].name);
  }
  table.times = std::move(recording.times);
  table.values = std::move(recording.values);
  table.warnings = std::move(recording.warnings);
  table.glove = std::move(recording.header);
  table.raw = std::move(recording.raw);
  return table;
}

/// Rows with gaps, in the order of a file.
struct RawRows {
  std::vector<std::string> names;
  Eigen::MatrixXd values;     ///< NaN: missing.
  std::vector<double> times;  ///< Empty, or one for each row; NaN: missing.
  geometric::TimeUnit time_unit = {};
  bool times_are_spelled = false;
  std::vector<std::string> warnings = {};
};

std::vector<Eigen::Index> columns_with_values(RawRows& rows) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index column = 0; column < rows.values.cols(); ++column) {
    if (rows.values.col(column).array().isFinite().any()) {
      kept.push_back(column);
    } else {
      rows.warnings.push_back(fmt::format("column {} left out, it has no number",
                                          rows.names[static_cast<std::size_t>(column)]));
    }
  }
  return kept;
}

/// Leaves out rows and columns with gaps, and settles the times.
RecordedTable table_of_rows(const fs::path& file, RawRows rows) {
  const std::vector<Eigen::Index> columns = columns_with_values(rows);
  std::vector<Eigen::Index> kept;
  std::vector<double> times;
  for (Eigen::Index row = 0; row < rows.values.rows(); ++row) {
    const double time = rows.times.empty() ? static_cast<double>(row) / kRateWithoutTimes
                                           : rows.times[static_cast<std::size_t>(row)];
    if (std::isfinite(time) && !columns.empty() &&
        rows.values.row(row)(columns).array().isFinite().all()) {
      kept.push_back(row);
      times.push_back(time);
    }
  }
  if (kept.empty()) {
    throw InputError({file.string(), "", "no row of numbers without gaps", "at least one", ""});
  }
  if (const auto gaps = rows.values.rows() - std::ssize(kept); gaps > 0) {
    rows.warnings.push_back(geometric::plural(gaps, "row") + " left out, as a value is missing");
  }
  if (rows.times.empty()) {
    rows.warnings.push_back(
        fmt::format("no times: {:g} rows a second are assumed", kRateWithoutTimes));
  } else {
    std::ranges::move(geometric::settle_times(times, rows.time_unit, rows.times_are_spelled),
                      std::back_inserter(rows.warnings));
  }
  RecordedTable table;
  for (const Eigen::Index column : columns) {
    table.names.push_back(rows.names[static_cast<std::size_t>(column)]);
  }
  table.times = Eigen::VectorXd::Map(times.data(), std::ssize(times)).array() - times.front();
  table.values = rows.values(kept, columns);
  for (const std::string& warning : rows.warnings) {
    table.warnings.push_back(fmt::format("{}: {}", file.string(), warning));
  }
  return table;
}

RecordedTable table_of_series(const fs::path& file, Series series) {
  RawRows rows{std::move(series.names), std::move(series.values), std::move(series.times),
               series.time_unit};
  rows.warnings = std::move(series.warnings);
  if (rows.names.empty()) {
    for (Eigen::Index column = 1; column <= rows.values.cols(); ++column) {
      rows.names.push_back(fmt::format("joint_{}", column));
    }
    rows.warnings.push_back(
        fmt::format("columns of {} have no names: they are called joint_1 to "
                    "joint_{}",
                    series.variable.name, rows.values.cols()));
  }
  return table_of_rows(file, std::move(rows));
}

/// The joints that a text names, in its order.
class JointsOfText {
 public:
  JointsOfText(const fs::path& file, const std::string& what) {
    std::vector<std::string> asked;
    const geometric::JointLookup collect = [&](std::string_view name) {
      if (asked.size() < kMostAsked && std::ranges::find(asked, name) == asked.end()) {
        asked.emplace_back(name);
      }
      return std::optional<int>();
    };
    const JointTable table = geometric::read_joint_table(file, collect, 0, what);
    std::ranges::copy_if(asked, std::back_inserter(names_),
                         [&](const std::string& name) { return table.others.contains(name); });
    for (std::size_t i = 0; i < names_.size(); ++i) {
      numbers_[names_[i]] = static_cast<int>(i);
    }
  }

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] geometric::JointLookup lookup() const {
    return [this](std::string_view name) {
      const auto found = numbers_.find(std::string(name));
      return found == numbers_.end() ? std::optional<int>() : found->second;
    };
  }

 private:
  static constexpr std::size_t kMostAsked = 5000;

  std::vector<std::string> names_;
  std::map<std::string, int> numbers_;
};

RecordedTable table_of_joint_text(const fs::path& file) {
  constexpr const char* kWhatJoints = "a recording of joints";
  const JointsOfText joints(file, kWhatJoints);
  const auto count = static_cast<int>(joints.names().size());
  if (count == 0) {
    throw InputError(
        {file.string(), "", "no names of joints", "names and positions of joints", ""});
  }
  const JointTable read = geometric::read_joint_table(file, joints.lookup(), count, kWhatJoints);
  RawRows rows;
  rows.names = joints.names();
  rows.times_are_spelled = read.times_are_spelled;
  rows.time_unit = read.time_unit;
  rows.values.resize(std::ssize(read.values), count);
  for (Eigen::Index row = 0; row < rows.values.rows(); ++row) {
    const Eigen::VectorXd& values = read.values[static_cast<std::size_t>(row)];
    rows.values.row(row) = values;
    if (read.holds && row > 0) {
      rows.values.row(row) =
          values.array().isNaN().select(rows.values.row(row - 1).transpose(), values).transpose();
    }
  }
  if (std::ranges::any_of(read.times, [](double time) { return std::isfinite(time); })) {
    rows.times = read.times;
  }
  return table_of_rows(file, std::move(rows));
}

/// A table of anything, of a file that is no recording of a glove.
RecordedTable read_other_recording(const RecordingFile& file, const std::exception_ptr& reason) {
  if (const std::unique_ptr<ArrayFile> arrays = open_arrays(file)) {
    return table_of_series(file.path(), arrays->series(file.variable().empty() ? only_table(*arrays)
                                                                               : file.variable()));
  }
  try {
    RecordedTable table = table_of_joint_text(file.path());
    if (!are_sensors(table.names)) {
      return table;
    }
  } catch (const InputError&) {
    if (has_joint_messages(file.head())) {
      throw;
    }
  }
  std::rethrow_exception(reason);
}

/// Appends cells, empty ones for missing values.
void append_cells(std::string& text, const Eigen::RowVectorXd& values) {
  for (const double value : values) {
    if (std::isfinite(value)) {
      fmt::format_to(std::back_inserter(text), ",{}", value);
    } else {
      text += ',';
    }
  }
}

std::string csv_text(const RecordedTable& table) {
  std::string text = "time";
  for (const std::string& name : table.names) {
    text += ',' + geometric::csv_cell(name);
  }
  for (const std::string& label : table.raw ? labels_of(*table.raw) : std::vector<std::string>{}) {
    text += ',' + geometric::csv_cell(fmt::format("{}{}", kRawMark, label));
  }
  text += '\n';
  for (Eigen::Index row = 0; row < table.values.rows(); ++row) {
    fmt::format_to(std::back_inserter(text), "{}", table.times[row]);
    for (const double value : table.values.row(row)) {
      fmt::format_to(std::back_inserter(text), ",{}", value);
    }
    if (table.raw) {
      append_cells(text, table.raw->values.row(row));
    }
    text += '\n';
  }
  return text;
}

void write_csv(const RecordedTable& table, const fs::path& file) {
  if (table.glove) {
    write_recording({*table.glove, table.times, table.values, {}, {}, table.raw}, file);
  } else {
    geometric::replace_file(file, csv_text(table));
  }
}

/// Joins raw columns by their labels. @param rows, next_rows of the tables that they belong to.
std::optional<RawColumns> joined_raw(const std::optional<RawColumns>& raw, Eigen::Index rows,
                                     const std::optional<RawColumns>& next,
                                     Eigen::Index next_rows) {
  if (!raw && !next) {
    return std::nullopt;
  }
  RawColumns joined = raw.value_or(RawColumns{});
  std::vector<std::string> labels = labels_of(joined);
  const std::vector<std::string> more = next ? labels_of(*next) : std::vector<std::string>{};
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < more.size(); ++i) {
    const auto known = std::ranges::find(labels, more[i]);
    columns.push_back(known - labels.begin());
    if (known == labels.end()) {
      labels.push_back(more[i]);
      joined.add(next->names[i], next->units[i]);
    }
  }
  Eigen::MatrixXd values = Eigen::MatrixXd::Constant(rows + next_rows, std::ssize(labels),
                                                     std::numeric_limits<double>::quiet_NaN());
  if (raw) {
    values.topLeftCorner(rows, raw->values.cols()) = raw->values;
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    values.col(columns[i]).tail(next_rows) = next->values.col(static_cast<Eigen::Index>(i));
  }
  joined.values = std::move(values);
  return joined;
}

double usual_step(const Eigen::VectorXd& times) {
  const Eigen::Index steps = times.size() - 1;
  return steps > 0 ? (times[steps] - times[0]) / static_cast<double>(steps)
                   : 1.0 / kRateWithoutTimes;
}

}  // namespace

RecordedTable read_recorded_table(const fs::path& given) {
  std::exception_ptr reason;
  try {
    return table_of_recording(read_recording(given));
  } catch (const InputError&) {
    reason = std::current_exception();
  }
  return read_other_recording(RecordingFile(given), reason);
}

RecordedTable joined_tables(std::span<const RecordedTable> tables,
                            std::span<const fs::path> files) {
  if (tables.empty() || tables.size() != files.size()) {
    throw std::invalid_argument("joined tables need a file each");
  }
  RecordedTable joined = tables.front();
  for (std::size_t i = 1; i < tables.size(); ++i) {
    const RecordedTable& next = tables[i];
    const bool alike = next.glove.has_value() == joined.glove.has_value() &&
                       (!next.glove || next.glove->kind == joined.glove->kind);
    if (next.names != joined.names || !alike) {
      throw InputError(
          {files[i].string(), "",
           geometric::plural(next.names.size(), "column") + " with other names or units",
           fmt::format("the {} of {}", geometric::plural(joined.names.size(), "column"),
                       files[0].string()),
           "Convert the files one by one."});
    }
    const Eigen::Index before = joined.times.size();
    const double begin = joined.times[before - 1] + usual_step(joined.times) - next.times[0];
    joined.times.conservativeResize(before + next.times.size());
    joined.times.tail(next.times.size()) = next.times.array() + begin;
    joined.values.conservativeResize(before + next.values.rows(), Eigen::NoChange);
    joined.values.bottomRows(next.values.rows()) = next.values;
    joined.raw = joined_raw(joined.raw, before, next.raw, next.values.rows());
    joined.warnings.insert(joined.warnings.end(), next.warnings.begin(), next.warnings.end());
  }
  return joined;
}

namespace {

struct WrittenFormat {
  std::string ending;
  void (*write)(const RecordedTable& table, const fs::path& file);
};

template <std::string (*kBytes)(const RecordedTable& table)>
void write_bytes(const RecordedTable& table, const fs::path& file) {
  geometric::replace_file(file, kBytes(table));
}

const std::vector<WrittenFormat>& written_formats() {
  static const std::vector<WrittenFormat> kFormats{{".csv", write_csv},
                                                   {".npz", write_bytes<npz_bytes>},
                                                   {".h5", write_bytes<hdf5_bytes>},
                                                   {".hdf5", write_bytes<hdf5_bytes>},
                                                   {".mcap", write_bytes<mcap_bytes>},
                                                   {".parquet", write_bytes<parquet_bytes>}};
  return kFormats;
}

}  // namespace

std::vector<std::string> recorded_table_endings() {
  std::vector<std::string> endings;
  std::ranges::transform(written_formats(), std::back_inserter(endings), &WrittenFormat::ending);
  return endings;
}

void write_recorded_table(const RecordedTable& table, const fs::path& file) {
  const auto format = std::ranges::find_if(written_formats(), [&](const WrittenFormat& one) {
    return geometric::has_extension(file, one.ending);
  });
  if (format == written_formats().end()) {
    throw geometric::OutputError(
        {file.string(), "", "another ending",
         fmt::format("one of {}", fmt::join(recorded_table_endings(), ", ")), ""});
  }
  format->write(table, file);
}

}  // namespace handway::device
