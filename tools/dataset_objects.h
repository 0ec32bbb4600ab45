#pragma once

#include "dataset_episode.h"
#include "handway/planning/tasks/object_choice.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

/// Drawn objects of data sets, as JSON for `dataset.json` and `episodes.jsonl`.

namespace handway::tools {

/// Returns the choices: name, shape and ranges in m (`size_m`, `radius_m`, `length_m`), or `scale`
/// and `file` of a mesh, or `object` of the scene.
[[nodiscard]] nlohmann::ordered_json objects_json(
    const std::vector<planning::ObjectChoice>& objects);

/// Returns the object of an episode: name, shape, the drawn sizes under the keys of
/// objects_json(), and `bounds_m`, the edges of the box around it.
/// @pre an object was drawn.
[[nodiscard]] nlohmann::ordered_json drawn_json(const std::vector<planning::ObjectChoice>& objects,
                                                const Episode& episode);

/// Returns words for a choice in objects_json(): "cylinder, radius 25–38 mm, length 100–160 mm".
[[nodiscard]] std::string words_for_object(const nlohmann::ordered_json& object);

}  // namespace handway::tools
