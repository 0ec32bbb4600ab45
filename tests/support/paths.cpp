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

}  // namespace handway::test
