#pragma once

#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/hand_mapper.h"
#include "handway/device/glove/recording.h"
#include "handway/device/glove/recording_quality.h"

#include <filesystem>
#include <optional>

namespace handway::tools {

/// What is done to a recording before it is mapped. 0: not done.
struct RecordingSteps {
  double from = 0.0;         ///< s
  std::optional<double> to;  ///< s
  bool drop_duplicates = false;
  double resample = 0.0;  ///< Hz
  double low_pass = 0.0;  ///< Hz
};

/// A recording on its way to postures of a hand.
struct MappedRecording {
  std::filesystem::path file;
  device::Recording recording;       ///< Angles, after all steps.
  device::RecordingQuality quality;  ///< Of the file as it was read.
  bool calibrated = false;           ///< It held counts.
  device::MappedPostures mapped;
};

/// Reads, calibrates (counts only), filters in the order of the steps, and maps.
[[nodiscard]] MappedRecording map_file(const std::filesystem::path& file,
                                       const device::GloveCalibration& calibration,
                                       const RecordingSteps& steps,
                                       const device::HandMapper& mapper);

}  // namespace handway::tools
