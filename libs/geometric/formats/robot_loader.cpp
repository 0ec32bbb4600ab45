#include "handway/geometric/formats/robot_loader.h"

#include "formats/expanded_xacro.h"
#include "handway/geometric/formats/srdf.h"
#include "handway/geometric/formats/urdf.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/group_proposal.h"
#include "handway/geometric/setup/collision_sampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

constexpr int kSamples = 200;
constexpr std::uint64_t kSeed = 1;

// What an SRDF would say: which links overlap by construction, and which joints are arm and hand.
void do_without_srdf(RobotDescription& robot) {
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
      "`handway setup` makes an SRDF",
      overlapping == 0
          ? ""
          : fmt::format(", and {} in most postures or where a gripper closes",
                        overlapping == 1 ? "1 pair that overlaps"
                                         : fmt::format("{} pairs that overlap", overlapping))));
  if (robot.groups.empty()) {
    const GroupProposal proposal = propose_groups(model);
    add_groups(proposal, robot);
    for (const GroupQuestion& question : proposal.questions) {
      robot.warnings.push_back(question.open + ". " + question.mend);
    }
  }
}

namespace fs = std::filesystem;

/// Of other formats, by plugins.
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

RobotDescription read_description(const fs::path& file) {
  if (has_extension(file, ".urdf")) {
    return read_urdf(file);
  }
  RobotDescription robot;
  if (has_extension(file, ".xacro")) {
    const ExpandedXacro urdf(file);
    robot = read_urdf(urdf.file(), file.parent_path());
    robot.file = file;
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
  return has_extension(file, ".urdf") || has_extension(file, ".xacro") || find_reader(file);
}

std::shared_ptr<const RobotModel> load_robot(const fs::path& file) {
  RobotDescription description = read_description(file);
  if (description.allowed_collisions.entries().empty()) {
    do_without_srdf(description);
  }
  return std::make_shared<const RobotModel>(std::move(description));
}

}  // namespace handway::geometric
