#include "glove/recording_player.h"

#include "handway/geometric/io/input_error.h"
#include "recording_player.h"

#include <algorithm>

namespace handway::device {
RecordingPlayer::RecordingPlayer(const Recording& recording, const GloveCalibration& calibration) {
  const Eigen::Index rows = recording.times.size();
  if (rows == 0) {
    throw geometric::InputError(
        {"recording", "", "no rows", "at least one frame", "Record it again."});
  }
  const SensorIndices& sensors = recording.header.sensors;
  frames_.resize(static_cast<std::size_t>(rows));
  for (Eigen::Index row = 0; row < rows; ++row) {
    GloveFrame& frame = frames_[static_cast<std::size_t>(row)];
    frame.time = recording.times[row] - recording.times[0];
    if (recording.header.kind == RecordingKind::kAngles) {
      frame.angles = angles_of_row(recording, row).angles;
    }
    for (std::size_t column = 0; column < sensors.size(); ++column) {
      const double value = recording.values(row, static_cast<Eigen::Index>(column));
      const auto sensor = static_cast<std::size_t>(sensors[column]);
      frame.counts[sensor] = to_count(recording.header.kind == RecordingKind::kCounts
                                          ? value
                                          : counts_of(calibration.sensors[sensor], value));
    }
  }
  if (rows > 1 && frames_.back().time > 0.0) {
    period_ = frames_.back().time / static_cast<double>(rows - 1);
  }
}

const GloveFrame& RecordingPlayer::frame_at(double time) const {
  const auto after = std::ranges::upper_bound(frames_, time, {}, &GloveFrame::time);
  return after == frames_.begin() ? frames_.front() : *(after - 1);
}

}  // namespace handway::device
