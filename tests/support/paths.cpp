#include "handway_test/paths.h"

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace handway::test {

namespace fs = std::filesystem;

fs::path source_dir() { return HANDWAY_SOURCE_DIR; }

std::optional<fs::path> reference_dir() {
  const char* given = std::getenv("HANDWAY_REFERENCE_DIR");
  const fs::path folder =
      given ? fs::path(given) : source_dir().parent_path() / "shared" / "reference";
  return fs::is_directory(folder) ? std::optional(folder) : std::nullopt;
}

ScratchFolder::ScratchFolder() {
  std::string name = (fs::temp_directory_path() / "handway-test-XXXXXX").string();
  if (!mkdtemp(name.data())) {
    throw std::runtime_error("cannot make a scratch folder");
  }
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

// Does not use fs::copy(), which also copies write protection.
void copy_folder(const fs::path& from, const fs::path& to) {
  fs::create_directories(to);
  for (const fs::directory_entry& entry : fs::directory_iterator(from)) {
    const fs::path copy = to / entry.path().filename();
    if (entry.is_directory()) {
      copy_folder(entry, copy);
    } else {
      fs::copy_file(entry, copy);
      fs::permissions(copy, fs::perms::owner_write, fs::perm_options::add);
    }
  }
}

}  // namespace handway::test
