#include "dataset_objects.h"

#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <cstddef>
#include <iterator>
#include <utility>

namespace handway::tools {
namespace {

using SizesJson = nlohmann::ordered_json;

// Name and shape, which ranges and drawn sizes have in common.
SizesJson head_of(const planning::ObjectChoice& choice) {
  SizesJson object = {{"name", choice.name}};
  if (!choice.scene_object.empty()) {
    object["object"] = choice.scene_object;
  } else {
    object["shape"] = choice.shape;
  }
  if (!choice.mesh_file.empty()) {
    object["file"] = choice.mesh_file.filename().string();
  }
  return object;
}

// Adds one value for each size of a choice under the key of the size.
void add_sizes(const planning::ObjectChoice& choice, const std::vector<SizesJson>& values,
               SizesJson& object) {
  if (choice.shape == "box") {
    object["size_m"] = values;
  } else if (choice.shape == "mesh") {
    object["scale"] = values.front();
  } else if (!choice.shape.empty()) {
    object["radius_m"] = values.front();
    if (values.size() > 1) {
      object["length_m"] = values[1];
    }
  }
}

// "25–38 mm", or "25 mm" if both ends are equal.
std::string range_words(const SizesJson& range) {
  const double lower = geometric::millimetres(range.at(0).get<double>());
  const double upper = geometric::millimetres(range.at(1).get<double>());
  return lower == upper ? fmt::format("{:.4g} mm", lower)
                        : fmt::format("{:.4g}–{:.4g} mm", lower, upper);
}

}  // namespace

SizesJson objects_json(const std::vector<planning::ObjectChoice>& objects) {
  SizesJson list = SizesJson::array();
  for (const planning::ObjectChoice& choice : objects) {
    SizesJson object = head_of(choice);
    std::vector<SizesJson> ranges;
    for (const planning::SizeRange& range : choice.sizes) {
      ranges.push_back(SizesJson::array({range.lower, range.upper}));
    }
    add_sizes(choice, ranges, object);
    list.push_back(std::move(object));
  }
  return list;
}

SizesJson drawn_json(const std::vector<planning::ObjectChoice>& objects, const Episode& episode) {
  const planning::ObjectChoice& choice = objects[episode.drawn->choice];
  SizesJson object = head_of(choice);
  add_sizes(choice, {episode.drawn->sizes.begin(), episode.drawn->sizes.end()}, object);
  const Eigen::Vector3d bounds = planning::size_of_object(drawn_object(episode));
  object["bounds_m"] = SizesJson::array({bounds.x(), bounds.y(), bounds.z()});
  return object;
}

std::string words_for_object(const SizesJson& object) {
  if (object.contains("object")) {
    return "object of the scene";
  }
  std::string words = object.value("shape", std::string());
  if (object.contains("file")) {
    const SizesJson& scale = object.at("scale");
    words += fmt::format(" {}, scale {:.4g}–{:.4g}", object.at("file").get<std::string>(),
                         scale.at(0).get<double>(), scale.at(1).get<double>());
  }
  if (object.contains("size_m")) {
    const SizesJson& size = object.at("size_m");
    words += fmt::format(", {} × {} × {}", range_words(size.at(0)), range_words(size.at(1)),
                         range_words(size.at(2)));
  }
  if (object.contains("radius_m")) {
    words.append(", radius ").append(range_words(object.at("radius_m")));
  }
  if (object.contains("length_m")) {
    words.append(", length ").append(range_words(object.at("length_m")));
  }
  return words;
}

}  // namespace handway::tools
