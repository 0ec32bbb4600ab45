#include "recordings/landmark_columns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <utility>

namespace handway::device {
namespace {

// Separates letters and digits, in small letters: "INDEX_FINGER_TIP_x", "x12".
std::vector<std::string> pieces_of(std::string_view name) {
  std::vector<std::string> pieces;
  int kind = 0;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const int now = std::isdigit(byte) != 0 ? 1 : std::isalpha(byte) != 0 ? 2 : 0;
    if (now != 0 && now == kind) {
      pieces.back() += static_cast<char>(std::tolower(byte));
    } else if (now != 0) {
      pieces.emplace_back(1, static_cast<char>(std::tolower(byte)));
    }
    kind = now;
  }
  return pieces;
}

const std::map<std::string, std::size_t>& landmark_names() {
  static const std::map<std::string, std::size_t> kNames = [] {
    std::map<std::string, std::size_t> names{{"wrist", 0}};
    const std::array<std::vector<std::string>, 5> fingers{
        {{"thumb"}, {"index"}, {"middle"}, {"ring"}, {"pinky", "pinkie", "little"}}};
    for (std::size_t finger = 0; finger < fingers.size(); ++finger) {
      const std::array<const char*, 4> joints = finger == 0
                                                    ? std::array{"cmc", "mcp", "ip", "tip"}
                                                    : std::array{"mcp", "pip", "dip", "tip"};
      for (std::size_t joint = 0; joint < joints.size(); ++joint) {
        for (const std::string& name : fingers.at(finger)) {
          names[name + joints.at(joint)] = 1 + 4 * finger + joint;
        }
      }
    }
    return names;
  }();
  return kNames;
}

struct Coordinate {
  std::size_t axis = 0;
  std::size_t point = 0;
  bool numbered = false;
  std::string of;  ///< Rest of the name, such as the hand's side.
};

std::optional<Coordinate> coordinate_of(const std::string& name) {
  std::vector<std::string> pieces = pieces_of(name);
  const auto is_axis = [](const std::string& piece) {
    return piece == "x" || piece == "y" || piece == "z";
  };
  const auto axis = std::find_if(pieces.rbegin(), pieces.rend(), is_axis);
  if (axis == pieces.rend()) {
    return std::nullopt;
  }
  Coordinate coordinate;
  coordinate.axis = static_cast<std::size_t>(axis->front() - 'x');
  pieces.erase(std::next(axis).base());
  const auto number = std::find_if(pieces.rbegin(), pieces.rend(), [](const std::string& piece) {
    return std::isdigit(static_cast<unsigned char>(piece.front())) != 0 && piece.size() < 4;
  });
  if (number != pieces.rend()) {
    coordinate.point = std::stoul(*number);
    coordinate.numbered = true;
    pieces.erase(std::next(number).base());
    coordinate.of = fmt::format("{}", fmt::join(pieces, "_"));
    return coordinate;
  }
  std::string joined;
  std::erase(pieces, "finger");
  for (const std::string& piece : pieces) {
    joined += piece;
  }
  for (const auto& [known, point] : landmark_names()) {
    if (joined.ends_with(known)) {
      coordinate.point = point;
      coordinate.of = joined.substr(0, joined.size() - known.size());
      return coordinate;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<LandmarkColumns> landmark_columns(const std::vector<std::string>& names) {
  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  struct Hand {
    LandmarkColumns columns;
    std::size_t found = 0;
  };
  std::vector<std::pair<std::size_t, Coordinate>> coordinates;
  bool from_one = true;
  for (std::size_t column = 0; column < names.size(); ++column) {
    if (const std::optional<Coordinate> coordinate = coordinate_of(names[column])) {
      from_one = from_one && coordinate->numbered && coordinate->point != 0;
      coordinates.emplace_back(column, *coordinate);
    }
  }
  std::map<std::string, Hand> hands;
  for (const auto& [column, coordinate] : coordinates) {
    Hand& hand = hands.try_emplace(coordinate.of, Hand{{}, 0}).first->second;
    if (hand.found == 0) {
      hand.columns.fill(kNone);
    }
    const std::size_t slot = 3 * (coordinate.point - (from_one ? 1 : 0)) + coordinate.axis;
    if (slot < hand.columns.size() && hand.columns.at(slot) == kNone) {
      hand.columns.at(slot) = column;
      ++hand.found;
    }
  }
  std::optional<LandmarkColumns> first;
  for (const auto& [of, hand] : hands) {
    if (hand.found == hand.columns.size() && (!first || hand.columns[0] < first->at(0))) {
      first = hand.columns;
    }
  }
  return first;
}

}  // namespace handway::device
