#include "view3d/viewpoints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace handway::gui {
namespace {

using geometric::Aabb;
using geometric::Configuration;
using geometric::Pose;
using Points = std::vector<Eigen::Vector3d>;

constexpr double kAround = 0.12;  // m

void add_corners(Points& points, const Aabb& box, const Pose& X) {
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d p((corner & 1) ? box.upper.x() : box.lower.x(),
                            (corner & 2) ? box.upper.y() : box.lower.y(),
                            (corner & 4) ? box.upper.z() : box.lower.z());
    points.push_back(X * p);
  }
}

void add_shape(Points& points, const geometric::Shape& shape, const Pose& X) {
  const auto mesh = geometric::tessellate(shape);
  if (mesh && !mesh->vertices.empty()) {
    add_corners(points, geometric::bounding_box(*mesh), X);
  }
}

std::vector<Pose> link_poses(const geometric::RobotInstance& robot, const Configuration& q) {
  std::vector<Pose> X_WL(static_cast<std::size_t>(robot.model->link_count()));
  robot.model->forward_kinematics(q, X_WL);
  for (Pose& X : X_WL) {
    X = robot.X_WB * X;
  }
  return X_WL;
}

void add_robot(Points& points, const geometric::RobotInstance& robot, const Configuration& q) {
  const std::vector<Pose> X_WL = link_poses(robot, q);
  for (int i = 0; i < robot.model->link_count(); ++i) {
    const geometric::Link& link = robot.model->link(i);
    for (const auto& geometry : link.visual.empty() ? link.collision : link.visual) {
      add_shape(points, geometry.shape, X_WL[static_cast<std::size_t>(i)] * geometry.X_LG);
    }
  }
}

Aabb box_around(const Points& points) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Aabb box{Eigen::Vector3d::Constant(kFar), Eigen::Vector3d::Constant(-kFar)};
  for (const Eigen::Vector3d& point : points) {
    box.lower = box.lower.cwiseMin(point);
    box.upper = box.upper.cwiseMax(point);
  }
  return box;
}

Points robot_points(const geometric::Scene& scene) {
  Points points;
  for (const geometric::RobotInstance& robot : scene.robots) {
    add_robot(points, robot, robot.configuration);
  }
  for (const auto& q : {scene.start, scene.goal}) {
    if (q && !scene.robots.empty()) {
      add_robot(points, scene.robots.front(), *q);
    }
  }
  return points;
}

constexpr std::size_t kMostParts = 40;  // of the robots
constexpr double kAtGoal = 0.4;         // counts so much less than where they stand
constexpr double kEnoughSeen = 0.8;     // of them
constexpr double kHardlySeen = 0.3;     // of them: they are closed in
constexpr double kMuchMore = 0.05;      // that is seen from elsewhere
constexpr double kMostAlpha = 0.5;      // of what one looks through
constexpr double kBefore = 0.1;         // m, of a section before the robots
constexpr double kNearlyThere = 0.97;   // of the ray: what is seen may touch something

// Does something of the mesh lie between the two (in its frame)?
bool hides(const geometric::TriangleMesh& mesh, const Eigen::Vector3d& eye,
           const Eigen::Vector3d& point) {
  const Eigen::Vector3d ray = point - eye;
  return std::ranges::any_of(mesh.triangles, [&](const auto& corners) {
    const Eigen::Vector3d& a = mesh.vertices[corners[0]];
    const Eigen::Vector3d ab = mesh.vertices[corners[1]] - a, ac = mesh.vertices[corners[2]] - a;
    const Eigen::Vector3d p = ray.cross(ac);
    const double det = ab.dot(p);
    if (std::abs(det) < 1e-12) {
      return false;
    }
    const Eigen::Vector3d from = eye - a, q = from.cross(ab);
    const double u = from.dot(p) / det, v = ray.dot(q) / det, t = ac.dot(q) / det;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < kNearlyThere;
  });
}

/// Obstacles around the robot that the view has to avoid.
class Obstacles {
 public:
  explicit Obstacles(const geometric::Scene& scene) {
    for (const geometric::SceneObject& object : scene.objects) {
      const auto mesh = object.attachment ? nullptr : geometric::tessellate(object.shape);
      if (mesh && !mesh->vertices.empty() && object.color.alpha > kMostAlpha &&
          !scene.display.of(object.name).hidden) {
        const Aabb box = geometric::bounding_box(*mesh);
        bodies_.push_back({mesh, Eigen::AlignedBox3d(box.lower, box.upper), object.X_PO.inverse()});
      }
    }
  }

