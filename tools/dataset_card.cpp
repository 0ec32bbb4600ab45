#include "dataset_card.h"

#include "dataset_objects.h"
#include "handway/report/document/escaping.h"
#include "version.h"

#include <fmt/format.h>

#include <cstddef>
#include <utility>

namespace handway::tools {
namespace {

using CardJson = nlohmann::ordered_json;

/// Counts of the episodes with one object.
struct ObjectCounts {
  int episodes = 0;
  int solved = 0;
};

/// Counts of a list of episodes.
struct EpisodeCounts {
  int solved = 0;
  double duration = 0.0;  ///< s
  std::size_t frames = 0;
  std::map<std::string, ObjectCounts> objects;                 ///< By their names.
  std::map<std::pair<std::string, std::string>, int> reasons;  ///< By object and reason.
};

EpisodeCounts counts_of(const std::map<int, CardJson>& entries) {
  EpisodeCounts counts;
  for (const auto& [index, entry] : entries) {
    const std::string object =
        entry.contains("object") ? entry["object"].value("name", std::string()) : std::string();
    ObjectCounts& of_object = counts.objects[object];
    ++of_object.episodes;
    if (entry.value("solved", false)) {
      ++counts.solved;
      ++of_object.solved;
      counts.duration += entry.value("duration_s", 0.0);
      counts.frames += entry.value("frames", std::size_t{0});
    } else {
      ++counts.reasons[{object, entry.value("reason", std::string())}];
    }
  }
  return counts;
}

double percent(int part, std::size_t all) {
  return all == 0 ? 0.0 : 100.0 * part / static_cast<double>(all);
}

std::string columns_text(const std::string& format) {
  constexpr const char* kStages = "an index into the episode's `stages` in `episodes.jsonl`";
  if (format == "mcap") {
    return fmt::format(
        "Each file is a bag of ROS 2 in MCAP: `/joint_states` has the joints (rad or m), and "
        "`stage`, {}; `/palm` and a topic for each picked object have their poses in the frame "
        "`world`. ",
        kStages);
  }
  if (format == "lerobot") {
    return fmt::format(
        "The folder is a data set of LeRobot, version 3, without pictures. `observation.state` has "
        "the joints (rad or m), `action` those of the next frame, `observation.environment_state` "
        "the poses in the world of the palm and of each picked object (`.x`, `.y`, `.z` in m, "
        "`.qx`, `.qy`, `.qz`, `.qw`), and `stage` is {}. Episodes without a motion are left out, "
        "so that numbers of episodes differ from those in `episodes.jsonl`. The folder `episodes` "
        "has the motions in double precision, from which the tables are made when the data set is "
        "continued. ",
        kStages);
  }
  const std::string head = format == "csv"       ? "Each file is a table of `time` (s) and"
                           : format == "parquet" ? "Each file is a table of `time_s` and"
                                                 : "Each file has `time` (s), `values` [frames, "
                                                   "columns] and `names` of the columns:";
  return fmt::format(
      "{} the joints (rad or m), the poses in the world of the palm and of each picked object "
      "(`.x`, `.y`, `.z` in m, `.qx`, `.qy`, `.qz`, `.qw`), and `stage`, {}. ",
      head, kStages);
}

std::string objects_text(const CardJson& settings, const EpisodeCounts& counts) {
  std::string text =
      "\nEach motion is with one of these objects, drawn by its seed. Its pose is that of "
      "`object`; "
      "`object.choice` is its place in this list, from 0, and `object.size_x`, `.size_y`, "
      "`.size_z` are the edges of the box around it, m. `episodes.jsonl` has the drawn sizes.\n\n"
      "| Object | | Episodes | With a motion |\n|---|---|---|---|\n";
  for (const CardJson& object : settings["objects"]) {
    const auto name = object.value("name", std::string());
    const auto found = counts.objects.find(name);
    const ObjectCounts of_object = found == counts.objects.end() ? ObjectCounts{} : found->second;
    text += fmt::format("| {} | {} | {} | {} ({:.1f} %) |\n", report::markdown_escaped(name),
                        report::markdown_escaped(words_for_object(object)), of_object.episodes,
                        of_object.solved,
                        percent(of_object.solved, static_cast<std::size_t>(of_object.episodes)));
  }
  return text;
}

std::string reasons_text(bool has_objects, const EpisodeCounts& counts) {
  std::string text = has_objects ? "\n| Episodes without a motion | Object | |\n|---|---|---|\n"
                                 : "\n| Episodes without a motion | |\n|---|---|\n";
  for (const auto& [what, count] : counts.reasons) {
    const auto& [object, reason] = what;
    text.append("| ").append(report::markdown_escaped(reason));
    if (has_objects) {
      text.append(" | ").append(report::markdown_escaped(object));
    }
    text += fmt::format(" | {} |\n", count);
  }
  return text;
}

}  // namespace

std::string data_card(const CardJson& settings, const std::map<int, CardJson>& entries) {
  const EpisodeCounts counts = counts_of(entries);
  const bool has_objects = settings.contains("objects");
  std::string steps;
  for (const CardJson& step : settings["steps"]) {
    steps.append(steps.empty() ? "" : ", ");
    steps.append(report::markdown_escaped(step.get<std::string>()));
  }
  std::string card = fmt::format(
      "# Motions of {} in \"{}\"\n\n"
      "Made by `handway dataset`, version {}. Task: {}.\n\n"
      "| | |\n|---|---|\n| episodes | {} |\n| with a motion | {} ({:.1f} %) |\n"
      "| frames | {} |\n| duration of all motions | {:.1f} s |\n\n",
      report::markdown_escaped(settings["robot"].get<std::string>()),
      report::markdown_escaped(settings["scene"].get<std::string>()), kVersion, steps,
      entries.size(), counts.solved, percent(counts.solved, entries.size()), counts.frames,
      counts.duration);
  card += columns_text(settings["format"].get<std::string>());
  card +=
      "`dataset.json` has all settings.\n\n"
      "Every motion is certified to be free of collisions along its whole length, in the scene of "
      "each stage, and passes the pre-flight check. The motions are planned, not measured: objects "
      "are assumed not to move in the hand, and contact forces are not simulated.\n";
  if (has_objects) {
    card += objects_text(settings, counts);
  }
  if (!counts.reasons.empty()) {
    card += reasons_text(has_objects, counts);
  }
  return card;
}

}  // namespace handway::tools
