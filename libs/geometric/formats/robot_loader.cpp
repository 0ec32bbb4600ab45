#include "handway/geometric/formats/robot_loader.h"

#include "formats/expanded_xacro.h"
#include "handway/geometric/formats/joint_limits_file.h"
#include "handway/geometric/formats/srdf.h"
#include "handway/geometric/formats/urdf.h"
#include "handway/geometric/formats/xacro_file.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/robot/group_proposal.h"
#include "handway/geometric/setup/collision_sampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

constexpr int kSamples = 200;
constexpr std::uint64_t kSeed = 1;

// Finds links that overlap by construction, as an SRDF would list them.
void find_allowed_collisions(RobotDescription& robot) {
  const RobotModel model(robot);
  robot.allowed_collisions = sample_overlapping_links(model, kSamples, kSeed);
  if (robot.allowed_collisions.entries().empty()) {
    return;
  }
  const auto overlapping = std::ranges::count_if(
      robot.allowed_collisions.entries(),
      [](const auto& entry) { return entry.second != AllowedReason::kAdjacent; });
  robot.warnings.push_back(fmt::format(
      "no SRDF disables collisions between links: those that a joint connects may touch{}; "
      "`handway setup`, or Robot setup… in the window, makes an SRDF",
      overlapping == 0
          ? ""
          : fmt::format(", and {} in most postures or where a gripper closes",
                        overlapping == 1 ? "1 pair that overlaps"
                                         : fmt::format("{} pairs that overlap", overlapping))));
}

// An SRDF may have other group names: MoveIt prescribes none.
void find_groups(RobotDescription& robot) {
  if (has_group(robot, "arm") && has_group(robot, "hand")) {
    return;
  }
  const GroupProposal proposal = propose_groups(RobotModel(robot));
  if (robot.groups.empty()) {
    for (const GroupQuestion& question : proposal.questions) {
      robot.warnings.push_back(question.open + ". " + question.mend);
    }
  }
  add_groups(proposal, robot);
}

/// Readers of other formats, from plugins.
struct Registered {
  std::mutex mutex;
  std::vector<RobotReader> readers;
};

Registered& registered() {
  static auto& all = *new Registered;  // readers' code may be unloaded before the end
  return all;
}

std::optional<RobotReader> find_reader(const fs::path& file) {
  const std::lock_guard lock(registered().mutex);
  for (const RobotReader& reader : registered().readers) {
    if (reader.can_read(file)) {
      return reader;
    }
  }
  return std::nullopt;
}

// The SRDF beside a robot of another format; `x.srdf` for `x.urdf.xacro`.
void add_srdf_beside(const fs::path& file, RobotDescription& robot) {
  fs::path stem = file.stem();
  if (has_extension(stem, ".urdf")) {
    stem = stem.stem();
  }
  const fs::path srdf = existing_file(file.parent_path() / (stem.string() + ".srdf"));
  std::error_code ignored;
  if (fs::is_regular_file(srdf, ignored)) {
    read_srdf(srdf, robot);
  }
}

// Returns whether the file is a URDF; *.xml files are recognized by their top element.
bool is_urdf(const fs::path& file) {
  if (!has_extension(file, ".xml")) {
    return has_extension(file, ".urdf");
  }
  const std::string head = head_of(file);
  std::size_t tag = head.find('<');
  while (tag != std::string::npos && head.find_first_of("?!", tag) == tag + 1) {
    tag = head.find('<', tag + 1);
  }
  return tag != std::string::npos && head.compare(tag, 6, "<robot") == 0;
}

RobotDescription read_xacro(const fs::path& file, const XacroArguments& given) {
  XacroArguments arguments = xacro_arguments_of_environment();
  arguments.merge(XacroArguments(given));
  const ExpandedXacro urdf(file, arguments);
  RobotDescription robot = read_urdf(urdf.file(), file.parent_path());
  robot.file = file;
  robot.xacro_arguments = std::move(arguments);
  return robot;
}

RobotDescription read_description(const fs::path& file, const XacroArguments& arguments) {
  if (!arguments.empty() && !has_extension(file, ".xacro")) {
    throw InputError({file.string(), "xacro",
                      "a value for the argument \"" + arguments.begin()->first + "\"",
                      "a file called *.xacro, which takes arguments", ""});
  }
  if (is_urdf(file)) {
    return read_urdf(file);
  }
  RobotDescription robot;
  if (has_extension(file, ".xacro")) {
    robot = read_xacro(file, arguments);
  } else if (const std::optional<RobotReader> reader = find_reader(file)) {
    robot = reader->read(file);
  } else {
    std::string formats = "a robot file (*.urdf, *.xacro)";
    for (const RobotReader& other : registered().readers) {
      formats += ", " + other.name;
    }
    throw InputError(
        {file.string(), "", "a file called *" + file.extension().string(), std::move(formats), ""});
  }
  add_srdf_beside(file, robot);
  return robot;
}

}  // namespace

void register_robot_reader(RobotReader reader) {
  const std::lock_guard lock(registered().mutex);
  registered().readers.push_back(std::move(reader));
}

bool is_robot_file(const fs::path& file) {
  return is_urdf(file) || has_extension(file, ".xacro") || find_reader(file).has_value();
}

std::shared_ptr<const RobotModel> load_robot(const fs::path& file,
                                             const XacroArguments& arguments) {
  RobotDescription description = read_description(file, arguments);
  narrow_joint_limits(description);
  if (description.allowed_collisions.entries().empty()) {
    find_allowed_collisions(description);
  }
  find_groups(description);
  return std::make_shared<const RobotModel>(std::move(description));
}

}  // namespace handway::geometric
