#include "handway/planning/timing/time_law.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace handway::planning {
namespace {

using geometric::Configuration;

constexpr int kCellsOfStraight = 200;
constexpr int kLeastCellsOfArc = 16;
constexpr double kArcOfCell = std::numbers::pi / 360.0;  // rad

/// A stretch of the grid: derivatives of the joints at its ends.
struct Cell {
  std::size_t piece = 0;
  double begin = 0.0;  ///< In the piece.
  double width = 0.0;
  bool stop_after = false;
  Configuration first[2];
  Configuration second[2];
  Configuration third;  ///< At the piece's beginning, where that of an arc is largest.
};

std::vector<Cell> grid(const BlendedPath& path) {
  std::vector<Cell> cells;
  for (std::size_t p = 0; p < path.pieces().size(); ++p) {
    const PathPiece& piece = path.pieces()[p];
    const int count =
        piece.is_arc()
            ? std::max(kLeastCellsOfArc,
                       static_cast<int>(std::ceil(piece.length / piece.radius / kArcOfCell)))
            : kCellsOfStraight;
    const double width = piece.length / count;
    for (int i = 0; i < count; ++i) {
      const double begin = i * width;
      cells.push_back({p,
                       begin,
                       width,
                       piece.ends_in_corner && i + 1 == count,
                       {piece.first_derivative(begin), piece.first_derivative(begin + width)},
                       {piece.second_derivative(begin), piece.second_derivative(begin + width)},
                       piece.third_derivative(0.0)});
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

/// What ds²/dt² may be in `cell` at speed² x, so that at its end speed² is at most `most`.
Range accelerations(const Cell& cell, const RateLimits& limits, double x, double most) {
  Range range{-x / (2.0 * cell.width), (most - x) / (2.0 * cell.width)};
  for (Eigen::Index j = 0; j < limits.acceleration.size() && !range.empty(); ++j) {
    const double limit = limits.acceleration[j];
    range.keep(cell.first[0][j], cell.second[0][j] * x, limit);
    range.keep(cell.first[1][j] + 2.0 * cell.width * cell.second[1][j], cell.second[1][j] * x,
               limit);
  }
  return range;
}

/// Largest speed² where the derivatives are these, for velocity, and for the jerk of the path's own
/// shape if it is limited. @param third the largest of the piece.
double fastest(const Configuration& first, const Configuration& third, const RateLimits& limits) {
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

/// Largest speed² at the beginning of the cell from which its end is reached with at
/// most `most`. The speeds that are possible are an interval from 0.
double controllable(const Cell& cell, const RateLimits& limits, double most) {
  double high = fastest(cell.first[0], cell.third, limits);
  if (!accelerations(cell, limits, high, most).empty()) {
    return high;
  }
  double low = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (accelerations(cell, limits, middle, most).empty() ? high : low) = middle;
  }
  return low;
}

/// By how much a cell is too fast: time has to be stretched by this, at least 1.
double excess(const PathPiece& piece, const Cell& cell, const RateLimits& limits, double x0,
              double x1) {
  double worst = 1.0;
  const double u = (x1 - x0) / (2.0 * cell.width);
  const int steps = piece.is_arc() ? 4 : 0;
  for (int i = 0; i <= steps; ++i) {
    const double share = steps == 0 ? 0.0 : static_cast<double>(i) / steps;
    const double s = cell.begin + share * cell.width;
    const double x = x0 + share * (x1 - x0);
    const Configuration first = piece.first_derivative(s);
    const Configuration acceleration = u * first + x * piece.second_derivative(s);
    const double top = steps == 0 ? std::max(x0, x1) : x;
    worst = std::max(worst,
                     (std::sqrt(top) * first.cwiseAbs()).cwiseQuotient(limits.velocity).maxCoeff());
    worst = std::max(
        worst, std::sqrt(acceleration.cwiseAbs().cwiseQuotient(limits.acceleration).maxCoeff()));
  }
  return worst;
}

/// Slows the knots from `first` to the end down by `factor`.
void stretch(std::vector<TimeLaw::Knot>& knots, std::size_t first, double factor) {
  const double begin = knots[first].time;
  for (std::size_t k = first; k < knots.size(); ++k) {
    knots[k].time = begin + factor * (knots[k].time - begin);
    knots[k].speed /= factor;
    knots[k].acceleration /= factor * factor;
    knots[k].jerk /= factor * factor * factor;
  }
}

}  // namespace

TimeLaw time_optimal(const BlendedPath& path, const RateLimits& limits) {
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
  TimeLaw law;
  double x = 0.0;
  double time = 0.0;
  double slower = 1.0;
  std::size_t section = 0;  // its first knot
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const Cell& cell = cells[c];
    if (cell.begin == 0.0) {
      law.knots.push_back({time, 0.0, std::sqrt(x), cell.piece, 0.0, 0.0});
    }
    const Range range = accelerations(cell, limits, x, most[c + 1]);
    // Rounding may leave nothing of a range that is a single number.
    const double u = range.empty() ? 0.5 * (range.low + range.high) : range.high;
    const double next = std::clamp(x + 2.0 * cell.width * u, 0.0, most[c + 1]);
    slower = std::max(slower, excess(path.pieces()[cell.piece], cell, limits, x, next));
    law.knots.back().acceleration = (next - x) / (2.0 * cell.width);
    time += 2.0 * cell.width / (std::sqrt(x) + std::sqrt(next));
    x = next;
    law.knots.push_back({time, cell.begin + cell.width, std::sqrt(x), cell.piece, 0.0, 0.0});
    if (cell.stop_after) {
      stretch(law.knots, section, slower);
      time = law.knots.back().time;
      section = law.knots.size();
      slower = 1.0;
    }
  }
  return law;
}

TimeLaw align_stops(TimeLaw law, double period) {
  std::vector<TimeLaw::Knot> knots;
  std::size_t section = 0;
  double late = 0.0;  // what the stretches so far have added
  for (std::size_t k = 0; k < law.knots.size(); ++k) {
    knots.push_back(law.knots[k]);
    knots.back().time += late;
    if (k > section && law.knots[k].speed == 0.0) {
      const double took = knots.back().time - knots[section].time;
      const double rounded = period * std::max(1.0, std::ceil(took / period - 1e-9));
      stretch(knots, section, rounded / took);
      // Multiples of the period exactly, free of what rounding adds up.
      knots.back().time = period * std::round(knots.back().time / period);
      late = knots.back().time - law.knots[k].time;
      section = k + 1;
    }
  }
  law.knots = std::move(knots);
  return law;
}

}  // namespace handway::planning
