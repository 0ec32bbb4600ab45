#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <random>
#include <utility>
#include <vector>

/// Fits that leave out measurements which contradict the others (least median of squares, P. J.
/// Rousseeuw, "Least median of squares regression", Journal of the American Statistical Association
/// 79(388), 1984).

namespace handway::geometric {

/// Deviation of a measurement from a model.
struct Deviation {
  double position = 0.0;  ///< m.
  double angle = 0.0;     ///< rad.
};

/// Properties of a robust fit.
struct RobustFitSettings {
  double lever = 0.0;           ///< An angle of 1 rad counts as so many metres.
  double least_outlier = 1e-3;  ///< No deviation below it is an outlier, m.
  bool leaves_out_outliers = true;
};

/// A model, and the measurements on which it is based.
template <typename Model>
struct RobustFit {
  Model model;
  std::vector<Deviation> deviations;  ///< Of all measurements.
  std::vector<std::size_t> used;      ///< Ascending.
};

/// @pre `index` < values.size().
[[nodiscard]] inline double nth_smallest(std::vector<double> values, std::size_t index) {
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(index);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

/// @pre there is one.
[[nodiscard]] inline double median_of(const std::vector<double>& values) {
  return nth_smallest(values, values.size() / 2);
}

/// The triples of `count` measurements: all of them, or some that are drawn. Equal counts give
/// equal triples.
[[nodiscard]] inline std::vector<std::vector<std::size_t>> triples_of(std::size_t count) {
  constexpr std::size_t kMostTriples = 500;
  std::vector<std::vector<std::size_t>> triples;
  if (count * (count - 1) * (count - 2) / 6 <= kMostTriples) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = i + 1; j < count; ++j) {
        for (std::size_t k = j + 1; k < count; ++k) {
          triples.push_back({i, j, k});
        }
      }
    }
    return triples;
  }
  std::mt19937_64 random(1);
  while (triples.size() < kMostTriples) {
    const std::size_t i = random() % count;
    const std::size_t j = random() % count;
    const std::size_t k = random() % count;
    if (i != j && j != k && i != k) {
      triples.push_back({i, j, k});
    }
  }
  return triples;
}

/// Fits a model to measurements.
/// @param solve returns the model of some measurements (ascending), or nothing if they do not
/// determine it.
/// @param deviation returns the deviation of a measurement from a model.
/// @returns nothing if no model is determined.
template <typename Model, typename Solve, typename Deviate>
[[nodiscard]] std::optional<RobustFit<Model>> robust_fit(std::size_t count, const Solve& solve,
                                                         const Deviate& deviation,
                                                         const RobustFitSettings& settings) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  const auto cost = [&](const Model& model, std::size_t i) {
    const Deviation one = deviation(model, i);
    return one.position + settings.lever * one.angle;
  };
  const auto costs = [&](const Model& model) {
    std::vector<double> values;
    values.reserve(count);
    for (const std::size_t i : all) {
      values.push_back(cost(model, i));
    }
    return values;
  };
  std::vector<std::size_t> used = all;
  std::optional<Model> model = solve(all);
  // A triple is met almost exactly: one measurement beyond it has to agree, and half of all.
  constexpr std::size_t kLeastToCompare = 5;
  const auto coverage = [&](const Model& one) {
    return nth_smallest(costs(one), std::min(count - 1, count / 2 + 1));
  };
  if (settings.leaves_out_outliers && count >= kLeastToCompare) {
    double least = model ? coverage(*model) : std::numeric_limits<double>::infinity();
    std::optional<Model> best = model;
    for (const std::vector<std::size_t>& triple : triples_of(count)) {
      const std::optional<Model> one = solve(triple);
      if (const double covering = one ? coverage(*one) : least; one && covering < least) {
        least = covering;
        best = one;
      }
    }
    // Twice: the scale of the deviations is known better with the measurements that fit.
    for (int round = 0; best && round < 2; ++round) {
      constexpr double kSigmas = 3.0;
      constexpr double kMedianToSigma = 1.4826;
      const double small_sample = 1.0 + 5.0 / static_cast<double>(count);  // Rousseeuw
      const std::vector<double> values = costs(*best);
      const double limit = std::max(settings.least_outlier,
                                    kSigmas * kMedianToSigma * small_sample * median_of(values));
      std::vector<std::size_t> fitting;
      std::ranges::copy_if(all, std::back_inserter(fitting),
                           [&](std::size_t i) { return values[i] <= limit; });
      const std::optional<Model> refined = solve(fitting);
      if (!refined) {
        break;
      }
      best = refined;
      used = fitting;
      model = refined;
    }
  }
  if (!model) {
    return std::nullopt;
  }
  RobustFit<Model> fit{*model, {}, std::move(used)};
  for (const std::size_t i : all) {
    fit.deviations.push_back(deviation(*model, i));
  }
  return fit;
}

}  // namespace handway::geometric
