#include "handway/sampling/postures/recorded_motions.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace handway::sampling {
namespace {

constexpr double kMotionRate = 100.0;         // Hz
constexpr Eigen::Index kHalfWindow = 5;       // rows of the running mean on either side
constexpr double kDeepValley = 0.5;           // of the lower peak beside it
constexpr double kOnset = 0.1;                // of the highest speed of a motion
constexpr double kShortestMotion = 0.2;       // s
constexpr double kLongestMotion = 5.0;        // s
constexpr double kSmallestMotion = 0.1;       // normalised joints
constexpr double kSmallestOnlyMotion = 0.01;  // normalised joints
constexpr double kLongestGap = 0.25;          // s

void check_motion_rows(const Eigen::VectorXd& times, const Eigen::MatrixXd& values) {
  if (times.size() != values.rows()) {
    throw std::invalid_argument("rows over time need a time for every row");
  }
}

/// Rows at kMotionRate from a first time on, with the speed at each.
struct EvenMotion {
  double begin = 0.0;    ///< s
  double period = 0.0;   ///< s
  Eigen::MatrixXd rows;  ///< Smoothed.
  Eigen::VectorXd speed;

  [[nodiscard]] double time(Eigen::Index row) const {
    return begin + period * static_cast<double>(row);
  }
};

// The mean of the rows from kHalfWindow before to kHalfWindow after; near an end of fewer rows, as
// many on either side.
Eigen::MatrixXd running_mean(const Eigen::MatrixXd& rows) {
  Eigen::MatrixXd result(rows.rows(), rows.cols());
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    const Eigen::Index reach = std::min({kHalfWindow, row, rows.rows() - 1 - row});
    result.row(row) = rows.middleRows(row - reach, 2 * reach + 1).colwise().mean();
  }
  return result;
}

Eigen::VectorXd speeds_of(const Eigen::MatrixXd& rows, double period) {
  const Eigen::Index last = rows.rows() - 1;
  Eigen::VectorXd speeds(rows.rows());
  for (Eigen::Index row = 0; row <= last; ++row) {
    const Eigen::Index before = std::max<Eigen::Index>(row - 1, 0);
    const Eigen::Index after = std::min(row + 1, last);
    speeds[row] = (rows.row(after) - rows.row(before)).norm() /
                  (static_cast<double>(after - before) * period);
  }
  return speeds;
}

// @pre two rows or more, and time passes.
EvenMotion even_motion(const Eigen::VectorXd& times, const Eigen::MatrixXd& postures) {
  const double duration = times[times.size() - 1] - times[0];
  const auto steps = std::max<Eigen::Index>(1, std::llround(duration * kMotionRate));
  EvenMotion even{times[0], duration / static_cast<double>(steps), {}, {}};
  even.rows = running_mean(running_mean(time_normalised(times, postures, steps + 1)));
  even.speed = speeds_of(even.rows, even.period);
  return even;
}

/// A minimum of the speed, and the highest speed after the minimum before it.
struct SpeedValley {
  Eigen::Index row = 0;
  double speed = 0.0;
  double peak_before = 0.0;
};

/// The minima of the speed in order, and the highest speed after the last one.
struct SpeedValleys {
  std::vector<SpeedValley> valleys;
  double last_peak = 0.0;

  [[nodiscard]] double peak_after(std::size_t valley) const {
    return valley + 1 < valleys.size() ? valleys[valley + 1].peak_before : last_peak;
  }
  // The speed in a valley as a share of the lower peak beside it.
  [[nodiscard]] double depth(std::size_t valley) const {
    const double peak = std::min(valleys[valley].peak_before, peak_after(valley));
    return peak > 0.0 ? valleys[valley].speed / peak : 1.0;
  }
  void remove(std::size_t valley) {
    const double peak = std::max(valleys[valley].peak_before, peak_after(valley));
    (valley + 1 < valleys.size() ? valleys[valley + 1].peak_before : last_peak) = peak;
    valleys.erase(valleys.begin() + static_cast<std::ptrdiff_t>(valley));
  }
};

SpeedValleys all_valleys(const Eigen::VectorXd& speed) {
  SpeedValleys result;
  for (Eigen::Index row = 0; row < speed.size(); ++row) {
    result.last_peak = std::max(result.last_peak, speed[row]);
    const bool is_inside = row > 0 && row + 1 < speed.size();
    if (is_inside && speed[row] < speed[row - 1] && speed[row] <= speed[row + 1]) {
      result.valleys.push_back({row, speed[row], result.last_peak});
      result.last_peak = 0.0;
    }
  }
  return result;
}

