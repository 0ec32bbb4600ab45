#include "recordings/mano_recording.h"

#include "glove/finger_bending.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/lower_case.h"
#include "handway/geometric/io/plural.h"
#include "recordings/landmark_recording.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace handway::device {
namespace {

using geometric::InputError;

constexpr double kRateOfManoFrames = 30.0;  // Hz
constexpr Eigen::Index kManoAngles = 3 * kManoJoints;
constexpr Eigen::Index kManoWithWrist = kManoAngles + 3;
constexpr const char* kManoMean = "hands_mean";
constexpr const char* kManoComponents = "hands_components";

/// Form of the rotations in a variable.
enum class ManoForm { kNone, kRotationVectors, kMatrices, kCoefficients };

std::string lower_leaf(std::string_view name) {
  const std::string lower = geometric::lower_case(std::string(name));
  return lower.substr(lower.find_last_of("/.") + 1);
}

bool contains_any(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::ranges::any_of(
      words, [&](std::string_view word) { return text.find(word) != std::string_view::npos; });
}

// An array of one file without names, as of .npy.
bool is_unnamed(std::string_view name) { return name == "array"; }

bool is_called_coefficients(const std::string& leaf) {
  return contains_any(leaf, {"pca", "coef", "comps"}) && leaf != kManoComponents;
}

const RecordingVariable* find_leaf(const ArrayFile& arrays, std::string_view leaf) {
  const auto found = std::ranges::find_if(arrays.variables(), [&](const auto& variable) {
    return variable.problem.empty() && lower_leaf(variable.name) == leaf;
  });
  return found == arrays.variables().end() ? nullptr : &*found;
}

ManoForm form_of(const ArrayFile& arrays, const RecordingVariable& variable) {
  const std::string leaf = lower_leaf(variable.name);
  if (variable.type == kText || variable.shape.size() < 2 ||
      !(is_unnamed(leaf) || is_mano_name(leaf) || is_called_coefficients(leaf))) {
    return ManoForm::kNone;
  }
  std::vector<std::size_t> sides = variable.shape;
  sides.erase(sides.begin());
  std::erase(sides, std::size_t{1});
  const auto is = [&](std::initializer_list<std::size_t> shape) {
    return std::ranges::equal(sides, shape);
  };
  constexpr std::size_t kJoints = kManoJoints;
  const bool is_vectors =
      (sides.size() == 1 && is_mano_count(sides[0])) || is({kJoints, 3}) || is({kJoints + 1, 3});
  const bool has_components = find_leaf(arrays, kManoComponents) != nullptr;
  const bool is_short = sides.size() == 1 && sides[0] <= 3 * kJoints;
  if (is_short && !is_unnamed(leaf) &&
      (is_called_coefficients(leaf) || (has_components && !is_vectors))) {
    return ManoForm::kCoefficients;
  }
  if (is_called_coefficients(leaf)) {
    return ManoForm::kNone;
  }
  return is_vectors                                       ? ManoForm::kRotationVectors
         : is({kJoints, 3, 3}) || is({kJoints + 1, 3, 3}) ? ManoForm::kMatrices
                                                          : ManoForm::kNone;
}

// Rotation vectors of matrices, in rows of 9; NaN for other matrices than rotations.
Eigen::MatrixXd vectors_of_matrices(const Eigen::MatrixXd& rows) {
  constexpr double kFarthest = 1e-3;
  Eigen::MatrixXd vectors(rows.rows(), rows.cols() / 3);
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    for (Eigen::Index joint = 0; joint < rows.cols() / 9; ++joint) {
      Eigen::Matrix3d R;
      for (Eigen::Index i = 0; i < 9; ++i) {
        R(i / 3, i % 3) = rows(row, 9 * joint + i);
      }
      const bool is_rotation = R.allFinite() && R.determinant() > 0.0 &&
                               (R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < kFarthest;
      const Eigen::AngleAxisd turn(is_rotation ? R : Eigen::Matrix3d::Identity());
      vectors.row(row).segment<3>(3 * joint) =
          is_rotation ? Eigen::RowVector3d(turn.angle() * turn.axis().transpose())
                      : Eigen::RowVector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    }
  }
  return vectors;
}

Eigen::MatrixXd numbers_of(const ArrayFile& arrays, const RecordingVariable& variable) {
  return arrays.series(variable.name).values;
}

// The model's mean posture, shape [45]; nothing if the file does not have it.
std::optional<Eigen::RowVectorXd> mean_in(const ArrayFile& arrays) {
  const RecordingVariable* found = find_leaf(arrays, kManoMean);
  if (found == nullptr) {
    return std::nullopt;
  }
  const Eigen::MatrixXd read = numbers_of(arrays, *found);
  if (read.size() != kManoAngles) {
    throw InputError({arrays.path().string(), "variable " + found->name,
                      geometric::plural(read.size(), "number"), "the 45 angles of the mean posture",
                      ""});
  }
  return read.reshaped<Eigen::RowMajor>().transpose();
}

Eigen::MatrixXd angles_of_coefficients(const ArrayFile& arrays, const Series& series) {
  const RecordingVariable* components = find_leaf(arrays, kManoComponents);
  const std::optional<Eigen::RowVectorXd> mean = mean_in(arrays);
  const std::string element = "variable " + series.variable.name;
  if (components == nullptr || !mean) {
    throw InputError(
        {arrays.path().string(), element, "coefficients of principal components of MANO",
         fmt::format("the arrays {} and {} of the model beside them", kManoComponents, kManoMean),
         "The model's own file (MANO_RIGHT.pkl) is a pickle, which may run any program and is not "
         "read. Save its two arrays with yours by numpy.savez()."});
  }
  const Eigen::MatrixXd directions = numbers_of(arrays, *components);
  if (directions.cols() != kManoAngles || directions.rows() < series.values.cols()) {
    throw InputError({arrays.path().string(), "variable " + components->name,
                      to_string(*components),
                      fmt::format("a row of 45 angles for each of the {}",
                                  geometric::plural(series.values.cols(), "coefficient")),
                      ""});
  }
  return (series.values * directions.topRows(series.values.cols())).rowwise() + *mean;
}

// The angles of a variable, shape [rows, 45 or 48]; adds the mean posture if it is there.
Eigen::MatrixXd angles_of(const ArrayFile& arrays, const Series& series,
                          std::vector<std::string>& warnings) {
  const ManoForm form = form_of(arrays, series.variable);
  if (form == ManoForm::kCoefficients) {
    return angles_of_coefficients(arrays, series);
  }
  if (form == ManoForm::kMatrices) {
    return vectors_of_matrices(series.values);
  }
  Eigen::MatrixXd angles = series.values;
  const bool is_whole = contains_any(lower_leaf(series.variable.name), {"full"});
  if (const std::optional<Eigen::RowVectorXd> mean = is_whole ? std::nullopt : mean_in(arrays)) {
    angles.rightCols<kManoAngles>().rowwise() += *mean;
    warnings.push_back(fmt::format("{}: {} is added to {}", arrays.path().string(), kManoMean,
                                   series.variable.name));
  }
  return angles;
}

// The joints of the model's rest posture.
std::optional<ManoJoints> rest_in(const ArrayFile& arrays) {
  const RecordingVariable* found = find_leaf(arrays, "j");
  if (found == nullptr || found->shape != std::vector<std::size_t>{kManoJoints + 1, 3}) {
    return std::nullopt;
  }
  const ManoJoints joints = numbers_of(arrays, *found).transpose();
  try {
    static_cast<void>(palm_frame(mano_landmarks(ManoPose::Zero(), joints)));
  } catch (const std::invalid_argument&) {
    throw InputError({arrays.path().string(), "variable " + found->name,
                      "joints in a line, or a missing number", "the 16 joints of a hand at rest, m",
                      ""});
  }
  return joints;
}

void check_angles(const std::filesystem::path& file, const ManoPose& pose, std::size_t row) {
  constexpr double kMost = 2.0 * std::numbers::pi;
  for (Eigen::Index joint = 0; joint < pose.cols(); ++joint) {
    if (const double angle = pose.col(joint).norm(); angle > kMost) {
      throw InputError({file.string(), fmt::format("row {}, joint {}", row + 1, joint + 1),
                        fmt::format("a rotation by {:.4g}", angle),
                        "parameters of MANO: axis times angle in rad, a full turn at most", ""});
    }
  }
}

bool bends_as_left(const std::vector<ManoFrame>& frames) {
  double as_right = 0.0;
  double as_left = 0.0;
  for (const ManoFrame& frame : frames) {
    as_right += bending(mano_landmarks(frame.pose, usual_mano_joints(false)), false);
    as_left += bending(mano_landmarks(frame.pose, usual_mano_joints(true)), true);
  }
  return as_left > as_right;
}

bool is_left(const std::vector<ManoFrame>& frames, ManoSide side,
             const std::optional<ManoJoints>& rest) {
  if (rest) {
    return (*rest)(0, 1) > (*rest)(0, 0);  // knuckle of the index finger beyond the wrist
  }
  return side == ManoSide::kUnnamed ? bends_as_left(frames) : side == ManoSide::kLeft;
}

std::vector<double> times_of(const std::filesystem::path& file,
                             const std::vector<ManoFrame>& frames,
                             const geometric::TimeUnit& time_unit, Recording& recording) {
  const bool timed =
      std::ranges::all_of(frames, [](const ManoFrame& frame) { return frame.time.has_value(); });
  std::vector<double> times;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    times.push_back(timed ? *frames[i].time - *frames[0].time
                          : static_cast<double>(i) / kRateOfManoFrames);
  }
  if (!timed) {
    recording.warnings.push_back(fmt::format("{}: no times: {:g} frames a second are assumed",
                                             file.string(), kRateOfManoFrames));
    return times;
  }
  for (const std::string& warning : geometric::settle_times(times, time_unit)) {
    recording.warnings.push_back(fmt::format("{}: {}", file.string(), warning));
  }
  return times;
}

