#include "handway/geometric/setup/hand_eye.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/plural.h"
#include "handway/geometric/math/units.h"
#include "setup/robust_fit.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>

namespace handway::geometric {
namespace {

using Indices = std::vector<std::size_t>;

constexpr std::size_t kLeastMeasurements = 3;
constexpr std::size_t kMostPartners = 100;        // with which a measurement is compared
constexpr double kLeastTurn = 5.0 * kDegree;      // of the hand between two postures
constexpr double kLargestTurn = 170.0 * kDegree;  // beyond it the axis has two directions
constexpr double kLeastAxisSpread = 0.06;         // about 3.5° between axes
constexpr double kLeastWidth = 0.03;              // of points, as a share of their length
constexpr double kMostScale = 1.25;               // between the extents of points
constexpr double kLeastPositionOutlier = 1e-3;    // m

double angle_of(const Eigen::Matrix3d& R) { return Eigen::AngleAxisd(R).angle(); }

/// A rotation by its axis times its angle.
Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

/// Rotation nearest to a matrix.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& M) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d UVt = svd.matrixU() * svd.matrixV().transpose();
  const Eigen::Vector3d signs(1.0, 1.0, UVt.determinant() < 0.0 ? -1.0 : 1.0);
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

Pose inverse_of(const Pose& X) { return X.inverse(Eigen::Isometry); }

/// The two poses of a measurement: G X C is the same for all of them, for the wanted X.
struct PosePair {
  Pose G;
  Pose C;
};

/// Poses that all pairs agree on.
struct HandEyeModel {
  Pose X = Pose::Identity();
  Pose target = Pose::Identity();
};

/// Rotation of the hand and of the target between two measurements.
struct RelativeMotion {
  Eigen::Vector3d alpha;  ///< Of the hand, rad.
  Eigen::Vector3d beta;   ///< Of the target, rad.
  Pose A;
  Pose B;
};

std::vector<RelativeMotion> motions_between(const std::vector<PosePair>& pairs,
                                            const Indices& used) {
  std::vector<RelativeMotion> motions;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const std::size_t end = std::min(used.size(), i + 1 + kMostPartners);
    for (std::size_t j = i + 1; j < end; ++j) {
      const PosePair& first = pairs[used[i]];
      const PosePair& second = pairs[used[j]];
      RelativeMotion motion;
      motion.A = inverse_of(second.G) * first.G;
      motion.B = second.C * inverse_of(first.C);
      motion.alpha = rotation_vector(motion.A.linear());
      motion.beta = rotation_vector(motion.B.linear());
      if (motion.alpha.norm() < kLargestTurn && motion.beta.norm() < kLargestTurn) {
        motions.push_back(motion);
      }
    }
  }
  return motions;
}

/// How the axes of rotations are spread.
struct AxisSpread {
  double largest = 0.0;  ///< Largest rotation, rad.
  double share = 0.0;    ///< Of the second direction of axes in the first, 0 to 1.
};

AxisSpread spread_of(const std::vector<RelativeMotion>& motions) {
  AxisSpread spread;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const RelativeMotion& motion : motions) {
    spread.largest = std::max(spread.largest, motion.alpha.norm());
    moments += motion.alpha * motion.alpha.transpose();
  }
  const Eigen::Vector3d values =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments, Eigen::EigenvaluesOnly).eigenvalues();
  spread.share = values[2] > 0.0 ? std::sqrt(std::max(values[1], 0.0) / values[2]) : 0.0;
  return spread;
}

bool determines_camera(const AxisSpread& spread) {
  return spread.largest >= kLeastTurn && spread.share >= kLeastAxisSpread;
}

/// The target's mean pose.
Pose mean_target(const std::vector<PosePair>& pairs, const Indices& used, const Pose& X) {
  Eigen::Matrix3d rotations = Eigen::Matrix3d::Zero();
  Eigen::Vector3d positions = Eigen::Vector3d::Zero();
  for (const std::size_t i : used) {
    const Pose target = pairs[i].G * X * pairs[i].C;
    rotations += target.linear();
    positions += target.translation();
  }
  Pose mean = Pose::Identity();
  mean.linear() = nearest_rotation(rotations);
  mean.translation() = positions / static_cast<double>(used.size());
  return mean;
}

