#include "recordings/lerobot_info.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"
#include "recordings/array_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>
#include <utility>

namespace handway::device {
namespace {

using geometric::InputError;
using InfoJson = nlohmann::ordered_json;

[[noreturn]] void refuse_info(const std::filesystem::path& file, const std::string& element,
                              const std::string& found, const std::string& expected) {
  throw InputError(
      {file.string(), element, found, expected, "Download the folder meta of the data set again."});
}

/// Names in the order of the numbers that an object gives: {"x": 0, "y": 1}.
std::vector<std::string> names_by_index(const InfoJson& json) {
  std::vector<std::pair<double, std::string>> indexed;
  for (const auto& [name, index] : json.items()) {
    indexed.emplace_back(index.get<double>(), name);
  }
  std::ranges::stable_sort(indexed, {}, &std::pair<double, std::string>::first);
  std::vector<std::string> names;
  names.reserve(indexed.size());
  for (auto& [index, name] : indexed) {
    names.push_back(std::move(name));
  }
  return names;
}

/// Texts in a list, or in lists of an object, in their order.
std::vector<std::string> names_of(const InfoJson& json) {
  const auto is_number = [](const InfoJson& value) { return value.is_number(); };
  if (json.is_object() && !json.empty() && std::ranges::all_of(json, is_number)) {
    return names_by_index(json);
  }
  std::vector<std::string> names;
  for (const InfoJson& part : json.is_structured() ? json : InfoJson::array()) {
    if (part.is_string()) {
      names.push_back(part.get<std::string>());
    } else if (part.is_array()) {
      for (const InfoJson& name : part) {
        names.push_back(name.is_string() ? name.get<std::string>() : "");
      }
    }
  }
  return names;
}

LeRobotFeature feature_of(const std::filesystem::path& file, const std::string& name,
                          const InfoJson& json) {
  LeRobotFeature feature;
  feature.name = name;
  const std::string element = "feature " + name;
  const auto type = json.is_object() ? json.find("dtype") : json.end();
  if (type == json.end() || !type->is_string()) {
    refuse_info(file, element, "no dtype", "features with dtype and shape");
  }
  feature.type = type->get<std::string>();
  for (const InfoJson& side : json.contains("shape") ? json.at("shape") : InfoJson::array()) {
    if (!side.is_number_integer() || side.get<double>() < 1 ||
        side.get<double>() > static_cast<double>(kMostNumbers)) {
      refuse_info(file, element, fmt::format("the shape {}", json.at("shape").dump()),
                  "a list of sizes");
    }
    feature.shape.push_back(side.get<std::size_t>());
  }
  if (feature.has_numbers() && feature.width() == 0) {
    refuse_info(file, element, fmt::format("the shape {}", json.at("shape").dump()),
                fmt::format("at most {} numbers", kMostNumbers));
  }
  if (json.contains("names")) {
    feature.names = names_of(json.at("names"));
  }
  const bool has_names = std::ranges::none_of(feature.names, &std::string::empty);
  if (!has_names || feature.names.size() != feature.width()) {
    feature.names.clear();
  }
  return feature;
}

}  // namespace

std::size_t LeRobotFeature::width() const {
  std::size_t width = 1;
  for (const std::size_t side : shape) {
    width = side <= kMostNumbers / std::max<std::size_t>(width, 1) ? width * side : 0;
  }
  return width;
}

bool LeRobotFeature::has_numbers() const {
  return type.starts_with("float") || type.starts_with("int") || type.starts_with("uint") ||
         type == "bool";
}

const LeRobotFeature* LeRobotInfo::find(std::string_view name) const {
  const auto found = std::ranges::find(features, name, &LeRobotFeature::name);
  return found == features.end() ? nullptr : &*found;
}

LeRobotInfo read_lerobot_info(const std::filesystem::path& file) {
  const std::string text = geometric::read_text_file(file, "meta/info.json of a LeRobot data set");
  const InfoJson json = InfoJson::parse(text, nullptr, false);
  const bool has_features =
      json.is_object() && json.contains("features") && json.at("features").is_object();
  if (!has_features) {
    refuse_info(file, "", json.is_discarded() ? "text that is not JSON" : "no features",
                "meta/info.json of a LeRobot data set, version 2 or 3");
  }
  LeRobotInfo info;
  if (const auto rate = json.find("fps"); rate != json.end() && rate->is_number()) {
    info.rate = std::max(0.0, rate->get<double>());
  }
  for (const auto& [name, feature] : json.at("features").items()) {
    info.features.push_back(feature_of(file, name, feature));
  }
  return info;
}

}  // namespace handway::device
