#include "view3d/cube_parts.h"

#include <cmath>
#include <numbers>

namespace handway::gui {

using Eigen::Vector3d;

const std::array<CubeFace, 6>& cube_faces() {
  static const std::array<CubeFace, 6> kFaces{{
      {"Front", {1, 0, 0}, Vector3d::UnitY(), Vector3d::UnitZ()},
      {"Back", {-1, 0, 0}, -Vector3d::UnitY(), Vector3d::UnitZ()},
      {"Left", {0, 1, 0}, -Vector3d::UnitX(), Vector3d::UnitZ()},
      {"Right", {0, -1, 0}, Vector3d::UnitX(), Vector3d::UnitZ()},
      {"Top", {0, 0, 1}, Vector3d::UnitX(), Vector3d::UnitY()},
      {"Bottom", {0, 0, -1}, Vector3d::UnitX(), -Vector3d::UnitY()},
  }};
  return kFaces;
}

CubePart part_of_field(const CubeFace& face, int column, int row) {
  return face.normal + (column - 1) * face.right.cast<int>() + (row - 1) * face.up.cast<int>();
}

std::optional<CubePart> cube_part_at(const Eigen::Matrix3d& R_WC, double right, double up) {
  const Vector3d backwards = R_WC.col(2);
  const Vector3d p = right * R_WC.col(0) + up * R_WC.col(1);
  for (const CubeFace& face : cube_faces()) {
    const Vector3d normal = face.normal.cast<double>();
    const double slope = normal.dot(backwards);
    if (slope < 1e-6) {
      continue;  // seen from behind
    }
    const Vector3d hit = p + (1.0 - normal.dot(p)) / slope * backwards;
    const double u = face.right.dot(hit), v = face.up.dot(hit);
    if (std::abs(u) <= 1.0 && std::abs(v) <= 1.0) {
      const auto field = [](double x) {
        return x < kCubeFields[1] ? 0 : x > kCubeFields[2] ? 2 : 1;
      };
      return part_of_field(face, field(u), field(v));
    }
  }
  return std::nullopt;
}

CubeDirection direction_of(const CubePart& part, double azimuth) {
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  const double level = std::hypot(part.x(), part.y());
  if (level == 0.0) {
    return {kQuarter * std::round(azimuth / kQuarter), kQuarter * part.z()};
  }
  return {std::atan2(part.y(), part.x()), std::atan2(part.z(), level)};
}

std::vector<const char*> face_names(const CubePart& part) {
  std::vector<const char*> names;
  for (const std::size_t face : {4U, 5U, 0U, 1U, 2U, 3U}) {  // top and bottom first
    if (cube_faces().at(face).normal.dot(part) > 0) {
      names.push_back(cube_faces().at(face).name);
    }
  }
  return names;
}

}  // namespace handway::gui
