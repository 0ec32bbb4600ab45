#include "handway/geometric/formats/camera_measurements.h"

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/table_text.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/math/units.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string_view>

namespace handway::geometric {
namespace {

constexpr double kFarthest = 20.0;  // m; larger numbers are in mm
constexpr const char* kWhatMeasurements = "measurements of a camera";
constexpr std::size_t kLargestTable = std::size_t{16} << 20;

/// Text that names an element of a file, for messages.
struct Place {
  std::string where;    ///< "pairs.csv:7".
  std::string element;  ///< "hand".
};

Eigen::Vector3d checked_position(const Eigen::Vector3d& position, const Place& place) {
  if (!(position.norm() <= kFarthest)) {
    throw InputError({place.where, place.element,
                      fmt::format("a position {:.4g} from its origin", position.norm()),
                      fmt::format("metres, {:.0f} at most", kFarthest), ""});
  }
  return position;
}

Eigen::Matrix3d rotation_of_quaternion(const Eigen::Vector4d& xyzw, const Place& place) {
  constexpr double kTolerance = 1e-2;
  if (!(std::abs(xyzw.norm() - 1.0) <= kTolerance)) {
    throw InputError({place.where, place.element,
                      fmt::format("a quaternion of length {:.4g}", xyzw.norm()),
                      "x, y, z, w of length 1", ""});
  }
  return Eigen::Quaterniond(xyzw).normalized().toRotationMatrix();
}

Eigen::Matrix3d rotation_of_degrees(const Eigen::Vector3d& rpy) {
  return pose_from_rpy(Eigen::Vector3d::Zero(), radians(rpy.x()), radians(rpy.y()),
                       radians(rpy.z()))
      .linear();
}

Pose pose_of_element(const YamlElement& element) {
  element.allow_keys({"xyz", "rpy_deg", "quaternion", "rotation_vector"});
  const Place place{element.where(), element.name()};
  Pose X = Pose::Identity();
  X.translation() = checked_position(element.need("xyz").numbers(3), place);
  const auto rpy = element.find("rpy_deg");
  const auto quaternion = element.find("quaternion");
  const auto vector = element.find("rotation_vector");
  if ((rpy ? 1 : 0) + (quaternion ? 1 : 0) + (vector ? 1 : 0) != 1) {
    element.refuse(element.found(),
                   "xyz, and one of rpy_deg, quaternion (x, y, z, w) and rotation_vector (rad)");
  }
  if (rpy) {
    X.linear() = rotation_of_degrees(rpy->numbers(3));
  } else if (quaternion) {
    X.linear() = rotation_of_quaternion(quaternion->numbers(4), place);
  } else {
    X.linear() = turn_from_rotation_vector(vector->numbers(3)).toRotationMatrix();
  }
  return X;
}

std::optional<CameraMount> mount_of(const YamlElement& top) {
  const auto camera = top.find("camera");
  if (!camera) {
    return std::nullopt;
  }
  const std::string name = camera->text();
  if (name != "hand" && name != "fixed") {
    camera->refuse(camera->found(), "hand or fixed");
  }
  return name == "hand" ? CameraMount::kOnHand : CameraMount::kFixed;
}

CameraMeasurements read_yaml_measurements(const std::filesystem::path& file) {
  const YamlElement top = YamlElement::read(file, kWhatMeasurements);
  top.allow_keys({"camera", "pairs", "points"});
  CameraMeasurements measurements;
  measurements.mount = mount_of(top);
  for (const YamlElement& pair : top.items_of("pairs")) {
    pair.allow_keys({"hand", "target"});
    measurements.pairs.push_back(
        {pose_of_element(pair.need("hand")), pose_of_element(pair.need("target")), pair.where()});
  }
  for (const YamlElement& point : top.items_of("points")) {
    point.allow_keys({"robot", "camera"});
    const Place place{point.where(), point.name()};
    measurements.points.push_back({checked_position(point.need("robot").numbers(3), place),
                                   checked_position(point.need("camera").numbers(3), place),
                                   point.where()});
  }
  return measurements;
}

/// The columns of a table by their names, and the values of one row.
class TableRow {
 public:
  explicit TableRow(const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      columns_[names[i]] = i;
    }
  }

  void set(std::string where, const std::vector<std::string_view>& cells) {
    where_ = std::move(where);
    cells_ = cells;
  }
  [[nodiscard]] const std::string& where() const { return where_; }

  /// Returns whether the table has a column for each part of a name.
  template <std::size_t Count>
  [[nodiscard]] bool has(const std::string& name,
                         const std::array<const char*, Count>& parts) const {
    return std::ranges::all_of(
        parts, [&](const char* part) { return columns_.contains(name + "_" + part); });
  }

  /// @pre has(name, parts).
  template <std::size_t Count>
  [[nodiscard]] Eigen::Matrix<double, static_cast<int>(Count), 1> numbers(
      const std::string& name, const std::array<const char*, Count>& parts) const {
    Eigen::Matrix<double, static_cast<int>(Count), 1> values;
    for (std::size_t i = 0; i < Count; ++i) {
      const std::string column = name + "_" + parts.at(i);
      const std::string_view cell = cells_.at(columns_.at(column));
      const std::optional<double> value = parse_cell(cell);
      if (!value) {
        throw InputError(
            {where_, "column " + column, fmt::format("\"{:.40}\"", cell), "a finite number", ""});
      }
      values[static_cast<Eigen::Index>(i)] = *value;
    }
    return values;
  }

