#pragma once

#include "glove/text_files.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/glove/recording.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Landmarks in files of scripts with MediaPipe and other hand trackers: tables with a column for
/// every coordinate, and JSON of any nesting.

namespace handway::device {

/// A hand in one frame, in the writer's units and frame of reference.
struct SeenHand {
  std::optional<double> time;  ///< s.
  HandLandmarks points;
};

/// A column (from 0) for each coordinate: x, y and z of the wrist, then of the next landmark.
using LandmarkColumns = std::array<std::size_t, 63>;

/// The columns of 21 landmarks by the names of a header ("x0", "12_y", "INDEX_FINGER_TIP_z",
/// "landmark_3_x"); of two hands those of the first. Nothing if some are missing.
[[nodiscard]] std::optional<LandmarkColumns> landmark_columns(
    const std::vector<std::string>& names);

/// Header for the angles between landmarks of a hand in a file.
[[nodiscard]] RecordingHeader landmark_header(const std::filesystem::path& file);

/// A row of such a recording: rad, shape [header.sensors].
[[nodiscard]] std::vector<double> landmark_row(const RecordingHeader& header,
                                               const HandLandmarks& points, bool left);

/// A recording of the angles between landmarks. Coordinates within a picture are taken for those of
/// a picture of 4:3 or in pixels; other units than metres are scaled to a hand of usual size. A
/// left hand is recognized by the direction in which its fingers bend. Frames without a hand are
/// left out, and those without times 1/30 s apart. Warnings report all that.
/// @throws InputError if no frame has a hand.
[[nodiscard]] Recording recording_of_hands(const std::filesystem::path& file,
                                           const std::vector<SeenHand>& hands);

/// Returns whether a text is JSON but not of Handway's own landmark lines.
[[nodiscard]] bool is_landmark_document(std::string_view text);

/// Every array of 21 points in a JSON document, or in lines of JSON, is a hand: the first of each
/// frame, of its world landmarks if there are some. Times are values of keys with such a name
/// beside or around it.
/// @throws InputError if it is not JSON, or has no hand.
[[nodiscard]] Recording read_landmark_document(const std::filesystem::path& file,
                                               std::string_view text,
                                               const std::vector<TextLine>& lines);

}  // namespace handway::device
