#include "plots/axis_scale.h"

#include "handway/report/document/table.h"
#include "plots/svg_elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace handway::report {
namespace {

constexpr double kLargestDrawn = 1e100;
constexpr int kMostDecades = 9;

// The step of 1, 2 or 5 times a power of ten that is nearest to `step`.
double round_step(double step) {
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  const double part = step / power;
  return power * (part < 1.5 ? 1.0 : part < 3.5 ? 2.0 : part < 7.5 ? 5.0 : 10.0);
}

std::string with_minus(std::string text) {
  if (text.starts_with('-')) {
    text.replace(0, 1, "−");
  }
  return text;
}

std::string linear_label(double value, double step) {
  constexpr double kMostDigits = 1e6;
  if (std::abs(value) >= kMostDigits || step < 1.0 / kMostDigits) {
    return with_minus(fmt::format("{:.6g}", std::abs(value) < 1e-6 * step ? 0.0 : value));
  }
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.find_first_not_of("-0.") == std::string::npos ? fmt::format("{:.{}f}", 0.0, decimals)
                                                            : with_minus(text);
}

std::string decade_label(int decade) {
  constexpr int kFewDigits = 4;
  return std::abs(decade) <= kFewDigits ? fmt::format("{:g}", std::pow(10.0, decade))
                                        : fmt::format("1e{}", decade);
}

}  // namespace

bool is_drawn(double value) { return std::isfinite(value) && std::abs(value) <= kLargestDrawn; }

std::string axis_title(const Axis& axis) { return Column(axis.title, axis.unit).heading(); }

AxisScale::AxisScale(const Axis& axis, const std::vector<double>& values, int ticks)
    : is_logarithmic_(axis.is_logarithmic) {
  if (is_logarithmic_) {
    make_logarithmic(axis, values);
    return;
  }
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (const double value : values) {
    if (is_drawn(value)) {
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  if (least > most) {
    least = 0.0;
    most = 1.0;
  }
  make_linear(axis, least, most, ticks);
}

void AxisScale::make_linear(const Axis& axis, double least, double most, int ticks) {
  if (is_drawn(axis.least)) {
    least = axis.least;
    most = std::max(most, least);
  }
  if (is_drawn(axis.most)) {
    most = axis.most;
    least = std::min(least, most);
  }
  const double size = std::max(std::abs(least), std::abs(most));
  if (most - least <= 1e-9 * size || most == least) {
    const double around = size > 0.0 ? 0.1 * size : 1.0;
    least -= around;
    most += around;
  }
  double step = round_step((most - least) / std::max(1, ticks));
  if (axis.is_whole) {
    step = std::max(step, 1.0);
  }
  constexpr double kSlack = 1e-6;  // steps
  double first = std::ceil(least / step - kSlack);
  double last = std::floor(most / step + kSlack);
  if (!is_drawn(axis.least)) {
    first = std::floor(least / step + kSlack);
    least = first * step;
  }
  if (!is_drawn(axis.most)) {
    last = std::ceil(most / step - kSlack);
    most = last * step;
  }
  least_ = least;
  most_ = most;
  for (double k = first; k <= last; k += 1.0) {
    ticks_.push_back({k * step, linear_label(k * step, step)});
  }
}

void AxisScale::make_logarithmic(const Axis& axis, const std::vector<double>& values) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (const double value : values) {
    if (is_drawn(value) && value > 0.0) {
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  least = axis.least > 0.0 ? axis.least : least;
  most = axis.most > 0.0 ? axis.most : most;
  int first = -3;
  int last = 1;
  if (most > 0.0 && least <= most) {
    constexpr double kSlack = 1e-9;  // decades
    first = static_cast<int>(std::floor(std::log10(least) + kSlack));
    last = std::max(first + 1, static_cast<int>(std::ceil(std::log10(most) - kSlack)));
    first = std::max(first, last - kMostDecades);
  }
  least_ = std::pow(10.0, first);
  most_ = std::pow(10.0, last);
  for (int decade = first; decade <= last; ++decade) {
    ticks_.push_back({std::pow(10.0, decade), decade_label(decade)});
  }
}

void AxisScale::place(double begin, double end) {
  begin_ = begin;
  end_ = end;
}

double AxisScale::share(double value) const {
  if (is_logarithmic_) {
    return value > least_ ? std::min(1.0, std::log(value / least_) / std::log(most_ / least_))
                          : 0.0;
  }
  return std::clamp((value - least_) / (most_ - least_), 0.0, 1.0);
}

double AxisScale::at(double value) const { return std::lerp(begin_, end_, share(value)); }

double AxisScale::label_width() const {
  double width = 0.0;
  for (const Tick& tick : ticks_) {
    width = std::max(width, text_width(tick.label));
  }
  return width;
}

}  // namespace handway::report
