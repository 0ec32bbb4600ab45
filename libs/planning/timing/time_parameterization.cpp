#include "handway/planning/timing/time_parameterization.h"

#include "handway/geometric/collision/volumes/preparation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

namespace handway::planning {
namespace {

using geometric::Configuration;
using Knot = TimeParameterization::Knot;

constexpr int kCellsOfStraight = 200;  // at most
constexpr int kLeastCellsOfStraight = 4;
constexpr int kLeastCellsOfArc = 8;
constexpr double kCellsOfPath = 2000.0;  // cells of all straight parts, by their lengths
constexpr double kArcOfCell = std::numbers::pi / 360.0;  // rad

/// A stretch of the grid: derivatives of the joints at its ends.
struct Cell {
  const PathPiece* piece = nullptr;
  double begin = 0.0;  ///< In the piece.
  double width = 0.0;
  bool stop_after = false;
  Configuration first[2];
  Configuration second[2];
  Configuration third;  ///< At the piece's beginning, where that of an arc is largest.
};

int cell_count(const PathPiece& piece, double path_length) {
  const double wanted = piece.is_arc() ? std::ceil(piece.length / piece.radius / kArcOfCell)
                                       : std::ceil(kCellsOfPath * piece.length / path_length);
  const int count =
      std::max(piece.is_arc() ? kLeastCellsOfArc : kLeastCellsOfStraight, static_cast<int>(wanted));
  return piece.is_arc() ? count : std::min(kCellsOfStraight, count);
}

std::vector<Cell> grid(const BlendedPath& path) {
  std::vector<Cell> cells;
  for (const PathPiece& piece : path.pieces()) {
    const int count = cell_count(piece, path.length());
    const double width = piece.length / count;
    for (int i = 0; i < count; ++i) {
      const double begin = i * width;
      cells.push_back({&piece,
                       begin,
                       width,
                       piece.ends_in_corner && i + 1 == count,
                       {piece.derivative(1, begin), piece.derivative(1, begin + width)},
                       {piece.derivative(2, begin), piece.derivative(2, begin + width)},
                       piece.derivative(3, 0.0)});
    }
  }
  return cells;
}

/// An interval of accelerations along the path.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool empty() const { return low > high; }

  /// Keeps |slope u + offset| ≤ limit.
  void keep(double slope, double offset, double limit) {
    if (std::abs(slope) < 1e-12) {
      if (std::abs(offset) > limit) {
        high = -std::numeric_limits<double>::infinity();
      }
      return;
    }
    const double a = (-limit - offset) / slope;
    const double b = (limit - offset) / slope;
    low = std::max(low, std::min(a, b));
    high = std::min(high, std::max(a, b));
  }
};

/// The largest number found for which `is_low` holds and the smallest for which it does not,
/// between `low`, for which it holds, and `high`.
template <typename Predicate>
std::pair<double, double> bisect(double low, double high, const Predicate& is_low) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (is_low(middle) ? low : high) = middle;
  }
  return {low, high};
}

/// The largest share of its limit that a joint uses.
template <typename Values>
double largest_share(const Eigen::MatrixBase<Values>& values, const Eigen::VectorXd& limits) {
  return values.cwiseQuotient(limits).template lpNorm<Eigen::Infinity>();
}

/// Range of ds²/dt² in `cell` at speed² x, so that speed² at its end is at most `most`.
Range accelerations(const Cell& cell, const JointKinematicLimits& limits, double x, double most) {
  Range range{-x / (2.0 * cell.width), (most - x) / (2.0 * cell.width)};
  for (Eigen::Index j = 0; j < limits.acceleration.size() && !range.empty(); ++j) {
    const double limit = limits.acceleration[j];
    range.keep(cell.first[0][j], cell.second[0][j] * x, limit);
    range.keep(cell.first[1][j] + 2.0 * cell.width * cell.second[1][j], cell.second[1][j] * x,
               limit);
  }
  return range;
}

