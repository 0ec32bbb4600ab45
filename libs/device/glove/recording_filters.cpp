#include "handway/device/glove/recording_filters.h"

#include "handway/device/glove/recording_quality.h"
#include "handway/geometric/io/input_error.h"

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace handway::device {
namespace {

/// A digital low-pass filter after Butterworth, of second order (bilinear transform with the
/// cutoff prewarped).
class Butterworth {
 public:
  /// @param cutoff frequency of the -3 dB point over the sampling rate, in (0, 0.5).
  explicit Butterworth(double cutoff);

  /// Filters forwards and backwards: no delay, twice the attenuation.
  [[nodiscard]] Eigen::VectorXd both_ways(const Eigen::VectorXd& signal) const;

 private:
  /// Filters in place, as if the first value had lasted for ever before.
  void run(Eigen::VectorXd& signal) const;

  double gain_ = 1.0;                  ///< b0 = b2; b1 = 2 b0.
  double first_ = 0.0, second_ = 0.0;  ///< a1, a2.
  Eigen::Index settling_ = 0;          ///< Number of samples that continue both ends.
};

Butterworth::Butterworth(double cutoff) {
  const double k = std::tan(std::numbers::pi * cutoff);
  const double scale = 1.0 / (1.0 + std::numbers::sqrt2 * k + k * k);
  gain_ = k * k * scale;
  first_ = 2.0 * (k * k - 1.0) * scale;
  second_ = (1.0 - std::numbers::sqrt2 * k + k * k) * scale;
  settling_ = static_cast<Eigen::Index>(std::ceil(2.0 / cutoff));
}

void Butterworth::run(Eigen::VectorXd& signal) const {
  if (signal.size() == 0) {
    return;
  }
  double in1 = signal[0];
  double in2 = in1;
  double out1 = in1;
  double out2 = in1;
  for (double& value : signal) {
    const double in = value;
    value = gain_ * (in + 2.0 * in1 + in2) - first_ * out1 - second_ * out2;
    in2 = in1;
    in1 = in;
    out2 = out1;
    out1 = value;
  }
}

Eigen::VectorXd Butterworth::both_ways(const Eigen::VectorXd& signal) const {
  const Eigen::Index count = signal.size();
  const Eigen::Index more = std::clamp<Eigen::Index>(count - 1, 0, settling_);
  Eigen::VectorXd longer(count + 2 * more);
  longer.segment(more, count) = signal;
  for (Eigen::Index i = 1; i <= more; ++i) {
    longer[more - i] = 2.0 * signal[0] - signal[i];
    longer[more + count - 1 + i] = 2.0 * signal[count - 1] - signal[count - 1 - i];
  }
  run(longer);
  longer.reverseInPlace();
  run(longer);
  longer.reverseInPlace();
  return longer.segment(more, count);
}

using geometric::InputError;

constexpr double kEven = 1e-3;                    // share of a step
constexpr double kMostRows = 5e6;                 // rows of a recording: 14 hours at 100 Hz
constexpr double kHighestCutoff = 0.4;            // share of the rate
constexpr double kBothRuns = 1.2464504802804612;  // (√2 - 1)^(-1/4)

Recording with_rows(const Recording& recording, const std::vector<Eigen::Index>& rows) {
  Recording result;
  result.header = recording.header;
  result.warnings = recording.warnings;
  result.times = recording.times(rows);
  result.values = recording.values(rows, Eigen::all);
  if (recording.raw) {
    result.raw = rows_of(*recording.raw, rows);
  }
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
  if (!(duration * rate < kMostRows)) {
    throw InputError({"recording", "time",
                      fmt::format("{:.4g} s, which are {:.4g} rows at {:.4g} Hz", duration,
                                  duration * rate, rate),
                      fmt::format("at most {:.0f} rows", kMostRows),
                      "Choose a lower rate, or look at the recording's times"});
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
