#include "recordings/hand_rows.h"
#include "recordings/recording_formats.h"

namespace handway::device {
namespace {

class LandmarkLines final : public RecordingFormat {
 public:
  [[nodiscard]] RecordingKindOfFile kind() const override {
    return {"landmark lines", "Lines of JSON with 21 landmarks of a hand in m."};
  }
  [[nodiscard]] bool recognises(const RecordingFile& file) const override {
    const TextLine* first = file.first_line();
    return first != nullptr && trimmed(first->text).starts_with('{');
  }
  [[nodiscard]] Recording read(const RecordingFile& file) const override {
    return recording_of_hand_lines(file.path(), file.lines());
  }
};

}  // namespace

const RecordingFormat& landmark_line_format() {
  static const LandmarkLines kFormat;
  return kFormat;
}

}  // namespace handway::device