// The minima that are deep enough; the shallowest one is removed first.
std::vector<SpeedValley> deep_valleys(const Eigen::VectorXd& speed) {
  SpeedValleys all = all_valleys(speed);
  while (!all.valleys.empty()) {
    std::size_t shallowest = 0;
    for (std::size_t valley = 1; valley < all.valleys.size(); ++valley) {
      shallowest = all.depth(valley) > all.depth(shallowest) ? valley : shallowest;
    }
    if (all.depth(shallowest) <= kDeepValley) {
      break;
    }
    all.remove(shallowest);
  }
  return all.valleys;
}

double reach_of(const Eigen::MatrixXd& rows) {
  return (rows.rowwise() - rows.row(0)).rowwise().norm().maxCoeff();
}

// The motion between two rows without the slow rows at its ends.
HandMotion motion_between(const EvenMotion& even, Eigen::Index first, Eigen::Index last) {
  const double onset = kOnset * even.speed.segment(first, last - first + 1).maxCoeff();
  while (first < last && even.speed[first] < onset) {
    ++first;
  }
  while (last > first && even.speed[last] < onset) {
    --last;
  }
  const Eigen::Index rows = last - first + 1;
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(rows, even.time(first), even.time(last));
  return {times[0], times[rows - 1],
          time_normalised(times, even.rows.middleRows(first, rows), kMotionPoints)};
}

bool is_motion(const HandMotion& motion) {
  return motion.duration() >= kShortestMotion && motion.duration() <= kLongestMotion &&
         reach_of(motion.joints) >= kSmallestMotion;
}

void cut_recording(const Eigen::VectorXd& times, const Eigen::MatrixXd& postures,
                   std::vector<HandMotion>& motions) {
  if (times.size() < 2 || times[times.size() - 1] - times[0] < kShortestMotion) {
    return;
  }
  const EvenMotion even = even_motion(times, postures);
  Eigen::Index first = 0;
  const auto add_until = [&](Eigen::Index last) {
    HandMotion motion = motion_between(even, first, last);
    if (is_motion(motion)) {
      motions.push_back(std::move(motion));
    }
    first = last;
  };
  for (const SpeedValley& valley : deep_valleys(even.speed)) {
    add_until(valley.row);
  }
  add_until(even.rows.rows() - 1);
}

}  // namespace

std::vector<HandMotion> cut_into_motions(const Eigen::VectorXd& times,
                                         const Eigen::MatrixXd& postures) {
  check_motion_rows(times, postures);
  std::vector<HandMotion> motions;
  Eigen::Index first = 0;
  const auto begins_anew = [&](Eigen::Index row) {
    const double step = times[row] - times[row - 1];
    return step < 0.0 || step > kLongestGap;
  };
  for (Eigen::Index row = 1; row <= times.size(); ++row) {
    if (row == times.size() || begins_anew(row)) {
      cut_recording(times.segment(first, row - first), postures.middleRows(first, row - first),
                    motions);
      first = row;
    }
  }
  return motions;
}

std::optional<HandMotion> whole_motion(const Eigen::VectorXd& times,
                                       const Eigen::MatrixXd& postures) {
  check_motion_rows(times, postures);
  if (times.size() < 2 || !(times[times.size() - 1] > times[0]) || postures.cols() == 0 ||
      reach_of(postures) < kSmallestOnlyMotion) {
    return std::nullopt;
  }
  const EvenMotion even = even_motion(times, postures);
  return motion_between(even, 0, even.rows.rows() - 1);
}

Eigen::MatrixXd time_normalised(const Eigen::VectorXd& times, const Eigen::MatrixXd& values,
                                Eigen::Index count) {
  check_motion_rows(times, values);
  if (times.size() == 0 || count < 2) {
    throw std::invalid_argument("resampling needs a row, and two points or more");
  }
  Eigen::MatrixXd result(count, values.cols());
  const Eigen::Index last = times.size() - 1;
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    const double time = times[0] + share * (times[last] - times[0]);
    while (row < last && times[row + 1] <= time) {
      ++row;
    }
    const Eigen::Index next = std::min(row + 1, last);
    const double step = times[next] - times[row];
    const double weight = step > 0.0 ? (time - times[row]) / step : 0.0;
    result.row(i) = values.row(row) + weight * (values.row(next) - values.row(row));
  }
  return result;
}

}  // namespace handway::sampling
