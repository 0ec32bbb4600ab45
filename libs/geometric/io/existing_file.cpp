#include "handway/geometric/io/existing_file.h"

#include "handway/geometric/io/lower_case.h"

#include <algorithm>
#include <optional>
#include <string>
#include <system_error>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

// The only entry of `folder` that `name` may mean.
std::optional<fs::path> entry_like(const fs::path& folder, const std::string& name) {
  std::optional<fs::path> found;
  std::error_code error;
  const std::string wanted = lower_case(name);
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (lower_case(entry->path().filename().string()) == wanted) {
      if (found) {
        return std::nullopt;
      }
      found = entry->path().filename();
    }
  }
  return found;
}

}  // namespace

fs::path with_slashes(const fs::path& path) {
  std::string text = path.string();
  std::ranges::replace(text, '\\', '/');
  return fs::path(text).lexically_normal();
}

fs::path existing_file(const fs::path& path) {
  std::error_code ignored;
  if (path.empty() || fs::exists(path, ignored)) {
    return path;
  }
  fs::path found;
  for (const fs::path& part : with_slashes(path)) {
    if (part.empty() || fs::exists(found / part, ignored)) {
      found /= part;
      continue;
    }
    const std::optional<fs::path> entry =
        entry_like(found.empty() ? fs::path(".") : found, part.string());
    if (!entry) {
      return path;
    }
    found /= *entry;
  }
  return found;
}

bool differs_in_case(const fs::path& written, const fs::path& found) {
  const fs::path normal = with_slashes(written);
  auto part = normal.end();
  auto other = found.end();
  while (part != normal.begin() && other != found.begin()) {
    const std::string name = (--part)->string();
    const std::string actual = (--other)->string();
    if (name != actual) {
      return lower_case(name) == lower_case(actual);
    }
  }
  return false;
}

bool has_extension(const fs::path& file, std::string_view extension) {
  return lower_case(file.extension().string()) == extension;
}

}  // namespace handway::geometric
