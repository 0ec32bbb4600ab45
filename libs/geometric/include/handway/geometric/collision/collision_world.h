#pragma once

#include "handway/geometric/collision/link_constraint.h"
#include "handway/geometric/export.h"
#include "handway/geometric/scene/scene_difference.h"

#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace handway::geometric {

struct BodySolids;

/// Largest distance of anything from the origin, m: any point of a robot's or an object's frame, of
/// a joint in its parent's, of a vertex in its mesh's. Up to there checkers agree on what touches
/// beyond 1 µm of contact, and distances are right within 1 µm.
inline constexpr double kFarthestPoint = 1e6;

/// One rigid set of triangles: a link of the planned robot with all its collision shapes, an
/// attached object, or a fixed body.
struct CollisionBody {
  std::string name;              ///< Link or object; "robot/link" for a robot that is fixed.
  int link = -1;                 ///< Link of the planned robot that carries the body; -1: fixed.
  Pose X_FB = Pose::Identity();  ///< Pose in its link's frame, or in the world.
  std::shared_ptr<const TriangleMesh> mesh;  ///< Triangles in the body's frame B.
  bool is_carried = false;                   ///< True for an object on a link.
  /// The body is a scaled copy of the body before it: this one is checked against fixed bodies, the
  /// other one against moving ones.
  bool is_scaled_copy = false;
  /// Distance (m) that a moving body keeps from fixed ones, or a fixed body from moving ones.
  /// Paddings of both bodies of a pair add up.
  double padding = 0.0;
  std::vector<std::string> touching = {};  ///< Names of bodies that an attached object may touch.
  /// Its closed shapes, whose interiors must be free; never null.
  std::shared_ptr<const BodySolids> solids = nullptr;
  /// Centre of B in the link's or the object's frame, along its axes, m: other than 0 for a mesh
  /// that is far from the origin of that frame. Links and objects are at X_FB but for this.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();

  [[nodiscard]] bool moves() const { return link >= 0; }
};

/// Indices of two bodies that must not touch.
struct BodyPair {
  int a = -1;  ///< Always a moving body.
  int b = -1;
};

/// Bodies, by their indices in a CollisionWorld.
using BodyIndices = std::vector<int>;
/// Pairs of bodies and constraints, by their indices in a CollisionWorld.
using PairIndices = std::vector<int>;

/// Bodies of a scene and the pairs to check for collisions, for the scene's first robot. Immutable;
/// shared by all threads.
///
/// Primitives and closed meshes (is_closed()) are solids, each connected piece of its own: a body
/// with a piece inside of another one's collides with it. Open meshes, and objects that are not
/// `solid`, are surfaces.
///
/// Three kinds of pairs are not checked: those that the robot's allowed-collision matrix names,
/// those that no joint moves against each other, and an attached object with its link and the links
/// that it may touch. The scene's pairs override all but the second. A link that is scaled has two
/// bodies. A pair with padding collides where its bodies are nearer to each other than that; its
/// distance is the rest beyond it.
class HANDWAY_GEOMETRIC_EXPORT CollisionWorld {
 public:
  /// @throws InputError if the scene has no robot, an attachment has no link, or a point is farther
  /// away than kFarthestPoint; as LinkConstraint.
  explicit CollisionWorld(const Scene& scene);

  /// This world after a change of one fixed object, all else shared: equal to CollisionWorld(scene)
  /// for the changed scene, without making its meshes again.
  /// @throws InputError if there is no such object, or an object to be added has a name that is
  /// taken or is attached to a link.
  [[nodiscard]] CollisionWorld with_object_at(std::string_view name, const Pose& X_WO) const;
  [[nodiscard]] CollisionWorld with_object(const SceneObject& object) const;
  [[nodiscard]] CollisionWorld without_object(std::string_view name) const;
  [[nodiscard]] CollisionWorld with_change(const ObjectChange& change) const;

  /// This world with the constraints of `scene`, which has the same robots and attached objects.
  /// @throws InputError as LinkConstraint.
  [[nodiscard]] CollisionWorld with_constraints_of(const Scene& scene) const;

