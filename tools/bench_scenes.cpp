#include "bench_scenes.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <system_error>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> shipped_scenes() {
  std::vector<fs::path> scenes;
  std::error_code ignored;  // no folder: no scenes
  const fs::path folder = geometric::resource_dir().parent_path() / "scenes";
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".yaml") {
      scenes.push_back(entry.path());
    }
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

std::vector<fs::path> published_problems(const fs::path& folder) {
  std::vector<fs::path> problems;
  for (const std::string name : {"_TwoCanb", "_CanBox", "_ShelfCan2", "-shelfT2"}) {
    const fs::path file = folder / "auro" / ("TX90_RHand_ICRA10_5PMD" + name + "_new.xml");
    if (fs::exists(file)) {
      problems.push_back(file);
    }
  }
  if (problems.empty()) {
    throw geometric::InputError({"HANDWAY_REFERENCE_DIR", "", "\"" + folder.string() + "\"",
                                 "a folder that holds the published problems in \"auro\"",
                                 "Correct the variable or unset it"});
  }
  return problems;
}

}  // namespace

std::vector<fs::path> bench_scenes() {
  std::vector<fs::path> scenes = shipped_scenes();
  if (const char* reference = std::getenv("HANDWAY_REFERENCE_DIR")) {
    const std::vector<fs::path> problems = published_problems(reference);
    scenes.insert(scenes.end(), problems.begin(), problems.end());
  }
  return scenes;
}

}  // namespace handway::tools
