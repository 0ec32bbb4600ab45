#include "handway/planning/timing/jerk_limited.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace handway::planning {
namespace {

using Knot = TimeLaw::Knot;

// Shares of the acceleration and jerk limits that the fastest law is made with before it is
// averaged, and windows, as shares of its duration.
constexpr std::array kAccelerations{1.0, 0.7, 0.5, 0.3};
constexpr std::array kJerks{1.0, 0.5, 0.2};
constexpr std::array kWindows{0.02, 0.04, 0.07, 0.11, 0.16, 0.23, 0.32, 0.44, 0.6, 0.8, 1.0};
// For what is between the samples, of a limit.
constexpr double kMargin = 1.002;
// Knots that are nearer in time are one, s.
constexpr double kSameTime = 1e-9;

/// A stretch from stop to stop of a law, in one measure of the way.
struct Section {
  std::vector<Knot> knots;     ///< Of the fastest law.
  std::vector<double> begins;  ///< Of its pieces, in the section's measure.
  std::size_t first = 0;       ///< Piece.

  [[nodiscard]] double duration() const { return knots.back().time - knots.front().time; }
};

std::vector<Section> sections_of(const BlendedPath& path, const TimeLaw& law) {
  std::vector<Section> sections;
  for (std::size_t k = 0; k < law.knots.size(); ++k) {
    const bool begins =
        k == 0 || (law.knots[k].s == 0.0 && path.pieces()[law.knots[k].piece - 1].ends_in_corner);
    if (begins) {
      sections.push_back({{}, {0.0}, law.knots[k].piece});
    }
    Section& section = sections.back();
    while (section.first + section.begins.size() <= law.knots[k].piece) {
      const std::size_t last = section.first + section.begins.size() - 1;
      section.begins.push_back(section.begins.back() + path.pieces()[last].length);
    }
    section.knots.push_back(law.knots[k]);
  }
  return sections;
}

/// Speed of the fastest law at a time since the section's beginning; 0 outside.
class Speeds {
 public:
  explicit Speeds(const Section& section) : section_(section) {}

  [[nodiscard]] double way(double t) const {
    if (t <= 0.0) {
      return 0.0;
    }
    if (t >= section_.duration()) {
      const Knot& end = section_.knots.back();
      return section_.begins[end.piece - section_.first] + end.s;
    }
    const Knot& knot = at(t);
    const double u = section_.knots.front().time + t - knot.time;
    return section_.begins[knot.piece - section_.first] + knot.s +
           (knot.speed + 0.5 * knot.acceleration * u) * u;
  }
  [[nodiscard]] double speed(double t) const {
    if (t <= 0.0 || t >= section_.duration()) {
      return 0.0;
    }
    const Knot& knot = at(t);
    return std::max(0.0,
                    knot.speed + knot.acceleration * (section_.knots.front().time + t - knot.time));
  }

 private:
  [[nodiscard]] const Knot& at(double t) const {
    const auto after =
        std::ranges::upper_bound(section_.knots, section_.knots.front().time + t, {}, &Knot::time);
    return *std::prev(after);
  }

  const Section& section_;
};

/// Where a knot of the averaged law is: time from the section's beginning, way in its measure.
std::vector<Knot> averaged(const Section& section, double window) {
  const Speeds speeds(section);
  std::vector<double> times;
  for (const Knot& knot : section.knots) {
    times.push_back(knot.time - section.knots.front().time);
    times.push_back(times.back() + window);
  }
  std::ranges::sort(times);
  times.erase(
      std::unique(times.begin(), times.end(), [](double a, double b) { return b - a < kSameTime; }),
      times.end());
  std::vector<Knot> knots;
  knots.reserve(times.size());
  for (const double t : times) {
    knots.push_back({t, 0.0, (speeds.way(t) - speeds.way(t - window)) / window, 0,
                     (speeds.speed(t) - speeds.speed(t - window)) / window, 0.0});
  }
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    const double step = knots[k + 1].time - knots[k].time;
    Knot& knot = knots[k];
    knot.jerk = (knots[k + 1].acceleration - knot.acceleration) / step;
    knots[k + 1].s =
        knot.s + (knot.speed + (knot.acceleration / 2.0 + knot.jerk / 6.0 * step) * step) * step;
  }
  return knots;
}

Knot later(const Knot& knot, double t) {
  return {knot.time + t,
          knot.s + (knot.speed + (knot.acceleration / 2.0 + knot.jerk / 6.0 * t) * t) * t,
          std::max(0.0, knot.speed + (knot.acceleration + knot.jerk / 2.0 * t) * t),
          knot.piece,
          knot.acceleration + knot.jerk * t,
          knot.jerk};
}

