#include "planner_tables.h"

#include "handway/device/core/trajectory_client.h"
#include "handway/device/emulators/device_emulator.h"
#include "handway/device/haptic/force_guide.h"
#include "handway/device/tracker/tool_follower.h"
#include "handway/planning/core/request_parameters.h"
#include "handway/planning/edits/cloud_import.h"
#include "handway/planning/grasps/hold_test.h"
#include "handway/planning/tasks/task.h"
#include "handway/planning/timing/timing_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ranges>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace handway::test {
namespace {

using geometric::Choice;
using geometric::Parameter;
using planning::Planner;

constexpr std::string_view kBegin = "<!-- tables -->\n";
constexpr std::string_view kEnd = "<!-- end of tables -->\n";

// The default with its unit.
std::string usual(const Parameter& parameter) {
  const double* number = std::get_if<double>(&parameter.value);
  if (number != nullptr && std::isinf(*number)) {
    return "none";
  }
  return parameter.unit.empty() ? to_text(parameter) : to_text(parameter) + " " + parameter.unit;
}

std::string allowed(const Parameter& parameter) {
  return std::visit(
      [&](const auto& value) -> std::string {
        using Value = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, bool>) {
          return "`true`, `false`";
        } else if constexpr (std::is_same_v<Value, Choice>) {
          return fmt::format("`{}`", fmt::join(value.options, "`, `"));
        } else if constexpr (std::is_same_v<Value, int>) {
          return fmt::format("{:.0f} to {:.0f}", parameter.lower, parameter.upper);
        } else {
          return fmt::format("{:g} to {:g}", parameter.lower, parameter.upper);
        }
      },
      parameter.value);
}

std::string abilities(const Planner& planner) {
  const planning::PlannerCapabilities can = planner.capabilities();
  return fmt::format("{}, {}, {}.",
                     can.needs_basis ? "Needs a hand basis"
                     : can.uses_pmds ? "Uses a hand basis"
                                     : "Needs no hand basis",
                     can.uses_threads ? "is faster with more threads" : "runs on one thread",
                     can.deterministic ? "finds the same path again from the same seed"
                                       : "may find another path each time");
}

template <typename Parameters>
std::string table(const Parameters& parameters) {
  std::string text = "| Parameter | Default | Allowed | Meaning |\n|---|---|---|---|\n";
  for (const Parameter& parameter : parameters) {
    text += fmt::format("| `{}` | {} | {} | {} |\n", parameter.key, usual(parameter),
                        allowed(parameter), parameter.help);
  }
  return text;
}

// The parameters that all planners share come last, from this one on.
constexpr std::string_view kFirstShared = "objective";

}  // namespace

std::string planner_tables(const planning::PlannerRegistry& registry) {
  std::string text;
  for (const std::string& name : registry.names()) {
    const auto planner = registry.create(name);
    const std::vector<Parameter> parameters = planner->parameters();
    const auto shared = std::ranges::find(parameters, kFirstShared, &Parameter::key);
    if (text.empty()) {
      text += "\n## All planners\n\n" + table(std::ranges::subrange(shared, parameters.end()));
    }
    text += fmt::format("\n## {}\n\n{}. {}\n\n", name, planner->description(), abilities(*planner));
    text += table(std::ranges::subrange(parameters.begin(), shared));
  }
  return text + '\n';
}

std::string settings_tables() {
  planning::PlanRequest request;
  planning::TimingSettings timing;
  device::MotionTolerances tolerances;
  planning::PregraspOptions grasps;
  planning::HoldConditions hold;
  planning::TaskOptions task;
  planning::CloudImport cloud;
  device::ToolFollowerSettings follower;
  device::ForceGuideSettings guide;
  device::LineFaultSettings line;
  const auto section = [](const char* title, const char* users, auto& settings) {
    return fmt::format("\n## {}\n\nFor {}.\n\n{}", title, users,
                       table(geometric::values_of(parameters_of(settings))));
  };
  return section("Planning",
                 "`handway plan`, where the time limit is 300 s, and the panel *Plan*; in Python "
                 "`Planner.plan()`",
                 request) +
         section("Timing",
                 "`handway time`, `export` and `send`, and the export dialog; in Python "
                 "`Scene.time()`",
                 timing) +
         section("Running motions",
                 "`handway send` and `task`, and the start of `haptic guide`; in Python "
                 "`Connection.run()`",
                 tolerances) +
         section("Search for grasps",
                 "`handway grasp`; in Python `Scene.grasps()`, where `count` is `most`", grasps) +
         section("Simulation of grasps", "`handway grasp --test`; in Python `Scene.grasps(test=…)`",
                 hold) +
         section("Tasks", "`handway task`; in Python `Planner.plan_task()`", task) +
         section("Point clouds",
                 "`handway cloud` and the dialog of the window; in Python `Scene.with_cloud()`",
                 cloud) +
         section("Following a wrist",
                 "the page *Wrist* of the window, where the top speed is 60°/s", follower) +
         section("Haptic guidance", "`handway haptic guide`", guide) +
         section("Faults of a line", "`handway glove emulate` and `handway tracker emulate`",
                 line) +
         '\n';
}

std::string with_tables(const std::string& page, const std::string& tables) {
  const std::size_t begin = page.find(kBegin);
  const std::size_t end = page.find(kEnd);
  if (begin == std::string::npos || end == std::string::npos || end < begin) {
    throw std::runtime_error("the page has no place for the tables");
  }
  return page.substr(0, begin + kBegin.size()) + tables + page.substr(end);
}

}  // namespace handway::test
