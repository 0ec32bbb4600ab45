#include "formats/expanded_xacro.h"

#include "handway/geometric/formats/xacro_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/package_path.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/text_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kLongestRun(60);
constexpr std::size_t kMostMessage = 4096;
// Exit code of the shell for a missing program, on systems that detect it after the start.
constexpr int kNoProgram = 127;

/// A package near the xacro file, and its place in the folder made for the program.
struct FoundPackage {
  fs::path given;
  fs::path folder;
};

fs::path new_folder(const fs::path& xacro) {
  std::string name = (fs::temp_directory_path() / "handway-xacro-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) {
    throw InputError({xacro.string(), "", std::strerror(errno), "a folder for the URDF", ""});
  }
  return name;
}

// Makes `given` the folder of package `name` for readers of manifests too, whether or not
// `folder` has one of that name.
void give_package(const std::string& name, const fs::path& given, const fs::path& folder) {
  if (package_name_of(folder) == name) {
    fs::create_directory_symlink(folder, given);
    return;
  }
  fs::create_directory(given);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename() != "package.xml") {
      fs::create_symlink(entry.path(), given / entry.path().filename());
    }
  }
  replace_file(given / "package.xml",
               fmt::format("<package format=\"2\"><name>{}</name><version>0.0.0</version>"
                           "</package>\n",
                           name));
}

bool is_package_name(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
}

// Makes a prefix of ament in `prefix`, whose share folder is a path of rospkg's, too: programs of
// ROS 1 and 2 find the packages in it.
std::vector<FoundPackage> give_packages(const std::vector<std::string>& names,
                                        const fs::path& xacro, const fs::path& prefix) {
  std::vector<FoundPackage> found;
  const fs::path share = prefix / "share";
  const fs::path index = share / "ament_index" / "resource_index" / "packages";
  fs::create_directories(index);
  for (const std::string& name : names) {
    const std::optional<fs::path> folder =
        is_package_name(name) ? find_package(name, fs::absolute(xacro).parent_path())
                              : std::nullopt;
    if (!folder) {
      continue;
    }
    try {
      give_package(name, share / name, *folder);
      replace_file(index / name, "\n");
    } catch (const fs::filesystem_error& error) {
      throw InputError({folder->string(), "package " + name, error.code().message(),
                        "a folder that can be read", ""});
    }
    found.push_back({share / name, *folder});
  }
  return found;
}

// The environment of this program, with `prefix` before the paths of packages.
std::vector<std::string> environment_with(const fs::path& prefix) {
  const std::vector<std::pair<std::string, fs::path>> paths{
      {"AMENT_PREFIX_PATH=", prefix}, {"ROS_PACKAGE_PATH=", prefix / "share"}};
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text(*variable);
    if (std::ranges::none_of(paths,
                             [&](const auto& path) { return text.starts_with(path.first); })) {
      variables.emplace_back(text);
    }
  }
  for (const auto& [start, folder] : paths) {
    const char* known = std::getenv(start.substr(0, start.size() - 1).c_str());
    std::string value = fmt::format("{}{}", start, folder.string());
    if (known != nullptr && *known != '\0') {
      value.append(":").append(known);
    }
    variables.push_back(std::move(value));
  }
  return variables;
}

// Pointers for the functions of POSIX, which do not change the texts.
std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  std::ranges::transform(texts, std::back_inserter(pointers),
                         [](std::string& text) { return text.data(); });
  pointers.push_back(nullptr);
  return pointers;
}

// Starts `xacro FILE NAME:=VALUE…` with its output and messages in files. @returns 0 if the program
// does not exist.
pid_t start(const fs::path& xacro, const XacroArguments& arguments, const fs::path& prefix,
            const fs::path& out, const fs::path& messages) {
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT,
                                     0600);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, messages.c_str(), O_WRONLY | O_CREAT,
                                     0600);
  std::vector<std::string> words{"xacro", fs::absolute(xacro).string()};
  for (const auto& [name, value] : arguments) {
    words.push_back(fmt::format("{}:={}", name, value));
  }
  std::vector<std::string> environment = environment_with(prefix);
  pid_t process = 0;
  const int error = ::posix_spawnp(&process, "xacro", &actions, nullptr, pointers_to(words).data(),
                                   pointers_to(environment).data());
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

