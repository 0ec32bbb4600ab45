#include "recordings/hand_rows.h"

#include "glove/finger_bending.h"
#include "handway/device/core/line_protocol.h"
#include "handway/device/glove/hand_message.h"
#include "handway/device/glove/human_hand.h"
#include "handway/geometric/io/input_error.h"
#include "recordings/landmark_recording.h"
#include "recordings/recorded_rows.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace handway::device {
namespace {

/// A hand in a line of a file.
struct HandRow {
  TextLine line;
  HandObservation hand;
};

HandMessage read_row(const std::filesystem::path& file, const TextLine& line) {
  try {
    HandMessage row = read_hand_message(trimmed(line.text));
    for (const HandObservation& hand : row.hands) {
      if (!hand.time) {
        throw LineProtocolError("no key \"time\"");
      }
    }
    return row;
  } catch (const LineProtocolError& error) {
    throw geometric::InputError(
        {at_line(file, line), "", error.what(), "a row of a hand",
         "A row is {\"time\": s, \"hand\": \"right\", \"landmarks\": 21 points in m}, or a message "
         "of OpenXR, Rokoko or Manus with its time."});
  }
}

std::string_view side_name(bool left) { return left ? "left" : "right"; }

/// Collects the hand that is seen first.
class FollowedHand {
 public:
  void take(const TextLine& line, const HandMessage& message) {
    bool is_there = false;
    bool is_other = false;
    for (const HandObservation& hand : message.hands) {
      if (!hand.is_seen()) {
        continue;
      }
      left_ = left_.value_or(hand.left);
      if (rows_.empty()) {
        raw_ = raw_columns_of(message.wire, hand.left);
      }
      if (hand.left == *left_) {
        rows_.push_back({line, hand});
        is_there = true;
      } else {
        is_other = true;
      }
    }
    others_ += is_other && !is_there ? 1 : 0;
  }

  [[nodiscard]] bool left() const { return left_.value_or(false); }
  [[nodiscard]] int others() const { return others_; }
  [[nodiscard]] const std::vector<HandRow>& rows() const { return rows_; }
  [[nodiscard]] const RawColumns& raw_columns() const { return raw_; }
  /// The numbers of a hand as they were sent; NaN in messages of another format than the first.
  [[nodiscard]] std::vector<double> raw_of(const HandObservation& hand) const {
    return hand.raw.size() == raw_.names.size()
               ? hand.raw
               : std::vector<double>(raw_.names.size(), std::numeric_limits<double>::quiet_NaN());
  }

 private:
  std::vector<HandRow> rows_;
  RawColumns raw_;
  std::optional<bool> left_;
  int others_ = 0;  ///< Rows of the other hand alone.
};

/// Returns the side of a hand by the bending of its fingers.
bool side_by_bending(const FollowedHand& followed) {
  constexpr double kClearly = 0.3;  // rad, of all fingers together
  double as_labelled = 0.0;
  double as_other = 0.0;
  for (const HandRow& row : followed.rows()) {
    if (row.hand.landmarks) {
      as_labelled += bending(*row.hand.landmarks, followed.left());
      as_other += bending(*row.hand.landmarks, !followed.left());
    }
  }
  const bool is_swapped =
      as_other - as_labelled > kClearly * static_cast<double>(followed.rows().size());
  return followed.left() != is_swapped;
}

std::vector<double> row_of(const RecordingHeader& header, const HandObservation& hand, bool left) {
  if (hand.landmarks) {
    return landmark_row(header, *hand.landmarks, left);
  }
  std::vector<double> values;
  for (const int sensor : header.sensors) {
    values.push_back(hand.angles->at(static_cast<std::size_t>(sensor)));
  }
  return values;
}

}  // namespace

Recording recording_of_hand_lines(const std::filesystem::path& file,
                                  const std::vector<TextLine>& lines) {
  Recording recording;
  recording.header = landmark_header(file);
  FollowedHand followed;
  const auto is_row = [](const TextLine& line) { return nlohmann::json::accept(line.text); };
  take_rows(file, lines, recording.warnings, is_row,
            [&](const TextLine& line) { followed.take(line, read_row(file, line)); });
  if (followed.others() > 0) {
    recording.warnings.push_back(fmt::format(
        "{}: {} rows of the {} hand left out, the first is of the {} one", file.string(),
        followed.others(), side_name(!followed.left()), side_name(followed.left())));
  }
  const bool left = side_by_bending(followed);
  if (left != followed.left()) {
    recording.warnings.push_back(fmt::format(
        "{}: labelled as a {} hand, but taken for a {} one: its fingers would bend backwards",
        file.string(), side_name(!left), side_name(left)));
  }
  RecordedRows rows(file, recording.header.sensors.size(), followed.raw_columns());
  std::vector<HandBones> bones;
  for (const HandRow& row : followed.rows()) {
    if (row.hand.landmarks) {
      bones.push_back(bones_of(*row.hand.landmarks));
    }
    rows.add(row.line, *row.hand.time, row_of(recording.header, row.hand, left),
             followed.raw_of(row.hand));
  }
  rows.move_to(recording);
  if (!bones.empty()) {
    recording.bones = median_bones(bones);
  }
  return recording;
}

}  // namespace handway::device
