#include "recordings/hand_rows.h"
#include "recordings/recording_formats.h"

#include <nlohmann/json.hpp>

#include <string_view>

namespace handway::device {
namespace {

/// Returns whether a line is a message of OpenXR, Rokoko or Manus.
bool is_hand_message(std::string_view text) {
  if (!text.starts_with('{')) {
    return false;
  }
  const nlohmann::json object = nlohmann::json::parse(text, nullptr, false);
  if (!object.is_object()) {
    return false;
  }
  const auto scene = object.find("scene");
  const auto message = object.find("msg");
  return (object.contains("joints") && object.contains("hand")) ||
         (scene != object.end() && scene->is_object() && scene->contains("actors")) ||
         object.contains("ergonomics") ||
         (message != object.end() && message->is_object() && message->contains("ergonomics"));
}

class HandMessages final : public RecordingFormat {
 public:
  [[nodiscard]] RecordingKindOfFile kind() const override {
    return {"hand messages",
            "Lines of JSON with the 26 joints of OpenXR, frames of Rokoko Studio, or ergonomics of "
            "Manus Core."};
  }
  [[nodiscard]] bool recognises(const RecordingFile& file) const override {
    const TextLine* first = file.first_line();
    return first != nullptr && is_hand_message(trimmed(first->text));
  }
  [[nodiscard]] Recording read(const RecordingFile& file) const override {
    return recording_of_hand_lines(file.path(), file.lines());
  }
};

}  // namespace

const RecordingFormat& hand_message_format() {
  static const HandMessages kFormat;
  return kFormat;
}

}  // namespace handway::device
