#include "formats/yaml_text.h"

#include "handway/geometric/io/number_text.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>

namespace handway::geometric {
namespace {

bool is_word(unsigned char c) { return std::isalnum(c) || c == '_' || c == '/' || c >= 0x80; }

bool is_plain(std::string_view text) {
  if (text.empty() || text == "null" || text == "Null" || text == "NULL") {
    return false;
  }
  const bool negative = text.size() > 1 && text[0] == '-' && is_word(text[1]);
  if (text.back() == ' ' || !(is_word(text[0]) || text[0] == '.' || negative)) {
    return false;
  }
  for (const char c : text) {
    if (!is_word(c) && c != '.' && c != '-' && c != '+' && c != ' ') {
      return false;
    }
  }
  return true;
}

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (c == '\n') {
      result += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      result += fmt::format("\\x{:02x}", c);
    } else {
      result += c;
    }
  }
  return result + '"';
}

}  // namespace

// The conversion from a matrix loses a few of the last bits. Rounding beyond them keeps 90 at 90,
// and any angle unchanged, however often a scene is saved.
double rounded_degrees(double radians) {
  constexpr double kDigits = 1e12;
  return std::round(degrees(radians) * kDigits) / kDigits;
}

std::string yaml_scalar(std::string_view text) {
  return is_plain(text) ? std::string(text) : quoted(text);
}

std::string yaml_list(const Eigen::VectorXd& numbers) {
  std::string text = "[";
  for (const double number : numbers) {
    text += (text.size() > 1 ? ", " : "") + number_text(number);
  }
  return text + ']';
}

std::string yaml_pose(const Pose& X) {
  return "{xyz: " + yaml_list(X.translation()) +
         ", rpy_deg: " + yaml_list(rpy_from_rotation(X.linear()).unaryExpr(&rounded_degrees)) + '}';
}

}  // namespace handway::geometric