/// Largest speed² for these derivatives: for velocity, and for the jerk of the path's own shape if
/// it is limited. @param third the largest of the piece.
double fastest(const Configuration& first, const Configuration& third,
               const JointKinematicLimits& limits) {
  double speed = std::numeric_limits<double>::max();
  for (Eigen::Index j = 0; j < limits.jerk.size(); ++j) {
    if (third[j] != 0.0) {
      speed = std::min(speed, std::cbrt(limits.jerk[j] / std::abs(third[j])));
    }
  }
  for (Eigen::Index j = 0; j < first.size(); ++j) {
    if (first[j] != 0.0) {
      speed = std::min(speed, limits.velocity[j] / std::abs(first[j]));
    }
  }
  return speed * speed;
}

/// Largest speed² at the beginning of the cell from which its end is reached with at most `most`.
/// The possible speeds are an interval from 0.
double controllable(const Cell& cell, const JointKinematicLimits& limits, double most) {
  const auto reaches_end = [&](double x) { return !accelerations(cell, limits, x, most).empty(); };
  const double high = fastest(cell.first[0], cell.third, limits);
  return reaches_end(high) ? high : bisect(0.0, high, reaches_end).first;
}

/// Largest shares of the limits of velocity, acceleration and jerk.
struct Shares {
  double velocity = 0.0;
  double acceleration = 0.0;
  double jerk = 0.0;

  void include(double v, double a, double j) {
    velocity = std::max(velocity, v);
    acceleration = std::max(acceleration, a);
    jerk = std::max(jerk, j);
  }
  /// Factor by which a motion is too fast: time has to be stretched by it.
  [[nodiscard]] double excess() const {
    return std::max({velocity, std::sqrt(acceleration), std::cbrt(jerk)});
  }
};

/// Evaluates how near motions along one piece come to the limits.
class PieceShares {
 public:
  PieceShares(const PathPiece& piece, const JointKinematicLimits& limits)
      : piece_(piece), limits_(limits) {
    if (!piece.is_arc()) {
      straight_ = {largest_share(piece.tangent, limits.velocity),
                   largest_share(piece.tangent, limits.acceleration),
                   limits.jerk.size() > 0 ? largest_share(piece.tangent, limits.jerk) : 0.0};
    }
  }

  void include(const Knot& at, Shares& shares) {
    const double v = at.speed;
    if (!piece_.is_arc()) {
      shares.include(v * straight_.velocity, std::abs(at.acceleration) * straight_.acceleration,
                     std::abs(at.jerk) * straight_.jerk);
      return;
    }
    const double s = std::clamp(at.s - piece_.begin, 0.0, piece_.length);
    first_ = piece_.derivative(1, s);
    second_ = piece_.derivative(2, s);
    double jerk = 0.0;
    if (limits_.jerk.size() > 0) {
      jerk = largest_share(at.jerk * first_ + 3.0 * v * at.acceleration * second_ +
                               v * v * v * piece_.derivative(3, s),
                           limits_.jerk);
    }
    shares.include(largest_share(v * first_, limits_.velocity),
                   largest_share(at.acceleration * first_ + v * v * second_, limits_.acceleration),
                   jerk);
  }

 private:
  const PathPiece& piece_;
  const JointKinematicLimits& limits_;
  Shares straight_;  ///< Per unit of speed, acceleration and jerk along a straight piece.
  Configuration first_;
  Configuration second_;
};

/// Factor by which a law is too fast, without jerk if it is not limited: time has to be stretched
/// by it.
double excess(const BlendedPath& path, std::span<const Knot> knots,
              const JointKinematicLimits& limits) {
  Shares shares;
  const PathPiece* piece = nullptr;
  std::optional<PieceShares> of_piece;
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    const PathPiece& at = path.piece_at(0.5 * (knots[k].s + knots[k + 1].s));
    if (&at != piece) {
      piece = &at;
      of_piece.emplace(at, limits);
    }
    for (const double share : {0.0, 0.5, 1.0}) {
      of_piece->include(knots[k].after(share * (knots[k + 1].time - knots[k].time)), shares);
    }
  }
  return shares.excess();
}

/// Slows a law down by `factor`.
void stretch(std::span<Knot> knots, double factor) {
  const double begin = knots.front().time;
  for (Knot& knot : knots) {
    knot.time = begin + factor * (knot.time - begin);
    knot.speed /= factor;
    knot.acceleration /= factor * factor;
    knot.jerk /= factor * factor * factor;
  }
}