/// After how long from `knot` the way is `s`, at most `most`: it does not fall.
double time_to(const Knot& knot, double s, double most) {
  double low = 0.0;
  double high = most;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (later(knot, middle).s < s ? low : high) = middle;
  }
  return high;
}

/// The law in the pieces' own measures, with two knots where one ends and the next begins.
std::vector<Knot> in_pieces(const BlendedPath& path, const Section& section,
                            const std::vector<Knot>& knots) {
  std::vector<Knot> result;
  std::size_t piece = section.first;
  const std::size_t last = section.first + section.begins.size() - 1;
  const auto begin_of = [&](std::size_t p) { return section.begins[p - section.first]; };
  const auto add = [&](Knot knot) {
    knot.s = std::clamp(knot.s - begin_of(piece), 0.0, path.pieces()[piece].length);
    knot.piece = piece;
    result.push_back(knot);
  };
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    Knot knot = knots[k];
    const double end = knots[k + 1].time;
    add(knot);
    while (piece < last && knots[k + 1].s > begin_of(piece + 1)) {
      knot = later(knot, time_to(knot, begin_of(piece + 1), end - knot.time));
      add(knot);
      result.back().s = path.pieces()[piece].length;
      ++piece;
      add(knot);
      result.back().s = 0.0;
    }
  }
  piece = last;
  add({knots.back().time, std::numeric_limits<double>::infinity(), 0.0, last, 0.0, 0.0});
  result.front().speed = 0.0;
  return result;
}

/// By how much the law is too fast: time has to be stretched by this.
double excess(const BlendedPath& path, const std::vector<Knot>& knots, const RateLimits& limits) {
  double velocity = 0.0;
  double acceleration = 0.0;
  double jerk = 0.0;
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    if (knots[k].piece != knots[k + 1].piece) {
      continue;
    }
    const PathPiece& piece = path.pieces()[knots[k].piece];
    for (const double share : {0.0, 0.5, 1.0}) {
      const Knot at = later(knots[k], share * (knots[k + 1].time - knots[k].time));
      const double s = std::min(at.s, piece.length);
      const Eigen::VectorXd first = piece.first_derivative(s);
      const Eigen::VectorXd second = piece.second_derivative(s);
      const double v = at.speed;
      velocity =
          std::max(velocity, (v * first).cwiseAbs().cwiseQuotient(limits.velocity).maxCoeff());
      acceleration = std::max(acceleration, (at.acceleration * first + v * v * second)
                                                .cwiseAbs()
                                                .cwiseQuotient(limits.acceleration)
                                                .maxCoeff());
      jerk = std::max(jerk, (at.jerk * first + 3.0 * v * at.acceleration * second +
                             v * v * v * piece.third_derivative(s))
                                .cwiseAbs()
                                .cwiseQuotient(limits.jerk)
                                .maxCoeff());
    }
  }
  return kMargin * std::max({velocity, std::sqrt(acceleration), std::cbrt(jerk)});
}

struct Candidate {
  std::vector<Knot> knots;
  double duration = std::numeric_limits<double>::infinity();
};

void keep_faster(const BlendedPath& path, const Section& section, const RateLimits& limits,
                 Candidate& best) {
  for (const double share : kWindows) {
    std::vector<Knot> knots =
        in_pieces(path, section, averaged(section, share * section.duration()));
    const double factor = excess(path, knots, limits);
    const double duration = factor * knots.back().time;
    if (duration < best.duration) {
      for (Knot& knot : knots) {
        knot.time *= factor;
        knot.speed /= factor;
        knot.acceleration /= factor * factor;
        knot.jerk /= factor * factor * factor;
      }
      best = {std::move(knots), duration};
    }
  }
}

}  // namespace

TimeLaw jerk_limited(const BlendedPath& path, const RateLimits& limits) {
  if (std::ranges::any_of(path.pieces(), [](const PathPiece& piece) {
        return piece.is_arc() && !piece.is_smooth_arc();
      })) {
    throw std::invalid_argument("jerk can't be limited on circular arcs");
  }
  std::vector<Candidate> best;
  for (const double acceleration : kAccelerations) {
    for (const double jerk : kJerks) {
      const TimeLaw law = time_optimal(
          path, {limits.velocity, acceleration * limits.acceleration, jerk * limits.jerk});
      const std::vector<Section> sections = sections_of(path, law);
      best.resize(sections.size());
      for (std::size_t i = 0; i < sections.size(); ++i) {
        keep_faster(path, sections[i], limits, best[i]);
      }
    }
  }
  TimeLaw law;
  double begin = 0.0;
  for (const Candidate& section : best) {
    for (Knot knot : section.knots) {
      knot.time += begin;
      law.knots.push_back(knot);
    }
    begin += section.duration;
  }
  return law;
}

}  // namespace handway::planning
