#include "handway/geometric/setup/swept_volume.h"

#include "handway/geometric/collision/collision_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>

namespace handway::geometric {
namespace {

using Cell = Eigen::Vector3i;
using Key = std::uint64_t;

constexpr int kBits = 20;  // bits of a coordinate in a key
constexpr int kMiddle = 1 << (kBits - 1);
constexpr double kSpacing = 0.7;  // spacing of surface points, in cells
constexpr int kSmoothings = 4;
constexpr double kStill = 1e-4;  // m

Key key_of(const Cell& cell) {
  const auto part = [](int coordinate) { return static_cast<Key>(coordinate) + Key{kMiddle}; };
  return (part(cell.x()) << (2 * kBits)) | (part(cell.y()) << kBits) | part(cell.z());
}

Cell cell_of(Key key) {
  const auto part = [key](int shift) {
    return static_cast<int>((key >> shift) & ((Key{1} << kBits) - 1)) - kMiddle;
  };
  return {part(2 * kBits), part(kBits), part(0)};
}

Cell cell_at(const Eigen::Vector3d& point, double cell) {
  return (point / cell).array().floor().cast<int>();
}

// Points on the surface of a link, one in each cell of its frame.
std::vector<Eigen::Vector3d> surface_points(const Link& link, double spacing) {
  const TriangleMesh mesh = collision_mesh(link);
  std::unordered_set<Key> taken;
  std::vector<Eigen::Vector3d> points;
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[triangle[0]];
    const Eigen::Vector3d u = mesh.vertices[triangle[1]] - a;
    const Eigen::Vector3d v = mesh.vertices[triangle[2]] - a;
    const double longest = std::max({u.norm(), v.norm(), (u - v).norm()});
    const int pieces = std::max(1, static_cast<int>(std::ceil(longest / spacing)));
    for (int i = 0; i <= pieces; ++i) {
      for (int j = 0; i + j <= pieces; ++j) {
        const Eigen::Vector3d point =
            a + u * (static_cast<double>(i) / pieces) + v * (static_cast<double>(j) / pieces);
        if (taken.insert(key_of(cell_at(point, spacing))).second) {
          points.push_back(point);
        }
      }
    }
  }
  return points;
}

// Poses in the world of all links, for each posture.
std::vector<std::vector<Pose>> link_poses(const RobotInstance& robot,
                                          const std::vector<Configuration>& postures) {
  std::vector<std::vector<Pose>> poses;
  poses.reserve(postures.size());
  for (const Configuration& q : postures) {
    poses.emplace_back(static_cast<std::size_t>(robot.model->link_count()));
    robot.model->forward_kinematics(q, poses.back());
    for (Pose& X : poses.back()) {
      X = robot.X_WB * X;
    }
  }
  return poses;
}

// The faces between filled cells and empty ones.
class Hull {
 public:
  explicit Hull(double cell) : cell_(cell) {}

  void add(const std::unordered_set<Key>& filled) {
    for (const Key key : filled) {
      const Cell cell = cell_of(key);
      for (int axis = 0; axis < 3; ++axis) {
        for (const int side : {0, 1}) {
          Cell beside = cell;
          beside[axis] += 2 * side - 1;
          if (!filled.contains(key_of(beside))) {
            add_face(cell, axis, side);
          }
        }
      }
    }
  }

  TriangleMesh smoothed() && {
    for (int i = 0; i < kSmoothings; ++i) {
      smooth();
    }
    return std::move(mesh_);
  }

 private:
  std::uint32_t corner(const Cell& at) {
    const auto [found, is_new] =
        corners_.try_emplace(key_of(at), static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) {
      mesh_.vertices.push_back(cell_ * at.cast<double>());
    }
    return found->second;
  }

  void add_face(const Cell& cell, int axis, int side) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    std::array<std::uint32_t, 4> corners{};
    for (std::size_t i = 0; i < 4; ++i) {
      Cell at = cell;
      at[axis] += side;
      at[u] += i == 1 || i == 2 ? 1 : 0;
      at[v] += i >= 2 ? 1 : 0;
      corners[i] = corner(at);
    }
    if (side == 0) {  // seen from outside, counterclockwise
      std::swap(corners[1], corners[3]);
    }
    mesh_.triangles.push_back({corners[0], corners[1], corners[2]});
    mesh_.triangles.push_back({corners[0], corners[2], corners[3]});
  }

  void smooth() {
    std::vector<Eigen::Vector3d> sums(mesh_.vertices.size(), Eigen::Vector3d::Zero());
    std::vector<double> counts(mesh_.vertices.size(), 0.0);
    for (const auto& triangle : mesh_.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        sums[triangle[i]] += mesh_.vertices[triangle[(i + 1) % 3]];
        counts[triangle[i]] += 1.0;
      }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
      mesh_.vertices[i] = 0.5 * (mesh_.vertices[i] + sums[i] / counts[i]);
    }
  }

  double cell_;
  TriangleMesh mesh_;
  std::unordered_map<Key, std::uint32_t> corners_;
};

}  // namespace

TriangleMesh swept_volume(const RobotInstance& robot, const std::vector<Configuration>& postures,
                          double cell, const std::stop_token& stop) {
  const auto poses = link_poses(robot, postures);
  std::unordered_set<Key> filled;
  for (int i = 0; i < robot.model->link_count(); ++i) {
    const auto link = static_cast<std::size_t>(i);
    const bool moves = std::ranges::any_of(
        poses, [&](const auto& X_WL) { return !X_WL[link].isApprox(poses.front()[link], kStill); });
    if (!moves) {
      continue;
    }
    const auto points = surface_points(robot.model->link(i), kSpacing * cell);
    for (const auto& X_WL : poses) {
      if (stop.stop_requested()) {
        return {};
      }
      for (const Eigen::Vector3d& point : points) {
        filled.insert(key_of(cell_at(X_WL[link] * point, cell)));
      }
    }
  }
  Hull hull(cell);
  hull.add(filled);
  return std::move(hull).smoothed();
}

}  // namespace handway::geometric
