#include "handway/geometric/io/input_error.h"
#include "recording_readers.h"

#include <fmt/format.h>

namespace handway::device {

std::string at_line(const std::filesystem::path& file, const TextLine& line) {
  return fmt::format("{}:{}", file.string(), line.number);
}

RecordedRows::RecordedRows(const std::filesystem::path& file, std::size_t columns)
    : file_(file), columns_(columns) {}

void RecordedRows::add(const TextLine& line, double time, const std::vector<double>& values) {
  if (!times_.empty() && time < times_.back()) {
    throw geometric::InputError(
        {at_line(file_, line), "time", fmt::format("{} after {}", time, times_.back()),
         "time that doesn't run backwards", "Split the file there, or sort its rows"});
  }
  times_.push_back(time);
  values_.insert(values_.end(), values.begin(), values.end());
}

void RecordedRows::move_to(Recording& recording) {
  if (times_.empty()) {
    throw geometric::InputError({file_.string(), "", "no rows", "at least one", ""});
  }
  const auto rows = static_cast<Eigen::Index>(times_.size());
  const auto columns = static_cast<Eigen::Index>(columns_);
  recording.times = Eigen::Map<const Eigen::VectorXd>(times_.data(), rows);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  recording.values = Eigen::Map<const RowMajor>(values_.data(), rows, columns);
}

}  // namespace handway::device
