#include "recordings/landmark_dump.h"

#include "glove/finger_bending.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/table_times.h"
#include "handway/geometric/math/units.h"
#include "recordings/recording_formats.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <utility>

namespace handway::device {
namespace {

using geometric::InputError;
using Json = nlohmann::ordered_json;

constexpr std::size_t kPoints = 21;
constexpr double kRateOfCameras = 30.0;  // Hz
constexpr double kUsualPicture = 4.0 / 3.0;
constexpr double kShortestPalm = 0.05;  // m, from the wrist to the knuckle of the middle finger
constexpr double kLongestPalm = 0.14;

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

namespace {

bool is_hand(const HandLandmarks& points) {
  if (!points.allFinite()) {
    return false;
  }
  try {
    static_cast<void>(palm_frame(points));
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

double palm_length(const HandLandmarks& points) {
  return (points.col(base_landmark(Finger::kMiddle)) - points.col(kWristLandmark)).norm();
}

// World landmarks are around the middle of the hand or relative to its wrist, or have distances
// from a camera. In a picture only points estimated beyond its edge are negative, and depth is
// relative to the wrist.
bool is_in_picture(const HandLandmarks& points) {
  constexpr double kNone = 0.05;  // of the length of the palm
  const auto across = points.topRows<2>();
  const auto wrist = points.col(kWristLandmark);
  const double palm = palm_length(points);
  return across.minCoeff() > -0.25 * (across.maxCoeff() - across.minCoeff()) &&
         std::abs(wrist.z()) < palm && wrist.head<2>().norm() > kNone * palm;
}

// Converts coordinates of a picture or of another unit to metres.
// @returns the unit inferred; empty for metres.
std::string settle_units(std::vector<SeenHand>& hands) {
  const auto in_picture =
      std::ranges::count_if(hands, [](const SeenHand& hand) { return is_in_picture(hand.points); });
  double most = 0.0;
  for (const SeenHand& hand : hands) {
    most = std::max(most, hand.points.lpNorm<Eigen::Infinity>());
  }
  const bool picture = 2 * in_picture > std::ssize(hands);
  const bool shares = picture && most < 3.0;
  std::vector<double> palms;
  for (SeenHand& hand : hands) {
    if (shares) {  // z has the scale of x
      hand.points.row(0) *= kUsualPicture;
      hand.points.row(2) *= kUsualPicture;
    }
    palms.push_back(palm_length(hand.points));
  }
  const double palm = median(palms);
  if (!picture && palm >= kShortestPalm && palm <= kLongestPalm) {
    return "";
  }
  if (const double metres = geometric::metres(palm);
      !picture && metres >= kShortestPalm && metres <= kLongestPalm) {
    for (SeenHand& hand : hands) {
      hand.points *= geometric::kMillimetre;
    }
    return "mm";
  }
  const HandLandmarks typical = hand_landmarks(GloveAngles{});
  const double usual = typical.col(base_landmark(Finger::kMiddle)).norm();
  for (SeenHand& hand : hands) {
    hand.points *= usual / palm;
  }
  return fmt::format("{}, scaled to a hand of usual size", shares ? "shares of a picture of 4:3"
                                                           : picture
                                                               ? "pixels"
                                                               : "coordinates that are no metres");
}

// Fingers bend towards the palm: for the wrong hand they would bend backwards.
bool is_left(const std::vector<SeenHand>& hands) {
  double as_right = 0.0;
  double as_left = 0.0;
  for (const SeenHand& hand : hands) {
    as_right += bending(hand.points, false);
    as_left += bending(hand.points, true);
  }
  return as_left > as_right;
}

}  // namespace

RecordingHeader landmark_header(const std::filesystem::path& file) {
  RecordingHeader header;
  header.kind = RecordingKind::kAngles;
  header.device = "landmarks of a hand";
  header.origin = file.filename().string();
  header.sensors = landmark_sensors();
  return header;
}

std::vector<double> landmark_row(const RecordingHeader& header, const HandLandmarks& points,
                                 bool left) {
  const GloveAngles angles = glove_angles(in_palm_frame(points, left));
  std::vector<double> row;
  for (const int sensor : header.sensors) {
    row.push_back(angles.angles.at(static_cast<std::size_t>(sensor)));
  }
  return row;
}

Recording recording_of_hands(const std::filesystem::path& file, const std::vector<SeenHand>& all) {
  std::vector<SeenHand> hands;
  std::ranges::copy_if(all, std::back_inserter(hands), is_hand, &SeenHand::points);
  if (hands.empty()) {
    throw InputError({file.string(), "", "no hand", "21 landmarks of one with x, y and z", ""});
  }
  Recording recording;
  if (hands.size() < all.size()) {
    recording.warnings.push_back(fmt::format("{}: {} of {} frames left out, they have no hand",
                                             file.string(), all.size() - hands.size(), all.size()));
  }
  const std::string unit = settle_units(hands);
  const bool left = is_left(hands);
  const bool timed = std::ranges::all_of(hands, [](const SeenHand& hand) { return !!hand.time; });
  std::vector<double> times;
  for (std::size_t i = 0; i < hands.size(); ++i) {
    times.push_back(timed ? *hands[i].time - *hands[0].time
                          : static_cast<double>(i) / kRateOfCameras);
  }
  if (timed) {
    for (const std::string& warning : geometric::settle_times(times)) {
      recording.warnings.push_back(fmt::format("{}: {}", file.string(), warning));
    }
  }
  recording.header = landmark_header(file);
  recording.times.resize(std::ssize(hands));
  recording.values.resize(std::ssize(hands), std::ssize(recording.header.sensors));
  std::vector<HandBones> bones;
  for (Eigen::Index row = 0; row < recording.times.size(); ++row) {
    const SeenHand& hand = hands[static_cast<std::size_t>(row)];
    recording.times[row] = times[static_cast<std::size_t>(row)];
    const std::vector<double> values = landmark_row(recording.header, hand.points, left);
    recording.values.row(row) =
        Eigen::Map<const Eigen::RowVectorXd>(values.data(), recording.values.cols());
    bones.push_back(bones_of(hand.points));
  }
  recording.bones = median_bones(bones);
  recording.warnings.push_back(
      fmt::format("{}: taken for landmarks of a {} hand, as its fingers bend{}{}{}", file.string(),
                  left ? "left" : "right", unit.empty() ? "" : ", in ", unit,
                  timed ? "" : fmt::format(", {:g} frames a second", kRateOfCameras)));
  return recording;
}

namespace {

std::optional<Eigen::Vector3d> point_of(const Json& value) {
  constexpr std::array kAxes{"x", "y", "z"};
  Eigen::Vector3d point;
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    const Json* number = nullptr;
    if (value.is_object()) {
      const auto found = value.find(kAxes.at(axis));
      number = found == value.end() ? nullptr : &*found;
    } else if (value.is_array() && (value.size() == 3 || value.size() == 4)) {
      number = &value[axis];
    }
    if (number == nullptr || !number->is_number()) {
      return std::nullopt;
    }
    point[static_cast<Eigen::Index>(axis)] = number->get<double>();
  }
  return point;
}

/// Finds hands in a JSON document.
class HandFinder {
 public:
  void look_at(const Json& value, std::optional<double> time, int depth = 0) {
    constexpr int kDeepest = 20;
    if (depth > kDeepest || (!value.is_array() && !value.is_object())) {
      return;
    }
    if (take_points(value, time)) {
      return;
    }
    if (value.is_array()) {
      for (const Json& element : value) {
        const std::size_t before = hands_.size();
        look_at(element, time, depth + 1);
        // Hands beside each other are those of one frame.
        if (hands_.size() > before && hands_.back().time == time && depth > 0 && is_hands(value)) {
          return;
        }
      }
      return;
    }
    look_into(value, time_of(value, time), depth);
  }

  [[nodiscard]] const std::vector<SeenHand>& hands() const { return hands_; }

 private:
  bool take_points(const Json& value, std::optional<double> time) {
    if (!value.is_array() || value.size() != kPoints) {
      return false;
    }
    SeenHand hand{time, {}};
    for (std::size_t i = 0; i < kPoints; ++i) {
      const std::optional<Eigen::Vector3d> point = point_of(value[i]);
      if (!point) {
        return false;
      }
      hand.points.col(static_cast<Eigen::Index>(i)) = *point;
    }
    hands_.push_back(hand);
    return true;
  }

  // Returns whether an array is of hands, rather than of frames.
  static bool is_hands(const Json& value) {
    constexpr std::size_t kMostHands = 2;
    return value.size() <= kMostHands;
  }

  static std::optional<double> time_of(const Json& object, std::optional<double> around) {
    for (const auto& [key, scale] :
         {std::pair("time", 1.0), std::pair("t", 1.0), std::pair("timestamp", 1.0),
          std::pair("time_s", 1.0), std::pair("timestamp_s", 1.0), std::pair("time_ms", 1e-3),
          std::pair("timestamp_ms", 1e-3), std::pair("timestampMs", 1e-3)}) {
      if (const auto found = object.find(key); found != object.end() && found->is_number()) {
        return scale * found->get<double>();
      }
    }
    return around;
  }

  // Searches an object for landmarks; of several kinds for one hand, it takes those in the world.
  void look_into(const Json& object, std::optional<double> time, int depth) {
    const auto is_world = [](const std::string& key) {
      return key.find("world") != std::string::npos || key.find("World") != std::string::npos;
    };
    const std::size_t before = hands_.size();
    for (const bool world : {true, false}) {
      for (const auto& [key, value] : object.items()) {
        if (is_world(key) == world) {
          look_at(value, time, depth + 1);
        }
      }
      if (world && hands_.size() > before) {
        return;
      }
    }
  }

  std::vector<SeenHand> hands_;
};

}  // namespace

bool is_landmark_document(std::string_view text) {
  const std::string_view begin = trimmed(text);
  if (begin.starts_with('[')) {
    return true;
  }
  if (!begin.starts_with('{')) {
    return false;
  }
  const Json first = Json::parse(begin.substr(0, begin.find('\n')), nullptr, false);
  return !first.is_object() || !first.contains("landmarks") || !first.contains("time");
}

Recording read_landmark_document(const std::filesystem::path& file, std::string_view text,
                                 const std::vector<TextLine>& lines) {
  HandFinder finder;
  const Json whole = Json::parse(text, nullptr, false);
  if (!whole.is_discarded()) {
    finder.look_at(whole, std::nullopt);
    return recording_of_hands(file, finder.hands());
  }
  for (const TextLine& line : lines) {
    const Json row = Json::parse(line.text, nullptr, false);
    if (row.is_discarded() && !trimmed(line.text).empty() && line.ended) {
      throw InputError({fmt::format("{}:{}", file.string(), line.number), "", "no JSON",
                        "landmarks of a hand as JSON, whole or a row a frame", ""});
    }
    if (!row.is_discarded()) {
      finder.look_at(row, std::nullopt);
    }
  }
  return recording_of_hands(file, finder.hands());
}

namespace {

class LandmarkDocuments final : public RecordingFormat {
 public:
  [[nodiscard]] RecordingKindOfFile kind() const override {
    return {"landmark document", "JSON that contains arrays of 21 landmarks of a hand."};
  }
  [[nodiscard]] bool recognises(const RecordingFile& file) const override {
    return file.first_line() != nullptr && is_landmark_document(file.text());
  }
  [[nodiscard]] Recording read(const RecordingFile& file) const override {
    return read_landmark_document(file.path(), file.text(), file.lines());
  }
};

}  // namespace

const RecordingFormat& landmark_document_format() {
  static const LandmarkDocuments kFormat;
  return kFormat;
}

}  // namespace handway::device
