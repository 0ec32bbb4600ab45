#include "recordings/landmark_recording.h"

#include "glove/finger_bending.h"
#include "handway/device/glove/hand_message.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/table_times.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <stdexcept>
#include <string>

namespace handway::device {
namespace {

using geometric::InputError;

constexpr double kRateOfCameras = 30.0;  // Hz
constexpr double kUsualPicture = 4.0 / 3.0;
constexpr double kShortestPalm = 0.05;  // m, from the wrist to the knuckle of the middle finger
constexpr double kLongestPalm = 0.14;

bool is_hand(const HandLandmarks& points) {
  if (!points.allFinite()) {
    return false;
  }
  try {
    static_cast<void>(palm_frame(points));
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

double palm_length(const HandLandmarks& points) {
  return (points.col(base_landmark(Finger::kMiddle)) - points.col(kWristLandmark)).norm();
}

// World landmarks are around the middle of the hand or relative to its wrist, or have distances
// from a camera. In a picture only points estimated beyond its edge are negative, and depth is
// relative to the wrist.
bool is_in_picture(const HandLandmarks& points) {
  constexpr double kNone = 0.05;  // of the length of the palm
  const auto across = points.topRows<2>();
  const auto wrist = points.col(kWristLandmark);
  const double palm = palm_length(points);
  return across.minCoeff() > -0.25 * (across.maxCoeff() - across.minCoeff()) &&
         std::abs(wrist.z()) < palm && wrist.head<2>().norm() > kNone * palm;
}

// Converts coordinates of a picture or of another unit to metres.
// @returns the unit inferred; empty for metres.
std::string settle_units(std::vector<SeenHand>& hands) {
  const auto in_picture =
      std::ranges::count_if(hands, [](const SeenHand& hand) { return is_in_picture(hand.points); });
  double most = 0.0;
  for (const SeenHand& hand : hands) {
    most = std::max(most, hand.points.lpNorm<Eigen::Infinity>());
  }
  const bool picture = 2 * in_picture > std::ssize(hands);
  const bool shares = picture && most < 3.0;
  std::vector<double> palms;
  for (SeenHand& hand : hands) {
    if (shares) {  // z has the scale of x
      hand.points.row(0) *= kUsualPicture;
      hand.points.row(2) *= kUsualPicture;
    }
    palms.push_back(palm_length(hand.points));
  }
  const double palm = median(palms);
  if (!picture && palm >= kShortestPalm && palm <= kLongestPalm) {
    return "";
  }
  if (const double metres = geometric::metres(palm);
      !picture && metres >= kShortestPalm && metres <= kLongestPalm) {
    for (SeenHand& hand : hands) {
      hand.points *= geometric::kMillimetre;
    }
    return "mm";
  }
  const HandLandmarks typical = hand_landmarks(GloveAngles{});
  const double usual = typical.col(base_landmark(Finger::kMiddle)).norm();
  for (SeenHand& hand : hands) {
    hand.points *= usual / palm;
  }
  return fmt::format("{}, scaled to a hand of usual size", shares ? "shares of a picture of 4:3"
                                                           : picture
                                                               ? "pixels"
                                                               : "coordinates that are no metres");
}

RawColumns rows_of_hands(const RawColumns& source, const std::vector<SeenHand>& hands) {
  std::vector<Eigen::Index> rows;
  std::ranges::transform(hands, std::back_inserter(rows), &SeenHand::row);
  return rows_of(source, rows);
}

/// The coordinates of hands in the unit of the file.
RawColumns coordinates_of(const std::vector<SeenHand>& hands) {
  RawColumns columns = raw_columns_of(HandWire::kLandmarks, false);
  std::ranges::fill(columns.units, "");  // not known
  columns.values.resize(std::ssize(hands), std::ssize(columns.names));
  for (Eigen::Index row = 0; row < columns.values.rows(); ++row) {
    columns.values.row(row) = hands[static_cast<std::size_t>(row)].points.reshaped().transpose();
  }
  return columns;
}

// Fingers bend towards the palm: for the wrong hand they would bend backwards.
bool is_left(const std::vector<SeenHand>& hands) {
  double as_right = 0.0;
  double as_left = 0.0;
  for (const SeenHand& hand : hands) {
    as_right += bending(hand.points, false);
    as_left += bending(hand.points, true);
  }
  return as_left > as_right;
}

}  // namespace

RecordingHeader landmark_header(const std::filesystem::path& file) {
  RecordingHeader header;
  header.kind = RecordingKind::kAngles;
  header.device = "landmarks of a hand";
  header.origin = file.filename().string();
  header.sensors = landmark_sensors();
  return header;
}

std::vector<double> landmark_row(const RecordingHeader& header, const HandLandmarks& points,
                                 bool left) {
  const GloveAngles angles = glove_angles(in_palm_frame(points, left));
  std::vector<double> row;
  for (const int sensor : header.sensors) {
    row.push_back(angles.angles.at(static_cast<std::size_t>(sensor)));
  }
  return row;
}

Recording recording_of_hands(const std::filesystem::path& file, const std::vector<SeenHand>& all,
                             const geometric::TimeUnit& time_unit,
                             const std::optional<RawColumns>& source) {
  std::vector<SeenHand> hands;
  std::ranges::copy_if(all, std::back_inserter(hands), is_hand, &SeenHand::points);
  if (hands.empty()) {
    throw InputError({file.string(), "", "no hand", "21 landmarks of one with x, y and z", ""});
  }
  Recording recording;
  if (hands.size() < all.size()) {
    recording.warnings.push_back(fmt::format("{}: {} of {} frames left out, they have no hand",
                                             file.string(), all.size() - hands.size(), all.size()));
  }
  recording.raw = source ? rows_of_hands(*source, hands) : coordinates_of(hands);
  const std::string unit = settle_units(hands);
  const bool left = is_left(hands);
  const bool timed = std::ranges::all_of(hands, [](const SeenHand& hand) { return !!hand.time; });
  std::vector<double> times;
  for (std::size_t i = 0; i < hands.size(); ++i) {
    times.push_back(timed ? *hands[i].time - *hands[0].time
                          : static_cast<double>(i) / kRateOfCameras);
  }
  if (timed) {
    for (const std::string& warning : geometric::settle_times(times, time_unit)) {
      recording.warnings.push_back(fmt::format("{}: {}", file.string(), warning));
    }
  }
  recording.header = landmark_header(file);
  recording.times.resize(std::ssize(hands));
  recording.values.resize(std::ssize(hands), std::ssize(recording.header.sensors));
  std::vector<HandBones> bones;
  for (Eigen::Index row = 0; row < recording.times.size(); ++row) {
    const SeenHand& hand = hands[static_cast<std::size_t>(row)];
    recording.times[row] = times[static_cast<std::size_t>(row)];
    const std::vector<double> values = landmark_row(recording.header, hand.points, left);
    recording.values.row(row) =
        Eigen::Map<const Eigen::RowVectorXd>(values.data(), recording.values.cols());
    bones.push_back(bones_of(hand.points));
  }
  recording.bones = median_bones(bones);
  recording.warnings.push_back(
      fmt::format("{}: taken for landmarks of a {} hand, as its fingers bend{}{}{}", file.string(),
                  left ? "left" : "right", unit.empty() ? "" : ", in ", unit,
                  timed ? "" : fmt::format(", {:g} frames a second", kRateOfCameras)));
  return recording;
}

}  // namespace handway::device