  [[nodiscard]] bool hide(const Eigen::Vector3d& eye, const Eigen::Vector3d& point) const {
    return std::ranges::any_of(bodies_, [&](const Body& body) {
      const Eigen::Vector3d from = body.X_OW * eye, to = body.X_OW * point;
      return meets(body.box, from, to) && hides(*body.mesh, from, to);
    });
  }

 private:
  struct Body {
    std::shared_ptr<const geometric::TriangleMesh> mesh;
    Eigen::AlignedBox3d box;  // in its frame
    Pose X_OW;
  };

  static bool meets(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from,
                    const Eigen::Vector3d& to) {
    double begin = 0.0, end = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double step = to[axis] - from[axis];
      if (std::abs(step) < 1e-12) {
        if (from[axis] < box.min()[axis] || from[axis] > box.max()[axis]) {
          return false;
        }
        continue;
      }
      const auto [low, high] = std::minmax(
          {(box.min()[axis] - from[axis]) / step, (box.max()[axis] - from[axis]) / step});
      begin = std::max(begin, low);
      end = std::min(end, high);
    }
    return begin <= end;
  }

  std::vector<Body> bodies_;
};

/// A part of a robot to be seen.
struct Part {
  std::array<Eigen::Vector3d, 3> points;  ///< Along the longest edge of its box.
  double area;                            ///< About what is seen of it, m².
};

void add_parts(std::vector<Part>& parts, const geometric::RobotInstance& robot,
               const Configuration& q, double weight) {
  const std::vector<Pose> X_WL = link_poses(robot, q);
  for (int i = 0; i < robot.model->link_count(); ++i) {
    const geometric::Link& link = robot.model->link(i);
    for (const auto& geometry : link.visual.empty() ? link.collision : link.visual) {
      const auto mesh = geometric::tessellate(geometry.shape);
      if (!mesh || mesh->vertices.empty()) {
        continue;
      }
      const Aabb box = geometric::bounding_box(*mesh);
      const Eigen::Vector3d size = box.size();
      Eigen::Index longest = 0;
      size.maxCoeff(&longest);
      const Eigen::Vector3d third = size[longest] / 3.0 * Eigen::Vector3d::Unit(longest);
      const Pose X_WG = X_WL[static_cast<std::size_t>(i)] * geometry.X_LG;
      parts.push_back({{X_WG * box.centre(), X_WG * Eigen::Vector3d(box.centre() - third),
                        X_WG * Eigen::Vector3d(box.centre() + third)},
                       weight * size.prod() / std::max(size.minCoeff(), 1e-6)});
    }
  }
}

/// The largest ones, of robots as they stand and of the first one at goal.
std::vector<Part> large_parts(const geometric::Scene& scene) {
  std::vector<Part> parts;
  for (const geometric::RobotInstance& robot : scene.robots) {
    add_parts(parts, robot, robot.configuration, 1.0);
  }
  if (scene.goal && !scene.robots.empty()) {
    add_parts(parts, scene.robots.front(), *scene.goal, kAtGoal);
  }
  std::ranges::stable_sort(parts, std::ranges::greater(), &Part::area);
  parts.resize(std::min(parts.size(), kMostParts));
  return parts;
}

using Plane = Eigen::Hyperplane<double, 3>;

/// @param section what is above it is cut away; nothing: nothing is.
double share_seen(const std::vector<Part>& parts, const Obstacles& obstacles,
                  const Eigen::Vector3d& eye, const std::optional<Plane>& section = {}) {
  const auto is_hidden = [&](const Eigen::Vector3d& point) {
    Eigen::Vector3d from = eye;
    if (const double above = section ? section->signedDistance(eye) : 0.0; above > 0.0) {
      const double below = -section->signedDistance(point);
      if (below <= 0.0) {
        return false;
      }
      from += above / (above + below) * (point - eye);
    }
    return obstacles.hide(from, point);
  };
  double seen = 0.0, all = 0.0;
  for (const Part& part : parts) {
    for (const Eigen::Vector3d& point : part.points) {
      seen += is_hidden(point) ? 0.0 : part.area;
      all += part.area;
    }
  }
  return all > 0.0 ? seen / all : 1.0;
}

/// Just before the robots, across the world's axis that points most towards the camera.
/// @returns a point of it, and that direction.
std::pair<Eigen::Vector3d, Eigen::Vector3d> before(const Aabb& robots, const OrbitCamera& camera) {
  const Eigen::Vector3d towards = camera.orientation().col(2);
  Eigen::Index axis = 0;
  towards.cwiseAbs().maxCoeff(&axis);
  Eigen::Vector3d point = robots.centre();
  point[axis] = towards[axis] > 0.0 ? robots.upper[axis] + kBefore : robots.lower[axis] - kBefore;
  return {point, std::copysign(1.0, towards[axis]) * Eigen::Vector3d::Unit(axis)};
}

