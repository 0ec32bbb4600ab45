#include "handway/geometric/scene/program.h"

#include "handway/geometric/io/number_text.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace handway::geometric {
namespace {

/// Replaces a name in a step.
class StepRenaming {
 public:
  StepRenaming(const std::string& name, const std::string& new_name)
      : name_(name), new_name_(new_name) {}

  void operator()(PickStep& pick) const { rename(pick.object); }
  void operator()(PlaceStep& place) const {
    for (std::string& support : place.supports) {
      rename(support);
    }
  }
  void operator()(PostureStep& /*move*/) const {}
  void operator()(PoseStep& move) const {
    rename(move.goal.reference);
    rename(move.goal.tool);
  }
  void operator()(LineStep& line) const { rename(line.reference); }
  void operator()(WaitStep& /*wait*/) const {}
  void operator()(OutputStep& /*output*/) const {}
  void operator()(AlternativesStep& step) const { rename_object(step.programs, name_, new_name_); }

 private:
  void rename(std::string& name) const { name = name == name_ ? new_name_ : name; }

  const std::string& name_;
  const std::string& new_name_;
};

/// Formats the words for a step.
struct StepWords {
  std::string operator()(const PickStep& pick) const { return "pick " + pick.object; }
  std::string operator()(const PlaceStep& place) const {
    return place.supports.empty() ? "place"
                                  : fmt::format("place on {}", fmt::join(place.supports, " or "));
  }
  std::string operator()(const PostureStep& move) const { return "move to " + move.posture; }
  std::string operator()(const PoseStep& move) const {
    return move.goal.reference.empty()
               ? fmt::format("move {} to a pose", move.goal.link)
               : fmt::format("move {} to {}", move.goal.link, move.goal.reference);
  }
  std::string operator()(const LineStep& line) const {
    return fmt::format("line of {:.0f} mm", millimetres(line.shift.norm()));
  }
  std::string operator()(const WaitStep& wait) const {
    return fmt::format("wait {} s", number_text(wait.duration));
  }
  std::string operator()(const OutputStep& output) const {
    return fmt::format("set {} to {}", output.name, value_text(output));
  }
  std::string operator()(const AlternativesStep& step) const {
    std::string words;
    for (const Program& program : step.programs) {
      words.append(words.empty() ? "" : " or ");
      words.append(program.name.empty() && !program.steps.empty() ? to_string(program.steps.front())
                                                                  : program.name);
    }
    return words;
  }
};

}  // namespace

std::string to_string(const ProgramStep& step) { return std::visit(StepWords(), step); }

std::string value_text(const OutputStep& output) {
  const bool* on = std::get_if<bool>(&output.value);
  return on ? (*on ? "true" : "false") : number_text(std::get<double>(output.value));
}

void rename_object(std::vector<Program>& programs, const std::string& name,
                   const std::string& new_name) {
  const StepRenaming renaming(name, new_name);
  for (Program& program : programs) {
    for (ProgramStep& step : program.steps) {
      std::visit(renaming, step);
    }
  }
}

}  // namespace handway::geometric
