#include "handway/geometric/formats/program_steps.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "scene_sections.h"
#include "yaml_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

class StepReader {
 public:
  StepReader(const Scene& scene, std::vector<std::string>* warnings)
      : scene_(scene), warnings_(warnings) {}

  [[nodiscard]] ProgramStep read(const YamlElement& element) const {
    element.allow_keys({"pick", "place", "move", "line", "wait", "output", "first_of", "disabled"});
    auto entries = element.entries();
    std::erase_if(entries, [](const auto& entry) { return entry.first == "disabled"; });
    if (entries.size() != 1) {
      element.refuse(fmt::format("a map of {} keys", entries.size()),
                     "a map with one key: pick, place, move, line, wait, output or first_of; and "
                     "disabled, if the step is not to be planned");
    }
    ProgramStep step = step_of(entries.front().first, entries.front().second);
    step.disabled = element.flag_or("disabled", false);
    return step;
  }

 private:
  [[nodiscard]] ProgramStep step_of(const std::string& kind, const YamlElement& value) const {
    if (kind == "pick") {
      return pick_of(value);
    }
    if (kind == "place") {
      return place_of(value);
    }
    if (kind == "line") {
      return line_of(value);
    }
    if (kind == "wait") {
      return wait_of(value);
    }
    if (kind == "output") {
      return output_of(value);
    }
    if (kind == "first_of") {
      return alternatives_of(value);
    }
    if (value.is_map()) {
      return PoseStep{relative_goal_of(value, scene_, warnings_)};
    }
    return PostureStep{value.text()};
  }

  // The name of an object of the scene.
  [[nodiscard]] std::string object_name(const YamlElement& element) const {
    if (warnings_ == nullptr) {
      return named_object_of(element, scene_).name;
    }
    std::string name = element.text();
    if (find_object(scene_, name) == nullptr) {
      warnings_->push_back(
          fmt::format("{}: the scene has no object \"{}\"", element.where(), name));
    }
    return name;
  }

  // The name of an object or frame to place something on.
  [[nodiscard]] std::string support_name(const YamlElement& element) const {
    return find_frame(scene_, element.text()) ? standing_name_of(element, scene_, warnings_)
                                              : object_name(element);
  }

  // One name, or a list of names.
  [[nodiscard]] std::vector<std::string> support_names(const YamlElement& element) const {
    if (!element.is_list()) {
      return {support_name(element)};
    }
    std::vector<std::string> names;
    std::ranges::transform(element.items(), std::back_inserter(names),
                           [this](const YamlElement& item) { return support_name(item); });
    if (names.empty()) {
      element.refuse("an empty list", "at least one object or frame");
    }
    return names;
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
    if (!element.is_map()) {
      place.supports = support_names(element);
      return place;
    }
    element.allow_keys({"on", "pose", "lower", "retreat"});
    const auto on = element.find("on");
    const auto pose = element.find("pose");
    if (!on && !pose) {
      element.refuse("neither on nor pose", "one of them, or both");
    }
    if (on) {
      place.supports = support_names(*on);
    }
    if (pose) {
      static_cast<void>(pose->need("xyz"));
      place.pose = pose_of(*pose);
    }
    place.lower = length_or(element, "lower", place.lower);
    place.retreat = length_or(element, "retreat", place.retreat);
    return place;
  }

  [[nodiscard]] LineStep line_of(const YamlElement& element) const {
    element.allow_keys({"xyz", "in"});
    LineStep line;
    const YamlElement shift = element.need("xyz");
    line.shift = shift.numbers(3);
    if (!(line.shift.norm() > 0.0 && line.shift.norm() <= kLongestStraightMotion)) {
      shift.refuse(shift.found(), fmt::format("a vector of a length above 0, up to {:g} m",
                                              kLongestStraightMotion));
    }
    if (const auto in = element.find("in")) {
      line.reference =
          in->text() == kPalmAxes ? kPalmAxes : standing_name_of(*in, scene_, warnings_);
    }
    return line;
  }

  static WaitStep wait_of(const YamlElement& element) {
    const WaitStep wait{element.number()};
    if (!(wait.duration > 0.0 && wait.duration <= kLongestWait)) {
      element.refuse(element.found(), fmt::format("a time above 0, up to {:g} s", kLongestWait));
    }
    return wait;
  }

