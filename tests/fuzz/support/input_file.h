#pragma once

#include "handway/geometric/io/input_error.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

/// Helpers that fuzz targets share.
namespace handway::fuzz {

/// A file in a folder of its own, with other files beside it, that is written anew for each input.
class InputFile {
 public:
  /// @param name of the file; its ending decides how it is read.
  explicit InputFile(const std::string& name);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Makes the file hold just these bytes.
  const std::filesystem::path& hold(const std::uint8_t* data, std::size_t size) const;

  /// A further file in the folder, for inputs that name others.
  std::filesystem::path add(const std::string& name, std::string_view content) const;

 private:
  std::filesystem::path folder_;
  std::filesystem::path file_;
};

/// A robot of two joints, one revolute and one prismatic, as URDF: "crane", of joints "turn" and
/// "lift".
extern const std::string_view kCraneUrdf;

/// SRDF of the crane: the group "crane_arm" of both joints.
extern const std::string_view kCraneSrdf;

/// Calls `read`, which may refuse what it reads by an InputError and in no other way.
template <typename Read>
int read_or_refuse(Read&& read) {
  try {
    read();
  } catch (const geometric::InputError&) {
    return 0;
  }
  return 0;
}

}  // namespace handway::fuzz
