#pragma once

#include "handway/device/glove/human_hand.h"
#include "handway/device/glove/recording.h"
#include "handway/geometric/io/table_times.h"

#include <filesystem>
#include <optional>
#include <vector>

/// Recordings of the landmarks that scripts with MediaPipe and other hand trackers write.

namespace handway::device {

/// A hand in one frame, in the writer's units and frame of reference.
struct SeenHand {
  std::optional<double> time;  ///< Time in the file's unit.
  HandLandmarks points;
  Eigen::Index row = -1;  ///< Row of the source's columns, if there are some.
};

/// Header for the angles between landmarks of a hand in a file.
[[nodiscard]] RecordingHeader landmark_header(const std::filesystem::path& file);

/// A row of such a recording: rad, shape [header.sensors].
[[nodiscard]] std::vector<double> landmark_row(const RecordingHeader& header,
                                               const HandLandmarks& points, bool left);

/// A recording of the angles between landmarks. Coordinates within a picture are taken for those of
/// a picture of 4:3 or in pixels; other units than metres are scaled to a hand of usual size. A
/// left hand is recognized by the direction in which its fingers bend. Frames without a hand are
/// left out, and those without times 1/30 s apart. Warnings report all that.
/// @param time_unit of the times, for settle_times().
/// @param source columns of the file, a row for each SeenHand::row; nothing: the recording keeps
/// the coordinates.
/// @throws InputError if no frame has a hand.
[[nodiscard]] Recording recording_of_hands(const std::filesystem::path& file,
                                           const std::vector<SeenHand>& hands,
                                           const geometric::TimeUnit& time_unit = {},
                                           const std::optional<RawColumns>& source = {});

}  // namespace handway::device
