#include "recordings/recorded_rows.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/table_times.h"

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <utility>

namespace handway::device {

void take_rows(const std::filesystem::path& file, const std::vector<TextLine>& lines,
               std::vector<std::string>& warnings,
               const std::function<bool(const TextLine&)>& is_row,
               const std::function<void(const TextLine&)>& take) {
  for (const TextLine& line : lines) {
    if (trimmed(line.text).empty()) {
      continue;
    }
    if (!line.ended && !is_row(line)) {
      warnings.push_back(at_line(file, line) + ": left out, the row is cut off");
      return;
    }
    take(line);
  }
}

RecordedRows::RecordedRows(const std::filesystem::path& file, std::size_t columns, RawColumns raw)
    : file_(file), columns_(columns), raw_(std::move(raw)) {}

void RecordedRows::add(const TextLine& line, double time, const std::vector<double>& values,
                       const std::vector<double>& raw) {
  times_.push_back(time);
  lines_.push_back(line.number);
  values_.insert(values_.end(), values.begin(), values.end());
  raw_values_.insert(raw_values_.end(), raw.begin(), raw.end());
}

void RecordedRows::move_to(Recording& recording) {
  if (times_.empty()) {
    throw geometric::InputError({file_.string(), "", "no rows", "at least one", ""});
  }
  for (const std::string& warning : geometric::settle_times(times_, {1.0}, false, lines_)) {
    recording.warnings.push_back(fmt::format("{}: {}", file_.string(), warning));
  }
  const auto rows = static_cast<Eigen::Index>(times_.size());
  const auto columns = static_cast<Eigen::Index>(columns_);
  recording.times = Eigen::Map<const Eigen::VectorXd>(times_.data(), rows);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  recording.values = Eigen::Map<const RowMajor>(values_.data(), rows, columns);
  if (!raw_.names.empty()) {
    raw_.values = Eigen::Map<const RowMajor>(raw_values_.data(), rows, std::ssize(raw_.names));
    recording.raw = std::move(raw_);
  }
}

}  // namespace handway::device
