#include "recordings/mano_documents.h"

#include "handway/geometric/io/plural.h"
#include "handway/geometric/io/table_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace handway::device {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kDeepest = 20;
constexpr std::size_t kMostNumbersOfPosture = 48;

// Appends the numbers of nested arrays. @returns false if there are others or too many.
bool flatten(const Json& value, std::vector<double>& numbers, int depth = 0) {
  constexpr int kDeepestPosture = 3;
  if (value.is_number() && numbers.size() < kMostNumbersOfPosture) {
    numbers.push_back(value.get<double>());
    return true;
  }
  return value.is_array() && depth < kDeepestPosture &&
         std::ranges::all_of(
             value, [&](const Json& element) { return flatten(element, numbers, depth + 1); });
}

std::optional<std::vector<double>> posture_in(const Json& value) {
  std::vector<double> numbers;
  if (!value.is_array() || !flatten(value, numbers) || !is_mano_count(numbers.size())) {
    return std::nullopt;
  }
  return numbers;
}

// A name and number of times beside `object`'s other values.
std::optional<geometric::TimeName> time_key(const std::string& key) {
  std::optional<geometric::TimeName> name = geometric::time_name(key);
  return name && name->plain && name->kind == geometric::TimeName::Kind::kTime ? name
                                                                               : std::nullopt;
}

}  // namespace

void ManoFinder::look_at(const Json& value) { look_at(value, Place{}); }

void ManoFinder::look_at(const Json& value, const Place& place) {
  if (place.depth > kDeepest) {
    return;
  }
  if (value.is_object()) {
    look_into(value, place);
  } else if (value.is_array()) {
    for (const Json& element : value) {
      look_at(element, {place.keys, place.time, place.depth + 1});
    }
  }
}

void ManoFinder::look_into(const Json& object, const Place& around) {
  Place place = around;
  ++place.depth;
  for (const auto& [key, value] : object.items()) {
    const auto name = time_key(key);
    if (name && value.is_number()) {
      all_units_are_named_ &= name->unit.seconds.has_value();
      place.time = name->unit.seconds.value_or(1.0) * value.get<double>();
      break;
    }
  }
  for (const auto& [key, value] : object.items()) {
    place.keys = around.keys + "/" + key;
    if (!is_mano_name(key) || !take(value, place, object)) {
      look_at(value, place);
    }
  }
}

bool ManoFinder::take(const Json& value, const Place& place, const Json& object) {
  if (const std::optional<std::vector<double>> one = posture_in(value)) {
    add(*one, place.keys, place.time);
    return true;
  }
  if (!value.is_array() || value.empty() || !posture_in(value.front())) {
    return false;
  }
  const Json* times = nullptr;
  double unit = 1.0;
  for (const auto& [key, other] : object.items()) {
    const auto name = time_key(key);
    if (name && other.is_array() && other.size() == value.size() &&
        std::ranges::all_of(other, [](const Json& time) { return time.is_number(); })) {
      all_units_are_named_ &= name->unit.seconds.has_value();
      unit = name->unit.seconds.value_or(1.0);
      times = &other;
      break;
    }
  }
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (const std::optional<std::vector<double>> one = posture_in(value[i])) {
      add(*one, place.keys,
          times == nullptr ? std::nullopt
                           : std::optional<double>(unit * (*times)[i].get<double>()));
    }
  }
  return true;
}

void ManoFinder::add(const std::vector<double>& numbers, const std::string& keys,
                     std::optional<double> time) {
  const ManoSide side = side_in_name(keys);
  auto hand = std::ranges::find(hands_, side, &Hand::side);
  if (hand == hands_.end()) {
    hand = hands_.insert(hand, Hand{side, {}});
  }
  hand->frames.push_back({time, mano_pose(numbers)});
}

Recording ManoFinder::recording(const std::filesystem::path& file) const {
  const Hand& first = hands_.front();
  Recording recording =
      recording_of_mano(file, first.frames, first.side, {},
                        all_units_are_named_ ? geometric::TimeUnit{1.0} : geometric::TimeUnit{});
  for (std::size_t i = 1; i < hands_.size(); ++i) {
    recording.warnings.push_back(
        fmt::format("{}: {} of another hand left out: the first posture is used with those of its "
                    "hand",
                    file.string(), geometric::plural(hands_[i].frames.size(), "posture")));
  }
  return recording;
}

}  // namespace handway::device