std::vector<ManoFrame> whole_frames(const std::filesystem::path& file,
                                    const std::vector<ManoFrame>& all, Recording& recording) {
  std::vector<ManoFrame> frames;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].pose.allFinite()) {
      check_angles(file, all[i].pose, i);
      frames.push_back(all[i]);
    }
  }
  if (frames.empty()) {
    throw InputError({file.string(), "", "no frame with all rotations", "parameters of MANO", ""});
  }
  if (frames.size() < all.size()) {
    recording.warnings.push_back(
        fmt::format("{}: {} of {} frames left out, they have gaps or no rotations", file.string(),
                    all.size() - frames.size(), all.size()));
  }
  return frames;
}

}  // namespace

ManoSide side_in_name(std::string_view name) {
  const std::string lower = geometric::lower_case(std::string(name));
  const bool left = contains_any(lower, {"left", "lhand", "lh_", "_lh", "_l_"});
  const bool right = contains_any(lower, {"right", "rhand", "rh_", "_rh", "_r_"});
  return left == right ? ManoSide::kUnnamed : left ? ManoSide::kLeft : ManoSide::kRight;
}

bool is_mano_name(std::string_view name) {
  return contains_any(lower_leaf(name), {"pose", "mano", "theta"});
}

bool is_mano_count(std::size_t count) {
  return count == static_cast<std::size_t>(kManoAngles) ||
         count == static_cast<std::size_t>(kManoWithWrist);
}

