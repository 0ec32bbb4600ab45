/// What stands in the place of a cache's entry: the first byte of an input chooses the entry, the
/// second what is done to it. Whatever that is, the entry is taken only if it is what was written,
/// and checkers made with it answer as they did before.
#include "handway/geometric/collision/make_checker.h"
#include "handway/geometric/io/disk_cache.h"
#include "handway/geometric/io/scene_reader.h"
#include "input_file.h"
#include "pieces.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace handway;
namespace fs = std::filesystem;

// Of boxes alone: what is derived of them takes milliseconds.
constexpr const char* kSliderUrdf = R"(<robot name="slider">
  <link name="base"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  <link name="hand"><collision><geometry><mesh filename="finger.obj"/></geometry></collision></link>
  <joint name="lift" type="prismatic">
    <parent link="base"/><child link="hand"/><origin xyz="0 0 0.2"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>
)";
constexpr const char* kBoxObj =
    "v 0 0 0\nv .1 0 0\nv .1 .1 0\nv 0 .1 0\nv 0 0 .1\nv .1 0 .1\nv .1 .1 .1\nv 0 .1 .1\n"
    "f 1 3 2\nf 1 4 3\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\nf 3 4 8\nf 3 8 7\n"
    "f 4 1 5\nf 4 5 8\n";
constexpr const char* kScene =
    "handway: 1\nrobots:\n  - model: slider.urdf\nobjects:\n"
    "  - name: roof\n    box: {size: [1, 1, 0.1]}\n    pose: {xyz: [0, 0, 1]}\n";

std::string read_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write_file(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

// From the entry's file name: the key in hexadecimal digits.
geometric::CacheKey key_of(const fs::path& file) {
  const std::string digits = file.stem().string();
  geometric::CacheKey key{};
  for (std::size_t i = 0; i < key.size(); ++i) {
    const char* at = digits.data() + 2 * i;
    std::from_chars(at, at + 2, key[i], 16);
  }
  return key;
}

/// A cache with entries of a scene, and what a checker of it answers.
class CachedScene {
 public:
  CachedScene() : file_("scene.yaml") {
    file_.add("slider.urdf", kSliderUrdf);
    file_.add("finger.obj", kBoxObj);
    const fs::path cache = file_.add("cache/handway/meshes/.keep", "").parent_path();
    fs::remove(cache / ".keep");
    ::setenv("XDG_CACHE_HOME", cache.parent_path().parent_path().c_str(), 1);
    scene_ = geometric::read_scene(file_.add("scene.yaml", kScene));
    answers_ = answers();
    for (const fs::directory_entry& entry : fs::directory_iterator(cache)) {
      entries_.emplace_back(entry.path(), read_file(entry.path()));
    }
    std::ranges::sort(entries_);
    fuzz::require(entries_.size() >= 2);
  }

  void put(std::size_t which, const std::string& bytes) const {
    const auto& [file, original] = entries_[which % entries_.size()];
    write_file(file, bytes);
    const geometric::DiskCache cache(file.parent_path());
    fuzz::require(cache.read(key_of(file)).has_value() == (bytes == original));
    fuzz::require(answers() == answers_);
    write_file(file, original);
  }

  [[nodiscard]] const std::string& entry(std::size_t which) const {
    return entries_[which % entries_.size()].second;
  }

 private:
  // Distances of all pairs in some configurations.
  [[nodiscard]] std::vector<double> answers() const {
    const auto checker = geometric::make_collision_checker(
        std::make_shared<const geometric::CollisionWorld>(scene_));
    std::vector<double> distances;
    for (const double lift : {0.0, 0.4, 0.6, 0.7, 0.75, 1.0}) {
      checker->place(geometric::Configuration::Constant(1, lift));
      for (int pair = 0; pair < static_cast<int>(checker->world().pairs().size()); ++pair) {
        distances.push_back(checker->pair_distance(pair, 10.0));
      }
    }
    return distances;
  }

  fuzz::InputFile file_;
  geometric::Scene scene_;
  std::vector<double> answers_;
  std::vector<std::pair<fs::path, std::string>> entries_;
};

// The entry with bytes changed: each three of `edits` are a place and what it is changed by.
std::string flipped(std::string bytes, fuzz::Bytes edits) {
  for (; edits.size() >= 3 && !bytes.empty(); edits = edits.subspan(3)) {
    char& byte = bytes[(256U * edits[0] + edits[1]) % bytes.size()];
    byte = static_cast<char>(static_cast<unsigned char>(byte) ^ edits[2]);
  }
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const CachedScene cached;
  if (size < 2) {
    return 0;
  }
  const std::size_t which = data[0];
  const fuzz::Bytes rest(data + 2, size - 2);
  const std::string text(rest.begin(), rest.end());
  const std::string& entry = cached.entry(which);
  switch (data[1] % 5) {
    case 0:
      cached.put(which, text);
      break;
    case 1:
      cached.put(which, flipped(entry, rest));
      break;
    case 2:
      cached.put(which, entry.substr(0, rest.size() < 2 ? 0 : 256U * rest[0] + rest[1]));
      break;
    case 3:
      cached.put(which, entry + text);
      break;
    default:
      cached.put(which, cached.entry(which + 1));
  }
  return 0;
}
