#include "recordings/array_process.h"

#include "handway/geometric/io/input_error.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <poll.h>
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
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace handway::device {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;
using ArrayJson = nlohmann::ordered_json;

constexpr std::chrono::seconds kLongestReading{100};
constexpr std::size_t kLargestReply = kMostNumbers * sizeof(double) + (std::size_t{1} << 26);

/// Beside this library, independent of the program that has loaded it.
fs::path array_reader_program() {
  Dl_info library{};
  std::error_code error;
  if (const char* given = std::getenv("HANDWAY_ARRAY_READER"); given != nullptr && *given != '\0') {
    return given;
  }
  if (::dladdr(reinterpret_cast<const void*>(&array_reader_program), &library) != 0 &&
      library.dli_fname != nullptr) {
    return fs::canonical(library.dli_fname, error).parent_path() / "handway" /
           "handway-array-reader";
  }
  return "handway-array-reader";
}

/// A running program with a pipe from its output. It is killed with the object.
class ReaderProcess {
 public:
  ReaderProcess(const fs::path& file, std::vector<std::string> arguments) : file_(file) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
      fail(std::strerror(errno));
    }
    output_ = ends[0];
    const int error = start(ends[1], std::move(arguments));
    ::close(ends[1]);
    if (error != 0) {
      ::close(output_);
      fail(fmt::format("that {} can't be started: {}", array_reader_program().string(),
                       std::strerror(error)));
    }
  }
  ~ReaderProcess() {
    ::close(output_);
    if (process_ > 0) {
      ::kill(process_, SIGKILL);
      static_cast<void>(wait());
    }
  }
  ReaderProcess(const ReaderProcess&) = delete;
  ReaderProcess& operator=(const ReaderProcess&) = delete;

  /// The whole output. @throws InputError if the program crashes or takes too long.
  std::string read_all() {
    const auto deadline = std::chrono::steady_clock::now() + kLongestReading;
    constexpr std::size_t kPiece = std::size_t{1} << 16;
    std::string bytes;
    while (true) {
      wait_readable(deadline);
      const std::size_t before = bytes.size();
      bytes.resize(before + kPiece);
      const ssize_t size = ::read(output_, bytes.data() + before, kPiece);
      bytes.resize(before + static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
      if (size == 0 || (size < 0 && errno != EINTR)) {
        break;
      }
      if (bytes.size() > kLargestReply) {
        fail("more numbers than can be read");
      }
    }
    if (const int status = wait(); !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
      fail("a damaged file, on which its reader ended");
    }
    return bytes;
  }

 private:
  int start(int output, std::vector<std::string> arguments) {
    posix_spawn_file_actions_t actions{};
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    for (const int standard : {STDIN_FILENO, STDERR_FILENO}) {
      ::posix_spawn_file_actions_addopen(&actions, standard, "/dev/null", O_RDWR, 0);
    }
    ::posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
    const std::string program = array_reader_program().string();
    arguments.insert(arguments.begin(), program);
    std::vector<char*> words;
    std::ranges::transform(arguments, std::back_inserter(words),
                           [](std::string& argument) { return argument.data(); });
    words.push_back(nullptr);
    const int error =
        ::posix_spawn(&process_, program.c_str(), &actions, nullptr, words.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    return error;
  }

  void wait_readable(std::chrono::steady_clock::time_point deadline) const {
    while (true) {
      if (std::chrono::steady_clock::now() > deadline) {
        fail("data that take longer than 100 s to read");
      }
      pollfd waiting{output_, POLLIN, 0};
      const int ready = ::poll(&waiting, 1, 1000);
      if (ready > 0 || (ready < 0 && errno != EINTR)) {
        return;
      }
    }
  }

  int wait() {
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return status;
  }

  [[noreturn]] void fail(const std::string& found) const {
    throw InputError({file_.string(), "", found, "arrays of numbers", ""});
  }

  const fs::path& file_;
  pid_t process_ = -1;
  int output_ = -1;
};

struct ArrayReply {
  ArrayJson head;
  std::string_view rest;  ///< Behind the line of JSON.
};

/// Splits a reply. @throws InputError if it is a refusal or damaged.
ArrayReply split_reply(const std::string& bytes, const fs::path& file, const std::string& element) {
  const std::size_t end = std::min(bytes.find('\n'), bytes.size());
  ArrayReply reply;
  reply.head = ArrayJson::parse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(end),
                                nullptr, false);
  if (!reply.head.is_object()) {
    throw InputError(
        {file.string(), element, "a damaged file", "arrays of numbers", "Copy the file again."});
  }
  if (reply.head.contains("error")) {
    throw InputError({file.string(), element, reply.head.value("error", ""),
                      reply.head.value("expected", ""), reply.head.value("advice", "")});
  }
  reply.rest = std::string_view(bytes).substr(std::min(end + 1, bytes.size()));
  return reply;
}

}  // namespace

ProcessArrays::ProcessArrays(const fs::path& file, std::string format)
    : NamedArrays(file), format_(std::move(format)) {
  const std::string bytes = ReaderProcess(path(), {"list", format_, path().string()}).read_all();
  const ArrayReply reply = split_reply(bytes, path(), "");
  for (const ArrayJson& array : reply.head.at("arrays")) {
    variables_.push_back(
        {array.at("name"), array.at("shape"), array.at("type"), array.at("problem")});
  }
}

Eigen::MatrixXd ProcessArrays::numbers(const RecordingVariable& variable) const {
  const std::string element = "variable " + variable.name;
  const std::string bytes =
      ReaderProcess(path(), {"read", format_, path().string(), variable.name}).read_all();
  const ArrayReply reply = split_reply(bytes, path(), element);
  const auto rows = reply.head.value("rows", Eigen::Index{0});
  const auto columns = reply.head.value("columns", Eigen::Index{0});
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  RowMajor numbers(rows, columns);
  if (static_cast<std::size_t>(numbers.size()) * sizeof(double) != reply.rest.size()) {
    throw InputError({path().string(), element, "a part of its numbers", "all", ""});
  }
  if (numbers.size() > 0) {
    std::memcpy(numbers.data(), reply.rest.data(), reply.rest.size());
  }
  return numbers;
}

std::vector<std::string> ProcessArrays::words(const RecordingVariable& variable) const {
  const std::string bytes =
      ReaderProcess(path(), {"read", format_, path().string(), variable.name}).read_all();
  return split_reply(bytes, path(), "variable " + variable.name)
      .head.value("words", std::vector<std::string>{});
}

}  // namespace handway::device
