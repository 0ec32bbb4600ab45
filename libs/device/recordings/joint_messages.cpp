#include "handway/geometric/io/input_error.h"
#include "recordings/recording_formats.h"

namespace handway::device {
namespace {

class JointMessages final : public RecordingFormat {
 public:
  [[nodiscard]] RecordingKindOfFile kind() const override {
    return {"joint messages", "Messages of a robot's joints by ROS, as YAML or JSON."};
  }
  [[nodiscard]] bool recognises(const RecordingFile& file) const override {
    return has_joint_messages(file.head());
  }
  [[nodiscard]] Recording read(const RecordingFile& file) const override {
    throw geometric::InputError({file.path().string(), "", "messages of a robot's joints",
                                 "a recording of a glove",
                                 "handway pca --joints-of ROBOT reads them"});
  }
};

}  // namespace

const RecordingFormat& joint_message_format() {
  static const JointMessages kFormat;
  return kFormat;
}

}  // namespace handway::device
