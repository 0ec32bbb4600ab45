#pragma once

#include "handway/device/glove/glove.h"
#include "handway/device/glove/glove_layout.h"

#include <memory>
#include <string>

namespace CLI {
class App;
}

namespace handway::tools {

/// Every sensor with its letter, label, counts and a bar; below it the state of the stream.
[[nodiscard]] std::string glove_table(const device::GloveFrame& frame, int sensors,
                                      device::StreamState state,
                                      const device::StreamStatistics& statistics);

/// "100.0 Hz, 1234 frames, …".
[[nodiscard]] std::string statistics_line(const device::StreamStatistics& statistics);

/// Time and counts of one frame, separated by blanks.
[[nodiscard]] std::string frame_line(const device::GloveFrame& frame, int sensors);

/// {"time": …, "counts": {"ThumbRotate": …, …}} on one line; with "wrist", a position (m) and a
/// quaternion (x y z w), of sources that have its pose.
[[nodiscard]] std::string frame_json(const device::GloveFrame& frame, int sensors);

/// {"statistics": {…}} on one line.
[[nodiscard]] std::string statistics_json(const device::StreamStatistics& statistics);

/// Choice of a glove, and options of reading it.
struct GloveDeviceOptions {
  std::string device;
  double rate_hz = 100.0;
  int baud = 115200;
  bool poll = false;
  std::string hand;  ///< With landmarks: "left" or "right"; empty: the one seen first.
};

void add_glove_device_options(CLI::App& command, GloveDeviceOptions& options);

[[nodiscard]] std::unique_ptr<device::Glove> make_glove(const GloveDeviceOptions& options);

/// handway glove calibrate: a calibration from recordings of guided poses and of a free motion.
void add_glove_calibrate(CLI::App& glove, int& exit_code);

/// handway glove emulate: an emulated CyberGlove on a pseudo-terminal or a TCP port.
void add_glove_emulate(CLI::App& glove, int& exit_code);

/// handway glove generate: a recording of a synthetic hand, faster than it would move.
void add_glove_generate(CLI::App& glove, int& exit_code);

/// handway glove live: a glove's measurements as they come.
void add_glove_live(CLI::App& glove, int& exit_code);

/// handway glove map: proposes a mapping for any robot hand.
void add_glove_map(CLI::App& glove, int& exit_code);

/// handway glove record: writes a glove's measurements into a file.
void add_glove_record(CLI::App& glove, int& exit_code);

/// handway glove replay: plays a recording like a glove.
void add_glove_replay(CLI::App& glove, int& exit_code);

}  // namespace handway::tools