/// Solves AX = XB; nothing if the motions do not determine X.
std::optional<HandEyeModel> solve_hand_eye(const std::vector<PosePair>& pairs,
                                           const Indices& used) {
  const std::vector<RelativeMotion> motions = motions_between(pairs, used);
  if (!determines_camera(spread_of(motions))) {
    return std::nullopt;
  }
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
  for (const RelativeMotion& motion : motions) {
    M += motion.alpha * motion.beta.transpose();
  }
  HandEyeModel model;
  model.X.linear() = nearest_rotation(M);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const RelativeMotion& motion : motions) {
    const Eigen::Matrix3d C = motion.A.linear() - Eigen::Matrix3d::Identity();
    normal += C.transpose() * C;
    right += C.transpose() * (model.X.linear() * motion.B.translation() - motion.A.translation());
  }
  model.X.translation() = normal.ldlt().solve(right);
  model.target = mean_target(pairs, used, model.X);
  return model.X.translation().allFinite() ? std::optional(model) : std::nullopt;
}

Deviation deviation_of(const PosePair& pair, const HandEyeModel& model) {
  const Pose target = pair.G * model.X * pair.C;
  return {(target.translation() - model.target.translation()).norm(),
          angle_of(model.target.linear().transpose() * target.linear())};
}

[[noreturn]] void refuse_count(std::size_t count, const char* what, const std::string& source) {
  throw InputError({source, "", plural(count, what), fmt::format("{} or more", kLeastMeasurements),
                    "Ten, spread over the workspace, give a good calibration."});
}

/// @throws InputError with the reason why motions do not determine the camera.
[[noreturn]] void refuse_motions(const AxisSpread& spread, const std::string& source) {
  constexpr const char* kAdvice =
      "Turn the hand by 20° or more between postures, about two axes that are far from parallel.";
  if (spread.largest < kLeastTurn) {
    throw InputError({source, "",
                      fmt::format("a hand that turns by {:.2g}° at most", spread.largest / kDegree),
                      fmt::format("turns of {:.0f}° or more", kLeastTurn / kDegree), kAdvice});
  }
  throw InputError({source, "", "turns of the hand about parallel axes",
                    "turns about two axes that differ in direction", kAdvice});
}

/// Fills in residuals and their means.
/// @param place returns the name of a measurement.
template <typename Fit, typename Place>
CameraCalibration calibration_of(const Fit& fit, const Place& place) {
  CameraCalibration calibration;
  for (std::size_t i = 0; i < fit.deviations.size(); ++i) {
    const Deviation& deviation = fit.deviations[i];
    const bool is_used = std::ranges::binary_search(fit.used, i);
    calibration.residuals.push_back({place(i), deviation.position, deviation.angle, !is_used});
    if (is_used) {
      calibration.rms_position += deviation.position * deviation.position;
      calibration.rms_angle += deviation.angle * deviation.angle;
      ++calibration.used;
    }
  }
  calibration.rms_position = std::sqrt(calibration.rms_position / calibration.used);
  calibration.rms_angle = std::sqrt(calibration.rms_angle / calibration.used);
  return calibration;
}

/// Typical distance of the target from the camera, m: a turn by an angle moves it so far.
double lever_of(const std::vector<PosePair>& pairs) {
  std::vector<double> distances;
  distances.reserve(pairs.size());
  for (const PosePair& pair : pairs) {
    distances.push_back(pair.C.translation().norm());
  }
  return median_of(distances);
}

}  // namespace