// Refuses arguments that no file declares or uses: xacro ignores them.
void check_arguments(const fs::path& xacro, const XacroFile& contents,
                     const XacroArguments& arguments) {
  if (!contents.unread.empty()) {
    return;  // it may be declared there
  }
  std::vector<std::string> names;
  std::ranges::transform(contents.arguments, std::back_inserter(names), &XacroArgument::name);
  for (const auto& [name, value] : arguments) {
    if (std::ranges::find(names, name) != names.end()) {
      continue;
    }
    throw InputError({xacro.string(), "xacro argument \"" + name + "\"",
                      "no declaration of it in the file",
                      names.empty() ? "no argument: it declares none" : "an argument of the file",
                      advise_name(name, names)});
  }
}

std::string advice_for(const XacroFile& contents, const XacroArguments& arguments,
                       const std::vector<FoundPackage>& packages) {
  std::vector<std::string> open;
  for (const XacroArgument& argument : contents.arguments) {
    if (!argument.default_text && !arguments.contains(argument.name)) {
      open.push_back(argument.name);
    }
  }
  std::vector<std::string> missing = contents.packages;
  std::erase_if(missing, [&](const std::string& name) {
    return std::ranges::any_of(
        packages, [&](const FoundPackage& found) { return found.given.filename() == name; });
  });
  std::string advice;
  if (!open.empty()) {
    advice = fmt::format(
        "Give its arguments without a default ({}): --xacro NAME:=VALUE, or xacro: {{NAME: VALUE}} "
        "of the robot in a scene",
        fmt::join(open, ", "));
  }
  if (!missing.empty()) {
    advice += fmt::format(
        "{}Name the folder of its packages that are not near the file ({}): "
        "--package-path FOLDER",
        advice.empty() ? "" : ". ", fmt::join(missing, ", "));
  }
  return advice;
}

// Replaces folders that were made for the program by those of the packages: names of meshes stay
// valid.
void name_real_folders(const fs::path& urdf, const std::vector<FoundPackage>& packages) {
  if (packages.empty()) {
    return;
  }
  std::string text = read_text_file(urdf, "a robot file (URDF)");
  bool is_changed = false;
  for (const FoundPackage& package : packages) {
    const std::string given = package.given.string() + "/";
    const std::string folder = package.folder.string() + "/";
    for (std::size_t at = text.find(given); at != std::string::npos;
         at = text.find(given, at + folder.size())) {
      text.replace(at, given.size(), folder);
      is_changed = true;
    }
  }
  if (is_changed) {
    replace_file(urdf, text);
  }
}

void expand(const fs::path& xacro, const XacroArguments& arguments, const fs::path& folder,
            const fs::path& urdf) {
  const XacroFile contents = read_xacro_file(xacro, arguments);
  check_arguments(xacro, contents, arguments);
  const std::vector<FoundPackage> packages =
      give_packages(contents.packages, xacro, folder / "packages");
  const fs::path messages = folder / "messages.txt";
  const pid_t process = start(xacro, arguments, folder / "packages", urdf, messages);
  const int status = process == 0 ? kNoProgram : wait_for(process);
  if (status == kNoProgram) {
    throw InputError(
        {xacro.string(), "", "a xacro file, and no program xacro to read it",
         "that program on the PATH, or a robot file (*.urdf)",
         "Install xacro, or convert the file where it is: xacro FILE.xacro > FILE.urdf"});
  }
  if (status != 0) {
    throw InputError({xacro.string(), "",
                      status < 0 ? "a file on which xacro runs for more than a minute"
                                 : "a file that xacro does not take: " + last_words(messages),
                      arguments.empty() ? "a xacro file that makes a robot without arguments"
                                        : "a xacro file that makes a robot with these arguments",
                      status < 0 ? "" : advice_for(contents, arguments, packages)});
  }
  name_real_folders(urdf, packages);
}

}  // namespace

ExpandedXacro::ExpandedXacro(const fs::path& xacro, const XacroArguments& arguments)
    : folder_(new_folder(xacro)) {
  try {
    expand(xacro, arguments, folder_, file());
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    throw;
  }
}

ExpandedXacro::~ExpandedXacro() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

}  // namespace handway::geometric
