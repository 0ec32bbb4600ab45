#include "mapped_recording.h"

#include "handway/device/glove/recording_filters.h"

#include <limits>

namespace handway::tools {

MappedRecording map_file(const std::filesystem::path& file,
                         const device::GloveCalibration& calibration, const RecordingSteps& steps,
                         const device::HandMapper& mapper) {
  MappedRecording result;
  result.file = file;
  device::Recording recording = device::read_recording(file);
  result.quality = device::assess(recording);
  result.calibrated = recording.header.kind == device::RecordingKind::kCounts;
  recording = device::to_angles(recording, calibration);
  if (steps.from > 0.0 || steps.to) {
    const double begin = recording.times[0];
    const double end = steps.to.value_or(std::numeric_limits<double>::infinity());
    recording = device::trimmed(recording, begin + steps.from, begin + end);
  }
  if (steps.drop_duplicates) {
    recording = device::without_duplicates(recording);
  }
  if (steps.resample > 0.0) {
    recording = device::resampled(recording, steps.resample);
  }
  if (steps.low_pass > 0.0) {
    recording = device::low_passed(recording, steps.low_pass);
  }
  result.mapped = mapper.map_recording(recording);
  result.recording = std::move(recording);
  return result;
}

}  // namespace handway::tools
