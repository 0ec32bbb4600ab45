#include "handway/geometric/formats/robot_loader.h"

#include "handway/geometric/formats/urdf_reader.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/group_proposal.h"
#include "handway/geometric/setup/collision_sampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

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
          : fmt::format(", and {} in most postures",
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

}  // namespace

std::shared_ptr<const RobotModel> load_robot(const std::filesystem::path& file) {
  if (!has_extension(file, ".urdf")) {
    throw InputError({file.string(), "", "a file called *" + file.extension().string(),
                      "a robot file (*.urdf)",
                      "Convert xacro files first: xacro FILE.xacro > FILE.urdf"});
  }
  RobotDescription description = read_urdf(file);
  if (description.allowed_collisions.entries().empty()) {
    do_without_srdf(description);
  }
  return std::make_shared<const RobotModel>(std::move(description));
}

}  // namespace handway::geometric
