#include "handway/geometric/formats/program_steps.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "scene_sections.h"
#include "yaml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace handway::geometric {
namespace {

class StepReader {
 public:
  StepReader(const Scene& scene, std::vector<std::string>* warnings)
      : scene_(scene), warnings_(warnings) {}

  [[nodiscard]] ProgramStep read(const YamlElement& element) const {
    element.allow_keys({"pick", "place", "move"});
    const auto entries = element.entries();
    if (entries.size() != 1) {
      element.refuse(fmt::format("a map of {} keys", entries.size()),
                     "a map with one key: pick, place or move");
    }
    const auto& [kind, value] = entries.front();
    if (kind == "pick") {
      return pick_of(value);
    }
    return kind == "place" ? ProgramStep(place_of(value)) : PostureStep{value.text()};
  }

 private:
  // The name of an object of the scene.
  [[nodiscard]] std::string object_name(const YamlElement& element) const {
    std::string name = element.text();
    if (find_object(scene_, name) == nullptr) {
      if (warnings_ != nullptr) {
        warnings_->push_back(
            fmt::format("{}: the scene has no object \"{}\"", element.where(), name));
        return name;
      }
      std::vector<std::string> names;
      std::ranges::transform(scene_.objects, std::back_inserter(names), &SceneObject::name);
      element.refuse(element.found(), "an object of the scene", advise_name(name, names));
    }
    return name;
  }

  [[nodiscard]] PickStep pick_of(const YamlElement& element) const {
    PickStep pick;
    if (element.is_scalar()) {
      pick.object = object_name(element);
      return pick;
    }
    element.allow_keys({"object", "approach", "lift"});
    pick.object = object_name(element.need("object"));
    pick.approach = length_or(element, "approach", pick.approach);
    pick.lift = length_or(element, "lift", pick.lift);
    return pick;
  }

  [[nodiscard]] PlaceStep place_of(const YamlElement& element) const {
    PlaceStep place;
    if (element.is_scalar()) {
      place.support = object_name(element);
      return place;
    }
    element.allow_keys({"on", "pose", "lower", "retreat"});
    const auto on = element.find("on");
    const auto pose = element.find("pose");
    if (on.has_value() == pose.has_value()) {
      element.refuse(on ? "both on and pose" : "neither on nor pose", "one of them");
    }
    if (on) {
      place.support = object_name(*on);
    } else {
      static_cast<void>(pose->need("xyz"));
      place.pose = pose_of(*pose);
    }
    place.lower = length_or(element, "lower", place.lower);
    place.retreat = length_or(element, "retreat", place.retreat);
    return place;
  }

  // A length in m.
  static double length_or(const YamlElement& element, const std::string& key, double otherwise) {
    const auto found = element.find(key);
    const double length = found ? found->number() : otherwise;
    if (!(length >= 0.0 && length <= kLongestStraightMotion)) {
      found->refuse(found->found(),
                    fmt::format("a length from 0 to {:g} m", kLongestStraightMotion));
    }
    return length;
  }

  const Scene& scene_;
  std::vector<std::string>* warnings_;
};

struct StepText {
  std::string operator()(const PickStep& pick) const {
    return fmt::format("pick: {{object: {}, approach: {}, lift: {}}}", yaml_scalar(pick.object),
                       number_text(pick.approach), number_text(pick.lift));
  }
  std::string operator()(const PlaceStep& place) const {
    return fmt::format("place: {{{}, lower: {}, retreat: {}}}",
                       place.support.empty() ? "pose: " + yaml_pose(place.pose)
                                             : "on: " + yaml_scalar(place.support),
                       number_text(place.lower), number_text(place.retreat));
  }
  std::string operator()(const PostureStep& move) const {
    return "move: " + yaml_scalar(move.posture);
  }
};

std::string steps_text(const Program& program, const char* indent) {
  std::string text;
  for (const ProgramStep& step : program.steps) {
    text += fmt::format("{}- {}\n", indent, std::visit(StepText(), step));
  }
  return text;
}

}  // namespace

std::vector<ProgramStep> program_steps_of(const YamlElement& list, const Scene& scene,
                                          std::vector<std::string>* warnings) {
  const StepReader reader(scene, warnings);
  std::vector<ProgramStep> steps;
  for (const YamlElement& element : list.items()) {
    steps.push_back(reader.read(element));
  }
  if (steps.empty()) {
    list.refuse("an empty list", "at least one step");
  }
  return steps;
}

std::vector<Program> programs_of(const YamlElement& element, Scene& scene) {
  if (element.is_list()) {
    return {{"", program_steps_of(element, scene, &scene.warnings)}};
  }
  std::vector<Program> programs;
  for (const auto& [name, steps] : element.entries()) {
    programs.push_back({name, program_steps_of(steps, scene, &scene.warnings)});
  }
  return programs;
}

std::string programs_text(const std::vector<Program>& programs) {
  if (programs.empty()) {
    return "";
  }
  if (programs.size() == 1 && programs.front().name.empty()) {
    return "program:\n" + steps_text(programs.front(), "  ");
  }
  std::string text = "program:\n";
  for (const Program& program : programs) {
    text += fmt::format("  {}:\n{}", yaml_scalar(program.name), steps_text(program, "    "));
  }
  return text;
}

}  // namespace handway::geometric
