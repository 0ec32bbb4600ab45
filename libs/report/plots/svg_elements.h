#pragma once

#include <cstddef>
#include <string>
#include <string_view>

/// Parts of drawings. Lengths are pixels, y points downwards.
namespace handway::report {

inline constexpr double kTextSize = 12.0;
inline constexpr double kLineHeight = 18.0;
inline constexpr std::string_view kInk = "#222";    ///< Texts.
inline constexpr std::string_view kGrid = "#ddd";   ///< Lines of scales.
inline constexpr std::string_view kFrame = "#888";  ///< Frames.

/// A drawing with its size.
struct Drawing {
  double width = 0.0;
  double height = 0.0;
  std::string elements;
};

/// A rectangle.
struct Area {
  double left = 0.0;
  double top = 0.0;
  double right = 0.0;
  double bottom = 0.0;

  [[nodiscard]] double width() const { return right - left; }
  [[nodiscard]] double height() const { return bottom - top; }
  [[nodiscard]] double center() const { return (left + right) / 2.0; }
  [[nodiscard]] double middle() const { return (top + bottom) / 2.0; }
};

/// Returns one of the colours of series, which colour-blind viewers distinguish (Okabe and Ito).
[[nodiscard]] std::string_view series_color(std::size_t index);

/// Returns the pattern of dashes with which series of the same colour differ: an attribute, empty
/// for the first ones.
[[nodiscard]] std::string series_dashes(std::size_t index);

/// Returns an estimate of a text's width; texts of usual letters are narrower.
[[nodiscard]] double text_width(std::string_view text);

/// Alignment of a text.
enum class Anchor { kStart, kMiddle, kEnd };

/// Style of a text in a drawing.
struct TextStyle {
  Anchor anchor = Anchor::kStart;
  bool is_bold = false;
  double size = kTextSize;
  std::string_view color = kInk;
  double most_width = 1e9;  ///< Longer texts are cut.
};

/// Returns a text whose base line is at y.
[[nodiscard]] std::string svg_text(double x, double y, const std::string& text,
                                   const TextStyle& style = {});

/// Returns a text that reads upwards, centred at a point.
[[nodiscard]] std::string svg_upright(double x, double y, const std::string& text,
                                      const TextStyle& style);

[[nodiscard]] std::string svg_line(double x1, double y1, double x2, double y2,
                                   std::string_view color, double width = 1.0);

/// Returns a rectangle. @param fill, stroke colours, or "none".
[[nodiscard]] std::string svg_rectangle(const Area& area, std::string_view fill,
                                        std::string_view stroke = "none");

}  // namespace handway::report
