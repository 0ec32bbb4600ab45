#include "handway/device/glove/recording_filters.h"

#include "butterworth.h"
#include "handway/device/glove/recording_quality.h"
#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace handway::device {
namespace {

using geometric::InputError;

constexpr double kEven = 1e-3;                    // of a step
constexpr double kHighestCutoff = 0.4;            // of the rate
constexpr double kBothRuns = 1.2464504802804612;  // (√2 - 1)^(-1/4)

Recording with_rows(const Recording& recording, const std::vector<Eigen::Index>& rows) {
  Recording result;
  result.header = recording.header;
  result.warnings = recording.warnings;
  result.times = recording.times(rows);
  result.values = recording.values(rows, Eigen::all);
  return result;
}

bool is_even(const Eigen::VectorXd& times, double step) {
  for (Eigen::Index i = 1; i < times.size(); ++i) {
    if (std::abs(times[i] - times[i - 1] - step) > kEven * step) {
      return false;
    }
  }
  return true;
}

}  // namespace

Recording resampled(const Recording& recording, double rate) {
  const Eigen::VectorXd& times = recording.times;
  const double duration = times.size() < 2 ? 0.0 : times[times.size() - 1] - times[0];
  if (!(duration > 0.0)) {
    throw InputError({"recording", "time", "no duration", "two times or more to resample", ""});
  }
  const auto rows = static_cast<Eigen::Index>(std::floor(duration * rate * (1.0 + 1e-12))) + 1;
  Recording result;
  result.header = recording.header;
  result.warnings = recording.warnings;
  result.times.resize(rows);
  result.values.resize(rows, recording.values.cols());
  Eigen::Index below = 0;
  for (Eigen::Index row = 0; row < rows; ++row) {
    const double time = times[0] + static_cast<double>(row) / rate;
    while (below + 2 < times.size() && times[below + 1] <= time) {
      ++below;
    }
    const double step = times[below + 1] - times[below];
    const double part = step > 0.0 ? std::clamp((time - times[below]) / step, 0.0, 1.0) : 1.0;
    result.times[row] = time;
    result.values.row(row) =
        (1.0 - part) * recording.values.row(below) + part * recording.values.row(below + 1);
  }
  return result;
}

Recording low_passed(const Recording& recording, double cutoff) {
  const double rate = assess(recording).rate;
  if (!(cutoff < kHighestCutoff * rate)) {
    throw InputError({"recording", "", fmt::format("a rate of {:.4g} Hz", rate),
                      fmt::format("one above {:.4g} Hz for a low-pass at {:.4g} Hz",
                                  cutoff / kHighestCutoff, cutoff),
                      "Choose a lower frequency"});
  }
  Recording result = is_even(recording.times, 1.0 / rate) ? recording : resampled(recording, rate);
  const Butterworth filter(kBothRuns * cutoff / rate);
  for (Eigen::Index column = 0; column < result.values.cols(); ++column) {
    result.values.col(column) = filter.both_ways(result.values.col(column));
  }
  return result;
}

Recording without_duplicates(const Recording& recording) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index row = 0; row < recording.values.rows(); ++row) {
    if (rows.empty() || recording.values.row(row) != recording.values.row(rows.back())) {
      rows.push_back(row);
    }
  }
  return with_rows(recording, rows);
}

Recording trimmed(const Recording& recording, double from, double to) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index row = 0; row < recording.times.size(); ++row) {
    if (recording.times[row] >= from && recording.times[row] <= to) {
      rows.push_back(row);
    }
  }
  if (rows.empty()) {
    throw InputError(
        {"recording", "time", fmt::format("no row from {} to {} s", from, to), "at least one", ""});
  }
  return with_rows(recording, rows);
}

}  // namespace handway::device
