#include "handway/geometric/io/replace_file.h"

#include "handway/geometric/io/input_error.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <mutex>
#include <set>
#include <string>
#include <system_error>
#include <utility>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, int error) {
  throw OutputError({file.string(), "", std::strerror(error), "a place that can be written to",
                     "The file is as it was before"});
}

void write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0) {
      if (errno == EINTR) {
        continue;
      }
      throw errno;
    }
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::fsync(descriptor) != 0 && errno != EINVAL) {  // pipes and the like can't be flushed
    throw errno;
  }
}

class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {
    if (descriptor_ < 0) {
      throw errno;
    }
  }
  ~Descriptor() { ::close(descriptor_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  [[nodiscard]] int get() const { return descriptor_; }

 private:
  int descriptor_;
};

// Temporary files of this machine; on shared disks, each machine handles its own.
const std::string& start_of_name() {
  static const std::string kStart = [] {
    std::array<char, 256> host{};
    ::gethostname(host.data(), host.size() - 1);
    return ".handway-write-" + std::string(host.data()) + "-";
  }();
  return kStart;
}

std::string temporary_in(const fs::path& folder) {
  static std::atomic<unsigned> count = 0;
  return (folder / (start_of_name() + std::to_string(::getpid()) + "-" + std::to_string(++count)))
      .string();
}

// Returns whether a program that has ended left the file. This program's number then belonged to
// another one.
bool is_leftover(const fs::directory_entry& file) {
  const std::string name = file.path().filename().string();
  std::error_code error;
  if (!name.starts_with(start_of_name()) ||
      file.symlink_status(error).type() != fs::file_type::regular) {
    return false;
  }
  const char* end = name.data() + name.size();
  pid_t program = 0;
  const auto [rest, fault] = std::from_chars(name.data() + start_of_name().size(), end, program);
  if (fault != std::errc() || rest == end || *rest != '-' || program <= 0) {
    return false;
  }
  return program == ::getpid() || (::kill(program, 0) != 0 && errno == ESRCH);
}

// Removes files left by killed programs in a folder, before this program first writes there.
void remove_leftovers(const fs::path& folder) {
  static std::mutex mutex;
  static std::set<std::pair<pid_t, fs::path>> seen;
  const std::lock_guard lock(mutex);
  if (!seen.emplace(::getpid(), folder).second) {
    return;
  }
  std::error_code ignored;
  for (const fs::directory_entry& file : fs::directory_iterator(folder, ignored)) {
    if (is_leftover(file)) {
      fs::remove(file.path(), ignored);
    }
  }
}

// Writes the new content and gives it the permissions of the old file, if any.
void write_temporary(const std::string& temporary, const fs::path& file, std::string_view content) {
  const Descriptor descriptor(
      ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  write_all(descriptor.get(), content);
  struct stat old {};
  if (::stat(file.c_str(), &old) == 0 && ::fchmod(descriptor.get(), old.st_mode & 07777) != 0) {
    throw errno;
  }
}

void flush_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY);
  if (descriptor >= 0) {
    ::fsync(descriptor);
    ::close(descriptor);
  }
}

}  // namespace

void replace_file(const fs::path& named, std::string_view content) {
  std::error_code is_new;
  const fs::path target = fs::canonical(named, is_new);
  const fs::path file = is_new ? named : target;  // links stay links
  std::string temporary;
  try {
    if (!is_new && ::access(file.c_str(), W_OK) != 0) {
      throw errno;
    }
    if (!is_new && !fs::is_regular_file(file)) {  // a device or a pipe
      const Descriptor descriptor(::open(file.c_str(), O_WRONLY | O_CLOEXEC));
      write_all(descriptor.get(), content);
      return;
    }
    const fs::path folder = fs::absolute(file).parent_path();
    remove_leftovers(folder);
    temporary = temporary_in(folder);
    write_temporary(temporary, file, content);
    if (::rename(temporary.c_str(), file.c_str()) != 0) {
      throw errno;
    }
  } catch (int error) {
    if (!temporary.empty()) {
      ::unlink(temporary.c_str());
    }
    refuse(named, error);
  }
  flush_folder(fs::absolute(file).parent_path());
}

}  // namespace handway::geometric
