#include "formats/expanded_xacro.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>
#include <thread>

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

// Starts `xacro FILE` with its output and messages in files. @returns 0 if there is no such
// program.
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

}  // namespace

ExpandedXacro::ExpandedXacro(const fs::path& xacro) : folder_(new_folder(xacro)) {
  const fs::path messages = folder_ / "messages.txt";
  const pid_t process = start(xacro, file(), messages);
  std::error_code ignored;
  // The shell's way to say that a program is not there, of systems that find out after the start.
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

}  // namespace handway::geometric
