#include "recordings/array_process.h"
#include "recordings/array_recording.h"
#include "recordings/recording_formats.h"

#include <cstddef>
#include <memory>
#include <string_view>

namespace handway::device {
namespace {

class Hdf5Files final : public RecordingFormat {
 public:
  [[nodiscard]] RecordingKindOfFile kind() const override {
    return {"HDF5", "Data sets of HDF5, as in files of ALOHA and robomimic."};
  }
  [[nodiscard]] bool has_variables() const override { return true; }
  [[nodiscard]] bool recognises(const RecordingFile& file) const override {
    // A block of the user's own may precede the signature.
    constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n";
    for (std::size_t at = 0; at < file.head().size(); at = at == 0 ? 512 : 2 * at) {
      if (std::string_view(file.head()).substr(at).starts_with(kSignature)) {
        return true;
      }
    }
    return false;
  }
  [[nodiscard]] std::unique_ptr<ArrayFile> open(const RecordingFile& file) const override {
    return std::make_unique<ProcessArrays>(file.path(), "hdf5");
  }
  [[nodiscard]] Recording read(const RecordingFile& file) const override {
    return read_array_recording(*open(file), file.variable());
  }
};

}  // namespace

const RecordingFormat& hdf5_format() {
  static const Hdf5Files kFormat;
  return kFormat;
}

}  // namespace handway::device
