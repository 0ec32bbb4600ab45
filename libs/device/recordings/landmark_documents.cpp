#include "glove/text_files.h"
#include "handway/device/glove/human_hand.h"
#include "handway/geometric/io/input_error.h"
#include "recordings/landmark_recording.h"
#include "recordings/mano_documents.h"
#include "recordings/recording_formats.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace handway::device {
namespace {

using geometric::InputError;
using Json = nlohmann::ordered_json;

constexpr std::size_t kPoints = 21;

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
  /// The unit of their times: s if all keys of times name a unit.
  [[nodiscard]] geometric::TimeUnit time_unit() const {
    return all_units_are_named_ ? geometric::TimeUnit{1.0} : geometric::TimeUnit{};
  }

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

  std::optional<double> time_of(const Json& object, std::optional<double> around) {
    for (const auto& [key, value] : object.items()) {
      const auto name = geometric::time_name(key);
      if (value.is_number() && name && name->plain &&
          name->kind == geometric::TimeName::Kind::kTime) {
        all_units_are_named_ &= name->unit.seconds.has_value();
        return name->unit.seconds.value_or(1.0) * value.get<double>();
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
  bool all_units_are_named_ = true;
};

/// Returns whether a text is JSON but not of Handway's own landmark lines.
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

Recording recording_of_found(const std::filesystem::path& file, const HandFinder& finder,
                             const ManoFinder& mano) {
  return finder.hands().empty() && mano.has_found()
             ? mano.recording(file)
             : recording_of_hands(file, finder.hands(), finder.time_unit());
}

/// Every array of 21 points in a JSON document, or in lines of JSON, is a hand: the first of each
/// frame, of its world landmarks if there are some. Times are values of keys with such a name
/// beside or around it.
/// Without any, postures of MANO are looked for.
/// @throws InputError if it is not JSON, or has no hand.
Recording read_landmark_document(const std::filesystem::path& file, std::string_view text,
                                 const std::vector<TextLine>& lines) {
  HandFinder finder;
  ManoFinder mano;
  const Json whole = Json::parse(text, nullptr, false);
  if (!whole.is_discarded()) {
    finder.look_at(whole, std::nullopt);
    mano.look_at(whole);
    return recording_of_found(file, finder, mano);
  }
  for (const TextLine& line : lines) {
    const Json row = Json::parse(line.text, nullptr, false);
    if (row.is_discarded() && !trimmed(line.text).empty() && line.ended) {
      throw InputError({fmt::format("{}:{}", file.string(), line.number), "", "no JSON",
                        "landmarks of a hand as JSON, whole or a row a frame", ""});
    }
    if (!row.is_discarded()) {
      finder.look_at(row, std::nullopt);
      mano.look_at(row);
    }
  }
  return recording_of_found(file, finder, mano);
}

class LandmarkDocuments final : public RecordingFormat {
 public:
  [[nodiscard]] RecordingKindOfFile kind() const override {
    return {"landmark document",
            "JSON that contains arrays of 21 landmarks of a hand, or postures of MANO."};
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
