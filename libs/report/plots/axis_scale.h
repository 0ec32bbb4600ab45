#pragma once

#include "handway/report/document/figure.h"

#include <string>
#include <vector>

namespace handway::report {

/// Returns whether a number has a place in a plot: NaN, infinity and numbers beyond 1e100 have
/// none.
[[nodiscard]] bool is_drawn(double value);

/// Returns the title of an axis with its unit: "time [s]".
[[nodiscard]] std::string axis_title(const Axis& axis);

/// Scale of an axis: its ends and ticks, and the place of each value between two pixels. A
/// logarithmic scale has whole decades, at most nine.
class AxisScale {
 public:
  /// Tick of a scale.
  struct Tick {
    double value = 0.0;
    std::string label;
  };

  /// @param values on the axis; those without a place are ignored.
  /// @param ticks of a linear scale, about.
  AxisScale(const Axis& axis, const std::vector<double>& values, int ticks);

  /// Sets the pixels of the lower and the upper end.
  void place(double begin, double end);

  /// Returns the pixel of a value; values beyond an end are at that end.
  [[nodiscard]] double at(double value) const;
  /// Returns the part of the scale below a value, from 0 to 1.
  [[nodiscard]] double share(double value) const;
  [[nodiscard]] const std::vector<Tick>& ticks() const { return ticks_; }
  /// Returns the width of the widest label.
  [[nodiscard]] double label_width() const;

 private:
  void make_linear(const Axis& axis, double least, double most, int ticks);
  void make_logarithmic(const Axis& axis, const std::vector<double>& values);

  bool is_logarithmic_;
  double least_ = 0.0;
  double most_ = 1.0;
  double begin_ = 0.0;
  double end_ = 1.0;
  std::vector<Tick> ticks_;
};

}  // namespace handway::report