/// The law from stop to stop, each section from time 0 on.
std::vector<TimeParameterization> sections_of(const TimeParameterization& law) {
  std::vector<TimeParameterization> sections;
  double begin = 0.0;
  for (Knot knot : law.knots) {
    if (sections.empty() ||
        (sections.back().knots.size() > 1 && sections.back().knots.back().speed == 0.0)) {
      sections.emplace_back();
      begin = knot.time;
    }
    knot.time -= begin;
    sections.back().knots.push_back(knot);
  }
  return sections;
}

/// Appends a section at the end of the law.
void append(const TimeParameterization& section, TimeParameterization& law) {
  const double begin = law.duration();
  for (Knot knot : section.knots) {
    knot.time += begin;
    law.knots.push_back(knot);
  }
}

}  // namespace

TimeParameterization::Knot TimeParameterization::Knot::after(double t) const {
  return {time + t, s + (speed + (acceleration / 2.0 + jerk / 6.0 * t) * t) * t,
          std::max(0.0, speed + (acceleration + jerk / 2.0 * t) * t), acceleration + jerk * t,
          jerk};
}

TimeParameterization time_optimal(const BlendedPath& path, const JointKinematicLimits& limits) {
  const std::vector<Cell> cells = grid(path);
  std::vector<double> most(cells.size() + 1, 0.0);
  for (std::size_t c = cells.size(); c-- > 0;) {
    const double end =
        cells[c].stop_after
            ? 0.0
            : std::min(most[c + 1], fastest(cells[c].first[1], cells[c].third, limits));
    most[c + 1] = end;
    most[c] = controllable(cells[c], limits, end);
  }
  TimeParameterization law;
  double x = 0.0;
  double time = 0.0;
  std::size_t section = 0;  // its first knot
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const Cell& cell = cells[c];
    if (law.knots.size() == section) {
      law.knots.push_back({.time = time, .s = cell.piece->begin});
    }
    const Range range = accelerations(cell, limits, x, most[c + 1]);
    // Rounding may empty a range that is a single number.
    const double u = range.empty() ? 0.5 * (range.low + range.high) : range.high;
    const double next = std::clamp(x + 2.0 * cell.width * u, 0.0, most[c + 1]);
    law.knots.back().acceleration = (next - x) / (2.0 * cell.width);
    time += 2.0 * cell.width / (std::sqrt(x) + std::sqrt(next));
    x = next;
    const bool ends_piece = c + 1 == cells.size() || cells[c + 1].piece != cell.piece;
    law.knots.push_back(
        {.time = time,
         .s = ends_piece ? cell.piece->end() : cell.piece->begin + cell.begin + cell.width,
         .speed = std::sqrt(x)});
    if (cell.stop_after) {
      const auto knots = std::span(law.knots).subspan(section);
      stretch(knots, std::max(1.0, excess(path, knots, limits.without_jerk())));
      time = law.knots.back().time;
      section = law.knots.size();
    }
  }
  return law;
}

TimeParameterization align_stops(const TimeParameterization& law, double period) {
  TimeParameterization aligned;
  for (TimeParameterization& section : sections_of(law)) {
    const double rounded = period * std::max(1.0, std::ceil(section.duration() / period - 1e-9));
    stretch(section.knots, rounded / section.duration());
    append(section, aligned);
    // Exact multiples of the period, without accumulated rounding.
    aligned.knots.back().time = period * std::round(aligned.duration() / period);
  }
  return aligned;
}

