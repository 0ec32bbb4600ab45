#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace handway::device {

/// Random numbers that are the same for the same seed on all platforms, unlike the distributions of
/// the standard library.
class SeededRandom {
 public:
  explicit SeededRandom(std::uint64_t seed) : bits_(seed) {}

  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(bits_() >> 11U) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Returns a normal number of mean 0 and standard deviation 1.
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

  /// Uniform integer from 0 to `size` - 1.
  std::size_t index(std::size_t size) { return bits_() % size; }

  std::uint64_t bits() { return bits_(); }

 private:
  std::mt19937_64 bits_;
};

/// Pace of a hand that moves from target to target.
struct MovePace {
  double reaction = 0.3;       ///< Duration of the smallest move, s.
  double per_unit = 0.3;       ///< Added duration per unit of the farthest coordinate, s.
  double longest_rest = 0.25;  ///< Pause on a target: from 0 to this, s.
};

/// Goes from target to target in minimum-jerk moves (Flash and Hogan 1985): all coordinates leave
/// and arrive together, at rest. Targets are in [-1, 1] for each coordinate and evenly spread over
/// it: every stretch of 24 moves visits 24 equal parts of it once, in an order of its own. It
/// imitates a hand that explores all of its workspace.
class MinimumJerkMoves {
 public:
  MinimumJerkMoves(Eigen::Index coordinates, const MovePace& pace, std::uint64_t seed);

  /// @param time s, never falling. @returns shape [coordinates].
  [[nodiscard]] Eigen::VectorXd at(double time);

 private:
  void begin_next_move();
  [[nodiscard]] Eigen::VectorXd next_target();

  MovePace pace_;
  SeededRandom random_;
  std::vector<std::vector<std::size_t>> parts_;  ///< Per coordinate, still to be visited.
  Eigen::VectorXd from_;
  Eigen::VectorXd to_;
  double begin_ = 0.0;
  double duration_ = 0.0;
  double rest_ = 0.0;
};

}  // namespace handway::device
