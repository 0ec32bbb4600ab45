#include "plots/svg_elements.h"

#include "handway/report/document/escaping.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace handway::report {
namespace {

constexpr double kWidthPerSize = 0.6;  // of a letter; sans-serif fonts have 0.5 to 0.6 on average

constexpr std::array<std::string_view, 7> kSeriesColors = {
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};
constexpr std::array<std::string_view, 3> kDashes = {"", "6 3", "2 2"};

bool begins_letter(char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }

std::size_t letter_count(std::string_view text) {
  std::size_t count = 0;
  for (const char c : text) {
    count += begins_letter(c) ? 1 : 0;
  }
  return count;
}

std::string first_letters(const std::string& text, std::size_t count) {
  std::size_t end = 0;
  for (std::size_t letters = 0; end < text.size(); ++end) {
    if (begins_letter(text[end]) && letters++ == count) {
      break;
    }
  }
  return text.substr(0, end);
}

std::string attributes(const TextStyle& style) {
  constexpr std::array kAnchors = {"start", "middle", "end"};
  std::string result;
  if (style.anchor != Anchor::kStart) {
    result +=
        fmt::format(" text-anchor=\"{}\"", kAnchors.at(static_cast<std::size_t>(style.anchor)));
  }
  if (style.is_bold) {
    result += " font-weight=\"bold\"";
  }
  if (style.size != kTextSize) {
    result += fmt::format(" font-size=\"{}\"", style.size);
  }
  if (style.color != kInk) {
    result += fmt::format(" fill=\"{}\"", style.color);
  }
  return result;
}

// The escaped text, cut to its width; the whole text is its tip then.
std::string content(const std::string& text, const TextStyle& style) {
  const double letter = style.size * kWidthPerSize;
  const auto most = static_cast<std::size_t>(std::max(1.0, style.most_width / letter + 0.01));
  if (letter_count(text) <= most) {
    return html_escaped(text);
  }
  return fmt::format("<title>{}</title>{}…", html_escaped(text),
                     html_escaped(first_letters(text, most - 1)));
}

}  // namespace

std::string_view series_color(std::size_t index) {
  return kSeriesColors[index % kSeriesColors.size()];
}

std::string series_dashes(std::size_t index) {
  const std::string_view dashes = kDashes[index / kSeriesColors.size() % kDashes.size()];
  return dashes.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", dashes);
}

double text_width(std::string_view text) {
  return kWidthPerSize * kTextSize * static_cast<double>(letter_count(text));
}

std::string svg_text(double x, double y, const std::string& text, const TextStyle& style) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", x, y, attributes(style),
                     content(text, style));
}

std::string svg_upright(double x, double y, const std::string& text, const TextStyle& style) {
  return fmt::format("<text transform=\"translate({:.1f} {:.1f}) rotate(-90)\"{}>{}</text>\n", x, y,
                     attributes(style), content(text, style));
}

std::string svg_line(double x1, double y1, double x2, double y2, std::string_view color,
                     double width) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
      "stroke-width=\"{:g}\"/>\n",
      x1, y1, x2, y2, color, width);
}

std::string svg_rectangle(const Area& area, std::string_view fill, std::string_view stroke) {
  return fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" "
      "stroke=\"{}\"/>\n",
      area.left, area.top, area.width(), area.height(), fill, stroke);
}

}  // namespace handway::report