ManoPose mano_pose(std::span<const double> numbers) {
  return Eigen::Map<const ManoPose>(numbers.last(static_cast<std::size_t>(kManoAngles)).data());
}

Recording recording_of_mano(const std::filesystem::path& file, const std::vector<ManoFrame>& all,
                            ManoSide side, const std::optional<ManoJoints>& rest,
                            const geometric::TimeUnit& time_unit) {
  Recording recording;
  const std::vector<ManoFrame> frames = whole_frames(file, all, recording);
  const bool left = is_left(frames, side, rest);
  const ManoJoints joints = rest.value_or(usual_mano_joints(left));
  const std::vector<double> times = times_of(file, frames, time_unit, recording);
  recording.header = landmark_header(file);
  recording.header.device = "parameters of MANO";
  recording.times = Eigen::VectorXd::Map(times.data(), std::ssize(times));
  recording.values.resize(recording.times.size(), std::ssize(recording.header.sensors));
  for (Eigen::Index row = 0; row < recording.times.size(); ++row) {
    const HandLandmarks points = mano_landmarks(frames[static_cast<std::size_t>(row)].pose, joints);
    const std::vector<double> values = landmark_row(recording.header, points, left);
    recording.values.row(row) =
        Eigen::Map<const Eigen::RowVectorXd>(values.data(), recording.values.cols());
  }
  if (rest) {
    recording.bones = bones_of(mano_landmarks(ManoPose::Zero(), joints));
  }
  recording.warnings.push_back(fmt::format(
      "{}: taken for parameters of MANO of a {} hand{}", file.string(), left ? "left" : "right",
      !rest && side == ManoSide::kUnnamed ? ", as its fingers bend" : ""));
  return recording;
}

bool has_mano_poses(const ArrayFile& arrays, const RecordingVariable& variable) {
  return form_of(arrays, variable) != ManoForm::kNone;
}

Recording recording_of_mano(const ArrayFile& arrays, const Series& series) {
  std::vector<std::string> warnings = series.warnings;
  const Eigen::MatrixXd angles = angles_of(arrays, series, warnings);
  std::vector<ManoFrame> frames;
  for (Eigen::Index row = 0; row < angles.rows(); ++row) {
    const Eigen::VectorXd numbers = angles.row(row).transpose();
    ManoFrame& frame = frames.emplace_back();
    frame.pose = mano_pose({numbers.data(), static_cast<std::size_t>(numbers.size())});
    if (const auto index = static_cast<std::size_t>(row);
        index < series.times.size() && std::isfinite(series.times[index])) {
      frame.time = series.times[index];
    }
  }
  Recording recording = recording_of_mano(arrays.path(), frames, side_in_name(series.variable.name),
                                          rest_in(arrays), series.time_unit);
  recording.warnings.insert(recording.warnings.begin(), warnings.begin(), warnings.end());
  return recording;
}

}  // namespace handway::device