  [[nodiscard]] const RobotModel& model() const { return *model_; }
  [[nodiscard]] const std::shared_ptr<const RobotModel>& shared_model() const { return model_; }
  [[nodiscard]] const Pose& X_WB() const { return X_WB_; }
  [[nodiscard]] const std::vector<CollisionBody>& bodies() const { return bodies_; }
  [[nodiscard]] const CollisionBody& body(int index) const {
    return bodies_[static_cast<std::size_t>(index)];
  }
  /// Pairs of two moving bodies first, then moving against fixed bodies; each in body order.
  [[nodiscard]] const std::vector<BodyPair>& pairs() const { return pairs_; }
  [[nodiscard]] bool is_self_pair(const BodyPair& pair) const { return body(pair.b).moves(); }
  /// The distance (m) that the bodies of pairs()[pair] have to keep; 0 for most.
  [[nodiscard]] double padding(int pair) const {
    return paddings_.empty() ? 0.0 : paddings_[static_cast<std::size_t>(pair)];
  }
  /// Returns whether any pair has padding.
  [[nodiscard]] bool has_padding() const { return !paddings_.empty(); }

  /// Constraints on every configuration of a path. Checkers count constraints after the pairs:
  /// index pairs().size() + c is constraint c, its distance is its slack (rad or m), and it
  /// "touches" where it is violated.
  [[nodiscard]] const std::vector<LinkConstraint>& constraints() const { return constraints_; }
  /// Number of pairs and constraints.
  [[nodiscard]] int check_count() const {
    return static_cast<int>(pairs_.size() + constraints_.size());
  }
  /// The constraint with that index; null for a pair.
  [[nodiscard]] const LinkConstraint* constraint(int check) const {
    const auto index = static_cast<std::size_t>(check);
    return index < pairs_.size() ? nullptr : &constraints_[index - pairs_.size()];
  }

  /// Poses of all bodies in the world. @param[out] X_WBody shape [bodies().size()].
  void place(const Configuration& q, std::vector<Pose>& X_BL, std::vector<Pose>& X_WBody) const;

  /// Updates the poses of the moving bodies alone: the others stay as they are.
  void place_moving(const Configuration& q, std::vector<Pose>& X_BL,
                    std::vector<Pose>& X_WBody) const;

  /// Indices of the moving bodies, ascending.
  [[nodiscard]] const BodyIndices& moving() const { return moving_; }

  /// Pairs with a fixed body of that name, in order.
  [[nodiscard]] PairIndices pairs_with(std::string_view still_body) const;

 private:
  void add_constraints(const Scene& scene);
  void add_robot_links(const RobotInstance& robot);
  void add_still_robot(const RobotInstance& robot);
  void add_objects(const Scene& scene);
  void list_pairs();
  void add(CollisionBody body, const std::filesystem::path& file);
  void add_padded(CollisionBody body, std::span<const LinkGeometry> shapes, const Padding& padding,
                  bool solid, const std::filesystem::path& file);
  void list_paddings();
  [[nodiscard]] bool must_not_touch(int a, int b) const;
  [[nodiscard]] std::vector<CollisionBody>::const_iterator find_still_body(
      std::string_view name) const;
  [[nodiscard]] std::vector<CollisionBody>::const_iterator needed_still_body(
      std::string_view name) const;

  std::shared_ptr<const RobotModel> model_;
  Pose X_WB_ = Pose::Identity();
  std::vector<CollisionBody> bodies_;
  BodyIndices moving_;
  std::vector<BodyPair> pairs_;
  std::vector<double> paddings_;  ///< Per pair, m; empty if all are 0.
  std::vector<LinkConstraint> constraints_;
  std::map<AllowedCollisions::Pair, bool>
      allowed_collisions_;  ///< Allowed collisions of the scene.
};

/// The triangles of all collision shapes of a link, in the link's frame; may be empty.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT TriangleMesh collision_mesh(const Link& link);

}  // namespace handway::geometric
