#include "handway/geometric/io/replace_file.h"

#include "handway/geometric/io/input_error.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

namespace handway::geometric {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, int error) {
  throw InputError({file.string(), "", std::strerror(error), "a place that can be written to",
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

}  // namespace

void replace_file(const std::filesystem::path& file, std::string_view content) {
  std::string temporary = file.string() + ".XXXXXX";
  const int descriptor = ::mkstemp(temporary.data());
  if (descriptor < 0) {
    refuse(file, errno);
  }
  try {
    write_all(descriptor, content);
    if (::fchmod(descriptor, 0644) != 0 || ::close(descriptor) != 0 ||
        ::rename(temporary.c_str(), file.c_str()) != 0) {
      throw errno;
    }
  } catch (int error) {
    ::close(descriptor);
    ::unlink(temporary.c_str());
    refuse(file, error);
  }
}

}  // namespace handway::geometric