CameraCalibration calibrate_hand_eye(std::span<const HandEyePair> pairs, CameraMount mount,
                                     const CameraCalibrationSettings& settings) {
  if (pairs.size() < kLeastMeasurements) {
    refuse_count(pairs.size(), "pose pair", settings.source);
  }
  std::vector<PosePair> poses;
  for (const HandEyePair& pair : pairs) {
    poses.push_back({mount == CameraMount::kOnHand ? pair.X_BH : inverse_of(pair.X_BH), pair.X_CT});
  }
  const auto solve = [&](const Indices& used) { return solve_hand_eye(poses, used); };
  const auto deviation = [&](const HandEyeModel& model, std::size_t i) {
    return deviation_of(poses[i], model);
  };
  const auto fit = robust_fit<HandEyeModel>(
      pairs.size(), solve, deviation,
      {lever_of(poses), kLeastPositionOutlier, settings.leaves_out_outliers});
  if (!fit) {
    Indices all(pairs.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    refuse_motions(spread_of(motions_between(poses, all)), settings.source);
  }
  CameraCalibration calibration =
      calibration_of(*fit, [&](std::size_t i) { return pairs[i].place; });
  calibration.X_AC = fit->model.X;
  calibration.X_target = fit->model.target;
  return calibration;
}

namespace {

/// Extents of points about their mean, m: along, across and out of the plane in which they lie.
Eigen::Vector3d extents_of(const Eigen::Matrix3Xd& points) {
  const Eigen::Matrix3Xd centred = points.colwise() - points.rowwise().mean().eval();
  const Eigen::Matrix3d moments =
      centred * centred.transpose() / static_cast<double>(points.cols());
  const Eigen::Vector3d values =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments, Eigen::EigenvaluesOnly).eigenvalues();
  return values.reverse().cwiseMax(0.0).cwiseSqrt();
}

bool lie_on_a_line(const Eigen::Vector3d& extents) {
  return !(extents[0] > 0.0) || extents[1] < kLeastWidth * extents[0];
}

Eigen::Matrix3Xd columns_of(const Eigen::Matrix3Xd& points, const Indices& used) {
  Eigen::Matrix3Xd some(3, static_cast<Eigen::Index>(used.size()));
  for (std::size_t i = 0; i < used.size(); ++i) {
    some.col(static_cast<Eigen::Index>(i)) = points.col(static_cast<Eigen::Index>(used[i]));
  }
  return some;
}

/// Points of the robot and of the camera, a column each.
struct PointSets {
  Eigen::Matrix3Xd of_robot;
  Eigen::Matrix3Xd of_camera;
};

std::optional<Pose> solve_points(const PointSets& points, const Indices& used) {
  const Eigen::Matrix3Xd of_robot = columns_of(points.of_robot, used);
  const Eigen::Matrix3Xd of_camera = columns_of(points.of_camera, used);
  if (lie_on_a_line(extents_of(of_robot)) || lie_on_a_line(extents_of(of_camera))) {
    return std::nullopt;
  }
  return Pose(Eigen::umeyama(of_camera, of_robot, false));
}

/// @throws InputError if the points cannot determine a pose.
void check_points(const PointSets& points, const std::string& source) {
  const Eigen::Vector3d robot = extents_of(points.of_robot);
  const Eigen::Vector3d camera = extents_of(points.of_camera);
  if (lie_on_a_line(robot) || lie_on_a_line(camera)) {
    throw InputError({source, "", "points that lie on a line", "points that span a plane",
                      "Touch points at the corners of the workspace, at different heights."});
  }
  const double scale = camera.norm() / robot.norm();
  if (scale > kMostScale || scale < 1.0 / kMostScale) {
    throw InputError({source, "",
                      fmt::format("points of the camera that are {:.4g} times as far apart as "
                                  "those of the robot",
                                  scale),
                      "equal distances", "Give both in metres, in the same order."});
  }
}

}  // namespace

CameraCalibration calibrate_camera_by_points(std::span<const TouchedPoint> points,
                                             const CameraCalibrationSettings& settings) {
  if (points.size() < kLeastMeasurements) {
    refuse_count(points.size(), "point", settings.source);
  }
  const auto count = static_cast<Eigen::Index>(points.size());
  PointSets sets{Eigen::Matrix3Xd(3, count), Eigen::Matrix3Xd(3, count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    sets.of_robot.col(i) = points[static_cast<std::size_t>(i)].p_A;
    sets.of_camera.col(i) = points[static_cast<std::size_t>(i)].p_C;
  }
  const auto solve = [&](const Indices& used) { return solve_points(sets, used); };
  const auto deviation = [&](const Pose& X, std::size_t i) {
    return Deviation{(points[i].p_A - X * points[i].p_C).norm(), 0.0};
  };
  const auto fit = robust_fit<Pose>(points.size(), solve, deviation,
                                    {0.0, kLeastPositionOutlier, settings.leaves_out_outliers});
  if (!fit) {
    check_points(sets, settings.source);
    throw InputError({settings.source, "", "points that lie on a line but for outliers",
                      "points that span a plane", "Touch more points."});
  }
  check_points({columns_of(sets.of_robot, fit->used), columns_of(sets.of_camera, fit->used)},
               settings.source);
  CameraCalibration calibration =
      calibration_of(*fit, [&](std::size_t i) { return points[i].place; });
  calibration.X_AC = fit->model;
  return calibration;
}

}  // namespace handway::geometric
