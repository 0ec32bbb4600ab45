#include "handway/geometric/formats/robot_loader.h"

#include "handway/geometric/formats/joint_limits_file.h"
#include "handway/geometric/formats/srdf.h"
#include "handway/geometric/formats/urdf.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/robot/group_proposal.h"
#include "handway/geometric/setup/collision_sampling.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kLongestRun(60);
constexpr std::size_t kMostMessage = 4096;

fs::path new_folder(const fs::path& xacro) {
  std::string name = (fs::temp_directory_path() / "handway-xacro-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) {
    throw InputError({xacro.string(), "", std::strerror(errno), "a folder for the URDF", ""});
  }
  return name;
}

// Starts `xacro FILE` with its output and messages in files. @returns 0 if the program does not
// exist.
pid_t start(const fs::path& xacro, const fs::path& out, const fs::path& messages) {
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT,
                                     0600);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, messages.c_str(), O_WRONLY | O_CREAT,
                                     0600);
  std::string program = "xacro";
  std::string file = fs::absolute(xacro).string();
  std::array<char*, 3> arguments = {program.data(), file.data(), nullptr};
  pid_t process = 0;
  const int error = ::posix_spawnp(&process, "xacro", &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  return error == 0 ? process : 0;
}

// Its exit status; -1 if it takes too long.
int wait_for(pid_t process) {
  const auto end = std::chrono::steady_clock::now() + kLongestRun;
  int status = 0;
  while (::waitpid(process, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > end) {
      ::kill(process, SIGKILL);
      ::waitpid(process, &status, 0);
      return -1;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

std::string last_words(const fs::path& messages) {
  std::string text;
  try {
    text = read_text_file(messages, "messages of xacro");
  } catch (const InputError&) {
    return "";  // it said nothing that can be read
  }
  return text.size() > kMostMessage ? text.substr(text.size() - kMostMessage) : text;
}

/// The URDF that the program `xacro` makes of a file, without arguments: a temporary file during
/// the lifetime of this object.
class ExpandedXacro {
 public:
  /// @throws InputError if there is no such program, or with its output if it fails or takes longer
  /// than a minute.
  explicit ExpandedXacro(const fs::path& xacro);
  ~ExpandedXacro();
  ExpandedXacro(const ExpandedXacro&) = delete;
  ExpandedXacro& operator=(const ExpandedXacro&) = delete;

  [[nodiscard]] fs::path file() const { return folder_ / "robot.urdf"; }

 private:
  fs::path folder_;
};

ExpandedXacro::ExpandedXacro(const fs::path& xacro) : folder_(new_folder(xacro)) {
  const fs::path messages = folder_ / "messages.txt";
  const pid_t process = start(xacro, file(), messages);
  std::error_code ignored;
  // Exit code of the shell for a missing program, on systems that detect it after the start.
  constexpr int kNoProgram = 127;
  const int status = process == 0 ? kNoProgram : wait_for(process);
  if (status == 0) {
    return;
  }
  const std::string said = last_words(messages);
  fs::remove_all(folder_, ignored);
  if (status == kNoProgram) {
    throw InputError(
        {xacro.string(), "", "a xacro file, and no program xacro to read it",
         "that program on the PATH, or a robot file (*.urdf)",
         "Install xacro, or convert the file where it is: xacro FILE.xacro > FILE.urdf"});
  }
  throw InputError({xacro.string(), "",
                    status < 0 ? "a file on which xacro runs for more than a minute"
                               : "a file that xacro does not take: " + said,
                    "a xacro file that makes a robot without arguments", ""});
}

ExpandedXacro::~ExpandedXacro() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

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

RobotDescription read_description(const fs::path& file) {
  if (is_urdf(file)) {
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
  return is_urdf(file) || has_extension(file, ".xacro") || find_reader(file).has_value();
}

std::shared_ptr<const RobotModel> load_robot(const fs::path& file) {
  RobotDescription description = read_description(file);
  narrow_joint_limits(description);
  if (description.allowed_collisions.entries().empty()) {
    find_allowed_collisions(description);
  }
  find_groups(description);
  return std::make_shared<const RobotModel>(std::move(description));
}

}  // namespace handway::geometric
