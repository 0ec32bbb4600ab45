/// Puts an input in the place of a cache's entry: its first byte says how the entry is changed. The
/// entry is used only if it is one that this cache writes for this key. (That need not be what was
/// written: libFuzzer sees with what the checksum is compared, and forges it.)
#include "handway/geometric/io/disk_cache.h"
#include "input_file.h"
#include "pieces.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace {

using namespace handway;
namespace fs = std::filesystem;

const std::string kPayload = std::string(300, 'a') + std::string(5, '\0') + std::string(300, 'b');

std::string read_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A cache of two entries.
class TwoEntries {
 public:
  TwoEntries() {
    cache_.write(kKey, kPayload);
    file_ = fs::directory_iterator(folder_)->path();
    original_ = read_file(file_);
    geometric::CacheKey other = kKey;
    other.back() ^= 1;
    cache_.write(other, "another");
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
      other_ = entry.path() == file_ ? other_ : read_file(entry.path());
    }
    fuzz::require(cache_.read(kKey) == kPayload && !other_.empty());
  }

  void put(const std::string& bytes) const {
    std::ofstream(file_, std::ios::binary) << bytes;
    const std::optional<std::string> found = cache_.read(kKey);
    fuzz::require(bytes == original_ ? found == kPayload : !found || bytes == entry_of(*found));
  }

  [[nodiscard]] const std::string& original() const { return original_; }
  [[nodiscard]] const std::string& other() const { return other_; }

 private:
  static constexpr geometric::CacheKey kKey{};

  [[nodiscard]] std::string entry_of(const std::string& payload) const {
    cache_.write(kKey, payload);
    return read_file(file_);
  }

  fuzz::InputFile place_{"place"};
  fs::path folder_ = place_.add("entries/.keep", "").parent_path() / "own";
  geometric::DiskCache cache_{folder_};
  fs::path file_;
  std::string original_;
  std::string other_;
};

// The entry with bytes changed: each three of `edits` are a place and what it is changed by.
std::string flipped(std::string bytes, fuzz::Bytes edits) {
  for (; edits.size() >= 3; edits = edits.subspan(3)) {
    char& byte = bytes[(256U * edits[0] + edits[1]) % bytes.size()];
    byte = static_cast<char>(static_cast<unsigned char>(byte) ^ edits[2]);
  }
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const TwoEntries entries;
  if (size == 0) {
    return 0;
  }
  const fuzz::Bytes rest(data + 1, size - 1);
  const std::string text(rest.begin(), rest.end());
  const std::string& entry = entries.original();
  switch (data[0] % 5) {
    case 0:
      entries.put(text);
      break;
    case 1:
      entries.put(flipped(entry, rest));
      break;
    case 2:
      entries.put(entry.substr(0, rest.size() < 2 ? 0 : 256U * rest[0] + rest[1]));
      break;
    case 3:
      entries.put(entry + text);
      break;
    default:
      entries.put(entries.other());
  }
  return 0;
}
