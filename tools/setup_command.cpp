#include "commands.h"
#include "handway/geometric/formats/srdf.h"
#include "handway/geometric/formats/urdf.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/robot_description.h"
#include "handway/geometric/setup/robot_setup.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "printing.h"
#include "robot_report.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace handway::tools {
namespace {

using geometric::AllowedReason;
using geometric::GroupProposal;
using geometric::InputError;
using geometric::RobotDescription;
using geometric::RobotModel;
using geometric::WristOwner;
using Json = nlohmann::ordered_json;

constexpr std::array kReasons = {AllowedReason::kAdjacent, AllowedReason::kAlways,
                                 AllowedReason::kDefault, AllowedReason::kNever,
                                 AllowedReason::kUser};

struct SetupChoice {
  std::filesystem::path file;
  std::filesystem::path out;
  int samples = 10'000;
  std::uint64_t seed = 1;
  std::string wrist;
  bool mirror = false;
  bool as_json = false;
};

WristOwner owner_of_wrist(const SetupChoice& choice) {
  return choice.wrist.empty()    ? WristOwner::kUndecided
         : choice.wrist == "arm" ? WristOwner::kArm
                                 : WristOwner::kHand;
}

std::shared_ptr<const RobotModel> first_robot(const std::filesystem::path& file) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  return planning::load_scene(file, plugins).scene->robots.front().model;
}

void print_text(const RobotReport& report, const RobotDescription& robot) {
  print_out("robot {}: {} links, {} independent joints\n", robot.name, robot.links.size(),
            report.model->variable_count());
  for (const geometric::JointGroup& group : robot.groups) {
    print_out("group {}: {}\n", group.name, fmt::join(group.joints, ", "));
  }
  for (const geometric::EndEffector& effector : robot.end_effectors) {
    print_out("end effector {}: group {} on {}\n", effector.name, effector.group,
              effector.parent_link);
  }
  const GroupProposal& groups = report.groups;
  if (!groups.palm.empty()) {
    print_out("palm: {}\nfingertips: {}\n", groups.palm, fmt::join(groups.fingertips, ", "));
  } else if (!groups.tip.empty()) {
    print_out("tip: {}\n", groups.tip);
  }
  std::vector<std::string> counts;
  for (const AllowedReason reason : kReasons) {
    const auto count =
        std::ranges::count_if(robot.allowed_collisions.entries(),
                              [reason](const auto& entry) { return entry.second == reason; });
    if (count > 0) {
      counts.push_back(fmt::format("{} {}", count, to_string(reason)));
    }
  }
  print_out("allowed collisions between links: {} ({})\n",
            robot.allowed_collisions.entries().size(), fmt::join(counts, ", "));
  print_findings(report);
}

void print_json(const RobotReport& report, const RobotDescription& robot) {
  Json groups = Json::object();
  for (const geometric::JointGroup& group : robot.groups) {
    groups[group.name] = group.joints;
  }
  Json allowed = Json::array();
  for (const auto& [pair, reason] : robot.allowed_collisions.entries()) {
    allowed.push_back({pair.first, pair.second, to_string(reason)});
  }
  const Json document{{"robot", robot.name},
                      {"groups", groups},
                      {"wrist", report.groups.wrist},
                      {"palm", report.groups.palm},
                      {"fingertips", report.groups.fingertips},
                      {"tip", report.groups.tip},
                      {"samples", report.sampled.samples},
                      {"colliding", report.sampled.colliding},
                      {"allowed", allowed},
                      {"findings", findings_json(report)}};
  print_out("{}\n", document.dump(2));
}

void check_out(const SetupChoice& choice) {
  const bool is_srdf = geometric::has_extension(choice.out, ".srdf");
  if (!is_srdf && !geometric::has_extension(choice.out, ".urdf")) {
    throw InputError({"--out", "", "a file called " + choice.out.filename().string(),
                      "NAME.srdf, or NAME.urdf to write both files", ""});
  }
  if (is_srdf && choice.mirror) {
    throw InputError({"--out", "", "a file called " + choice.out.filename().string(),
                      "NAME.urdf, for the mirror image", ""});
  }
  if (is_srdf && !choice.wrist.empty() && std::filesystem::exists(choice.out)) {
    throw InputError({"--wrist", "", choice.out.string() + ", which exists", "a new SRDF",
                      "Edit the groups of the existing SRDF instead"});
  }
}

void write(const RobotDescription& robot, const std::filesystem::path& out) {
  if (geometric::has_extension(out, ".urdf")) {
    write_urdf(RobotModel(robot), out);
  } else {
    update_srdf(robot, out);
  }
}

int setup(const SetupChoice& choice) {
  if (!choice.out.empty()) {
    check_out(choice);
  }
  std::shared_ptr<const RobotModel> model = first_robot(choice.file);
  if (choice.mirror) {
    model = std::make_shared<const RobotModel>(geometric::mirrored(model->description()));
  }
  const WristOwner wrist = owner_of_wrist(choice);
  const RobotReport report =
      robot_report(model, decided_groups(*model, wrist), choice.samples, choice.seed);
  const RobotDescription robot =
      with_setup(*model, report.sampled, report.groups, {.wrist = wrist});
  if (choice.as_json) {
    print_json(report, robot);
  } else {
    print_text(report, robot);
  }
  if (!choice.out.empty()) {
    write(robot, choice.out);
  }
  return kDone;
}

}  // namespace

void add_setup_command(CLI::App& app, int& exit_code) {
  auto choice = std::make_shared<SetupChoice>();
  CLI::App* command = app.add_subcommand(
      "setup", "Compute a robot's groups and allowed collisions, and write its SRDF");
  command->add_option("file", choice->file, "Robot file, or a scene, whose first robot is used")
      ->required();
  command->add_option(
      "-o,--out", choice->out,
      "File to write: NAME.srdf or, for the robot of a scene, NAME.urdf with NAME.srdf beside it");
  command->add_option("--samples", choice->samples, "Number of random postures")
      ->check(CLI::Range(1, 10'000'000))
      ->capture_default_str();
  command->add_option("--seed", choice->seed, "Seed of the random postures")->capture_default_str();
  command
      ->add_option("--wrist", choice->wrist,
                   "Group of the wrist, which is up to three joints before the palm: arm or hand")
      ->check(CLI::IsMember({"arm", "hand"}));
  command->add_flag("--mirror", choice->mirror,
                    "Mirror the robot, for example to make a left hand of a right one");
  command->add_flag("--json", choice->as_json, "Print JSON");
  command->callback([choice, &exit_code] { exit_code = setup(*choice); });
}

}  // namespace handway::tools