/// Among oblique views, all around and from ever higher up, the first that shows enough, or else
/// the one that shows most.
class ViewSearch {
 public:
  ViewSearch(const geometric::Scene& scene, const OrbitCamera& camera, double aspect)
      : camera_(camera),
        aspect_(aspect),
        task_(task_azimuth(scene)),
        points_(points_of_interest(scene)),
        robots_(box_around(robot_points(scene))),
        parts_(large_parts(scene)),
        obstacles_(scene) {}

  /// @param cut objects open towards the camera.
  [[nodiscard]] std::pair<OrbitCamera, double> best(bool cut) const {
    std::pair<OrbitCamera, double> best{turned(0.0, 0.0), -1.0};
    // Over what stands all around one looks from above.
    for (const double rise : {0.0, 22.0, 44.0}) {
      for (const double turn : {0.0, 70.0, -40.0, 110.0, -90.0, 145.0, -140.0, 180.0}) {
        const OrbitCamera camera = turned(turn, rise);
        const auto [point, towards] = before(robots_, camera);
        const double seen = share_seen(parts_, obstacles_, camera.position(),
                                       cut ? std::optional(Plane(towards, point)) : std::nullopt);
        if (best.second < 0.0 || seen > best.second + kMuchMore) {
          best = {camera, seen};
        }
        if (best.second >= kEnoughSeen) {
          return best;
        }
      }
    }
    return best;
  }

  [[nodiscard]] OpeningView cut_open() const {
    const OrbitCamera camera = best(true).first;
    return {camera, before(robots_, camera).first};
  }

 private:
  /// @param turn, rise degrees.
  [[nodiscard]] OrbitCamera turned(double turn, double rise) const {
    OrbitCamera camera = camera_;
    camera.look_from(StandardView::kOblique, task_ + geometric::radians(turn));
    camera.orbit(0.0, geometric::radians(rise));
    camera.fit(points_, aspect_);
    return camera;
  }

  OrbitCamera camera_;
  double aspect_;
  double task_;
  Points points_;
  Aabb robots_;
  std::vector<Part> parts_;
  Obstacles obstacles_;
};

}  // namespace

Points points_of_interest(const geometric::Scene& scene) {
  Points points = robot_points(scene);
  const bool has_robot = !points.empty();
  Aabb near = box_around(points);
  near.lower.array() -= kAround;
  near.upper.array() += kAround;
  for (const geometric::SceneObject& object : scene.objects) {
    Points corners;
    if (!object.attachment) {
      add_shape(corners, object.shape, object.X_PO);
    }
    if (has_robot && !corners.empty()) {
      const Aabb box = box_around(corners);
      const Aabb part{box.lower.cwiseMax(near.lower), box.upper.cwiseMin(near.upper)};
      corners.clear();
      if ((part.lower.array() <= part.upper.array()).all()) {
        add_corners(corners, part, Pose::Identity());
      }
    }
    points.insert(points.end(), corners.begin(), corners.end());
  }
  return points;
}

double lowest_point(const geometric::Scene& scene) {
  Points points = robot_points(scene);
  for (const geometric::SceneObject& object : scene.objects) {
    if (!object.attachment) {
      add_shape(points, object.shape, object.X_PO);
    }
  }
  return points.empty() ? 0.0 : box_around(points).lower.z();
}

double task_azimuth(const geometric::Scene& scene) {
  if (scene.robots.empty()) {
    return 0.0;
  }
  const geometric::RobotInstance& robot = scene.robots.front();
  const std::vector<Pose> X_WL = link_poses(robot, scene.goal.value_or(robot.configuration));
  const Eigen::Vector3d reach = X_WL.back().translation() - robot.X_WB.translation();
  return reach.head<2>().norm() > 0.05 ? std::atan2(reach.y(), reach.x()) : 0.0;
}

Points all_points(const geometric::Scene& scene) {
  Points points = robot_points(scene);
  for (const geometric::SceneObject& object : scene.objects) {
    if (!object.attachment) {
      add_shape(points, object.shape, object.X_PO);
    }
  }
  return points;
}

OpeningView open_view(const geometric::Scene& scene, const OrbitCamera& camera, double aspect) {
  const ViewSearch search(scene, camera, aspect);
  const auto [whole, seen] = search.best(false);
  return seen < kHardlySeen ? search.cut_open() : OpeningView{whole};
}

}  // namespace handway::gui