  static OutputStep output_of(const YamlElement& element) {
    element.allow_keys({"name", "value"});
    const YamlElement name = element.need("name");
    const YamlElement value = element.need("value");
    OutputStep output{name.text()};
    if (output.name.empty()) {
      name.refuse(name.found(), "the name of an output");
    }
    if (parse_number(value.text())) {
      output.value = value.number();
    } else if (value.text() == "true" || value.text() == "false") {
      output.value = value.text() == "true";
    } else {
      value.refuse(value.found(), "true, false or a number");
    }
    return output;
  }

  // A list of lists of steps, or a map from names to lists of steps.
  [[nodiscard]] AlternativesStep alternatives_of(const YamlElement& element) const {
    AlternativesStep step;
    if (element.is_list()) {
      for (const YamlElement& steps : element.items()) {
        step.programs.push_back({"", program_steps_of(steps, scene_, warnings_)});
      }
    } else {
      for (const auto& [name, steps] : element.entries()) {
        step.programs.push_back({name, program_steps_of(steps, scene_, warnings_)});
      }
    }
    if (step.programs.size() < 2) {
      element.refuse(fmt::format("{} of them", step.programs.size()),
                     "at least two lists of steps, the first that is possible is done");
    }
    return step;
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
  // The step with its key, as an entry of a map in a line.
  [[nodiscard]] std::string entry(const ProgramStep& step) const {
    return std::visit(*this, step) + (step.disabled ? ", disabled: true" : "");
  }

  std::string operator()(const PickStep& pick) const {
    return fmt::format("pick: {{object: {}, approach: {}, lift: {}}}", yaml_scalar(pick.object),
                       number_text(pick.approach), number_text(pick.lift));
  }
  std::string operator()(const PlaceStep& place) const {
    std::vector<std::string> names;
    std::ranges::transform(place.supports, std::back_inserter(names), yaml_scalar);
    std::string on = fmt::format("{}", fmt::join(names, ", "));
    on = names.empty() ? "" : names.size() == 1 ? "on: " + on + ", " : "on: [" + on + "], ";
    const std::string pose = place.pose ? "pose: " + yaml_pose(*place.pose) + ", " : "";
    return fmt::format("place: {{{}{}lower: {}, retreat: {}}}", on, pose, number_text(place.lower),
                       number_text(place.retreat));
  }
  std::string operator()(const PostureStep& move) const {
    return "move: " + yaml_scalar(move.posture);
  }
  std::string operator()(const PoseStep& move) const {
    return fmt::format("move: {{{}}}", fmt::join(goal_entries(move.goal, move.goal.X_WG), ", "));
  }
  std::string operator()(const LineStep& line) const {
    const std::string in =
        line.reference.empty() ? "" : fmt::format("in: {}, ", yaml_scalar(line.reference));
    return fmt::format("line: {{{}xyz: {}}}", in, yaml_list(line.shift));
  }
  std::string operator()(const WaitStep& wait) const {
    return fmt::format("wait: {}", number_text(wait.duration));
  }
  std::string operator()(const OutputStep& output) const {
    return fmt::format("output: {{name: {}, value: {}}}", yaml_scalar(output.name),
                       value_text(output));
  }
  std::string operator()(const AlternativesStep& step) const {
    const bool has_names = std::ranges::none_of(
        step.programs, [](const Program& program) { return program.name.empty(); });
    std::vector<std::string> lists;
    for (const Program& program : step.programs) {
      std::vector<std::string> steps;
      for (const ProgramStep& one : program.steps) {
        steps.push_back(fmt::format("{{{}}}", entry(one)));
      }
      const std::string name =
          has_names ? fmt::format("{}: ", yaml_scalar(program.name)) : std::string();
      lists.push_back(fmt::format("{}[{}]", name, fmt::join(steps, ", ")));
    }
    const char* brackets = has_names ? "{}" : "[]";
    return fmt::format("first_of: {}{}{}", brackets[0], fmt::join(lists, ", "), brackets[1]);
  }
};

std::string steps_text(const Program& program, const char* indent) {
  std::string text;
  for (const ProgramStep& step : program.steps) {
    const std::string entry = StepText().entry(step);
    text += indent;
    text += step.disabled ? fmt::format("- {{{}}}\n", entry) : fmt::format("- {}\n", entry);
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
