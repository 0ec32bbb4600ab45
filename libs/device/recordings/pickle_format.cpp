#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "recordings/recording_formats.h"

#include <string>

namespace handway::device {
namespace {

class PickleFiles final : public RecordingFormat {
 public:
  [[nodiscard]] RecordingKindOfFile kind() const override {
    return {"pickle", "Objects of Python, which are not read: they may run any program."};
  }
  [[nodiscard]] bool recognises(const RecordingFile& file) const override {
    const std::string& head = file.head();
    const bool is_binary = head.size() > 2 && head[0] == '\x80' && head[1] >= 2 && head[1] <= 5;
    return is_binary || geometric::has_extension(file.path(), ".pkl") ||
           geometric::has_extension(file.path(), ".pickle");
  }
  [[nodiscard]] Recording read(const RecordingFile& file) const override {
    throw geometric::InputError(
        {file.path().string(), "", "a pickle of Python, which may run any program when it is read",
         "arrays of NumPy (.npz)",
         "Save its arrays by numpy.savez(): of trackers those of the hand's posture, and of the "
         "model MANO hands_components and hands_mean"});
  }
};

}  // namespace

const RecordingFormat& pickle_format() {
  static const PickleFiles kFormat;
  return kFormat;
}

}  // namespace handway::device