 private:
  std::map<std::string, std::size_t> columns_;
  std::vector<std::string_view> cells_;
  std::string where_;
};

constexpr std::array kPositionParts{"x", "y", "z"};
constexpr std::array kAngleParts{"roll_deg", "pitch_deg", "yaw_deg"};
constexpr std::array kQuaternionParts{"qx", "qy", "qz", "qw"};
constexpr std::array kVectorParts{"rx", "ry", "rz"};

bool has_pose(const TableRow& row, const std::string& name) {
  return row.has(name, kPositionParts) &&
         (row.has(name, kAngleParts) || row.has(name, kQuaternionParts) ||
          row.has(name, kVectorParts));
}

Pose pose_of_row(const TableRow& row, const std::string& name) {
  const Place place{row.where(), name};
  Pose X = Pose::Identity();
  X.translation() = checked_position(row.numbers(name, kPositionParts), place);
  if (row.has(name, kAngleParts)) {
    X.linear() = rotation_of_degrees(row.numbers(name, kAngleParts));
  } else if (row.has(name, kQuaternionParts)) {
    X.linear() = rotation_of_quaternion(row.numbers(name, kQuaternionParts), place);
  } else {
    X.linear() = turn_from_rotation_vector(row.numbers(name, kVectorParts)).toRotationMatrix();
  }
  return X;
}

void take_row(const TableRow& row, CameraMeasurements& measurements) {
  if (has_pose(row, "hand") && has_pose(row, "target")) {
    measurements.pairs.push_back(
        {pose_of_row(row, "hand"), pose_of_row(row, "target"), row.where()});
  } else if (row.has("robot", kPositionParts) && row.has("camera", kPositionParts)) {
    measurements.points.push_back(
        {checked_position(row.numbers("robot", kPositionParts), {row.where(), "robot"}),
         checked_position(row.numbers("camera", kPositionParts), {row.where(), "camera"}),
         row.where()});
  } else {
    throw InputError({row.where(), "", "a table without the columns of poses or points",
                      "hand_x, hand_y, hand_z with hand_roll_deg, hand_pitch_deg, hand_yaw_deg, "
                      "or hand_qx to hand_qw, or hand_rx, hand_ry, hand_rz, and target_… alike; or "
                      "robot_x, robot_y, robot_z, camera_x, camera_y, camera_z",
                      "Name them in the first line."});
  }
}

CameraMeasurements read_table_measurements(const std::filesystem::path& file) {
  const std::string text = read_text_file(file, kWhatMeasurements, kLargestTable);
  CameraMeasurements measurements;
  std::optional<TableRow> row;
  char separator = ',';
  std::size_t columns = 0;
  for (const TextLine& line : text_lines(text)) {
    const std::string_view content = trimmed(line.text);
    if (content.empty() || content.starts_with('#')) {
      continue;
    }
    if (!row) {
      separator = separator_of(content);
      const std::vector<std::string> names = cell_names(content, separator);
      columns = names.size();
      row.emplace(names);
      continue;
    }
    const std::string where = fmt::format("{}:{}", file.string(), line.number);
    const std::vector<std::string_view> parts = cells(content, separator);
    if (parts.size() != columns) {
      throw InputError({where, "", fmt::format("{} values", parts.size()),
                        fmt::format("{} as in the header", columns), ""});
    }
    row->set(where, parts);
    take_row(*row, measurements);
  }
  return measurements;
}

std::string pose_text(const Pose& X) {
  const Eigen::Vector3d p = X.translation();
  const Eigen::Vector3d rpy = rpy_from_rotation(X.linear()) / kDegree;
  return fmt::format("{{xyz: [{:.6f}, {:.6f}, {:.6f}], rpy_deg: [{:.5f}, {:.5f}, {:.5f}]}}", p.x(),
                     p.y(), p.z(), rpy.x(), rpy.y(), rpy.z());
}

}  // namespace

CameraMeasurements read_camera_measurements(const std::filesystem::path& file) {
  const bool is_yaml = has_extension(file, ".yaml") || has_extension(file, ".yml");
  CameraMeasurements measurements =
      is_yaml ? read_yaml_measurements(file) : read_table_measurements(file);
  if (measurements.pairs.empty() == measurements.points.empty()) {
    throw InputError(
        {file.string(), "",
         measurements.pairs.empty() ? "neither pairs nor points" : "pairs of poses and points",
         "pairs of poses of hand and target, or points of robot and camera", ""});
  }
  return measurements;
}

std::string camera_calibration_text(const CameraCalibration& calibration,
                                    const std::optional<CameraMount>& mount) {
  std::string text;
  if (mount) {
    const bool on_hand = *mount == CameraMount::kOnHand;
    text += fmt::format("camera: {}\n", on_hand ? "hand" : "fixed");
    text += fmt::format("target_in_{}: {}\n", on_hand ? "base" : "hand",
                        pose_text(calibration.X_target));
  }
  text += fmt::format("pose: {}\n", pose_text(calibration.X_AC));
  text += fmt::format("rms_mm: {:.4f}\n", calibration.rms_position / kMillimetre);
  if (mount) {
    text += fmt::format("rms_deg: {:.4f}\n", calibration.rms_angle / kDegree);
  }
  text += fmt::format("used: {}\nresiduals:\n", calibration.used);
  for (const CalibrationResidual& residual : calibration.residuals) {
    const std::string angle = mount ? fmt::format(", deg: {:.4f}", residual.angle / kDegree) : "";
    text += fmt::format("  - {{mm: {:.4f}{}, outlier: {}}}\n", residual.position / kMillimetre,
                        angle, residual.is_outlier);
  }
  return text;
}

}  // namespace handway::geometric