namespace {

// Shares of the acceleration and jerk limits for the fastest law before averaging, and windows, as
// shares of its duration.
constexpr std::array kAccelerations{1.0, 0.7, 0.5, 0.3};
constexpr std::array kJerks{1.0, 0.5, 0.2};
constexpr std::array kWindows{0.02, 0.04, 0.07, 0.11, 0.16, 0.23, 0.32, 0.44, 0.6, 0.8, 1.0};
// Margin of a limit for motion between the samples.
constexpr double kMargin = 1.002;
// Knots of a section, above which not every window is tried.
constexpr std::size_t kLongSection = 6000;
// Knots that are nearer in time are merged, s.
constexpr double kSameTime = 1e-9;

/// The motion at a time of a section; before and after it is at rest.
Knot motion_at(const TimeParameterization& section, double t) {
  if (t <= 0.0 || t >= section.duration()) {
    return {.time = t, .s = t <= 0.0 ? section.knots.front().s : section.knots.back().s};
  }
  const Knot& before = *std::prev(std::ranges::upper_bound(section.knots, t, {}, &Knot::time));
  return before.after(t - before.time);
}

/// The section averaged over a window of time.
std::vector<Knot> averaged(const TimeParameterization& section, double window) {
  std::vector<double> times;
  for (const Knot& knot : section.knots) {
    times.push_back(knot.time);
    times.push_back(knot.time + window);
  }
  std::ranges::sort(times);
  times.erase(
      std::unique(times.begin(), times.end(), [](double a, double b) { return b - a < kSameTime; }),
      times.end());
  std::vector<Knot> knots;
  knots.reserve(times.size());
  for (const double t : times) {
    const Knot end = motion_at(section, t);
    const Knot begin = motion_at(section, t - window);
    knots.push_back({.time = t,
                     .s = section.knots.front().s,
                     .speed = (end.s - begin.s) / window,
                     .acceleration = (end.speed - begin.speed) / window});
  }
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    const double step = knots[k + 1].time - knots[k].time;
    Knot& knot = knots[k];
    knot.jerk = (knots[k + 1].acceleration - knot.acceleration) / step;
    knots[k + 1].s = std::min(knot.after(step).s, section.knots.back().s);
  }
  knots.front().speed = 0.0;
  knots.back() = {.time = knots.back().time, .s = section.knots.back().s};
  return knots;
}

/// The law with a knot at the end of every piece of the path.
std::vector<Knot> with_joins(const BlendedPath& path, const std::vector<Knot>& knots) {
  std::vector<Knot> result;
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    Knot knot = knots[k];
    result.push_back(knot);
    auto piece = std::ranges::upper_bound(path.pieces(), knot.s, {}, &PathPiece::begin);
    for (; piece != path.pieces().end() && piece->begin < knots[k + 1].s; ++piece) {
      const auto is_before = [&](double t) { return knot.after(t).s < piece->begin; };
      knot = knot.after(bisect(0.0, knots[k + 1].time - knot.time, is_before).second);
      knot.s = piece->begin;
      result.push_back(knot);
    }
  }
  result.push_back(knots.back());
  return result;
}

// Best law so far; in a long section only the windows around it are tried.
struct BestLaw {
  TimeParameterization law;
  std::size_t window = 0;  ///< Index of its window.
};

void keep_faster(const BlendedPath& path, const TimeParameterization& section,
                 const JointKinematicLimits& limits, const std::stop_token& stop, BestLaw& best) {
  const bool is_long = section.knots.size() > kLongSection;
  const std::size_t last_best = best.window;
  for (std::size_t w = 0; w < kWindows.size(); ++w) {
    const bool is_near = w + 1 >= last_best && w <= last_best + 1;
    if (is_long && !best.law.knots.empty() && !is_near) {
      continue;
    }
    geometric::end_if_stopped(stop);
    const double share = kWindows.at(w);
    TimeParameterization law{with_joins(path, averaged(section, share * section.duration()))};
    stretch(law.knots, kMargin * excess(path, law.knots, limits));
    if (best.law.knots.empty() || law.duration() < best.law.duration()) {
      best = {std::move(law), w};
    } else if (is_long && w > best.window + 1) {
      break;  // larger windows only make a long section slower
    }
  }
}

}  // namespace

TimeParameterization jerk_limited(const BlendedPath& path, const JointKinematicLimits& limits,
                                  const std::stop_token& stop) {
  if (std::ranges::any_of(path.pieces(), [](const PathPiece& piece) {
        return piece.is_arc() && !piece.is_smooth_arc();
      })) {
    throw std::invalid_argument("jerk can't be limited on circular arcs");
  }
  std::vector<BestLaw> best;  // of each section
  for (const double acceleration : kAccelerations) {
    for (const double jerk : kJerks) {
      const TimeParameterization law = time_optimal(
          path, {limits.velocity, acceleration * limits.acceleration, jerk * limits.jerk});
      const std::vector<TimeParameterization> sections = sections_of(law);
      best.resize(sections.size());
      for (std::size_t i = 0; i < sections.size(); ++i) {
        keep_faster(path, sections[i], limits, stop, best[i]);
      }
    }
  }
  TimeParameterization law;
  for (const BestLaw& section : best) {
    append(section.law, law);
  }
  return law;
}

}  // namespace handway::planning
