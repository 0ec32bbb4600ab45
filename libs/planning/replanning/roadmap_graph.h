#pragma once

#include "handway/geometric/collision/collision_world.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/replanning/dynamic_roadmap.h"
#include "roadmap/roadmap.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace handway::planning {

/// When the objects of a scene last changed, in revisions: the scene has a new
/// one with every change.
class SceneChanges {
 public:
  /// An object was moved, added or removed.
  void note(const std::string& object) { last_change_[object] = ++revision_; }

  /// Of the scene as it is; 0 before the first change.
  [[nodiscard]] int revision() const { return revision_; }

  /// The revision that the last change of `object` made; 0: it never changed.
  [[nodiscard]] int last_change(const std::string& object) const;

  /// Pairs with objects that changed after `revision`, in the world as it is.
  [[nodiscard]] std::vector<int> pairs_changed_since(int revision,
                                                     const geometric::CollisionWorld& world) const;

 private:
  int revision_ = 0;
  std::map<std::string, int> last_change_;
};

/// What is known of whether a node or an edge of a roadmap is free, and since when.
struct ValidityState {
  static constexpr int kNever = -1;

  int free_at = kNever;     ///< Found free in this revision of the scene.
  int refused_at = kNever;  ///< Found not to be free in this one, …
  std::string refused_by;   ///< … because of this object; empty: because of what never changes.

  [[nodiscard]] bool was_free() const { return free_at != kNever; }

  /// It was refused, and what refused it has not changed since.
  [[nodiscard]] bool is_refused(const SceneChanges& changes) const {
    return refused_at != kNever && changes.last_change(refused_by) <= refused_at;
  }

  void set_free(int revision) { *this = {revision, kNever, {}}; }
};

/// A graph of a robot's configurations whose nodes and edges remember when they were last found
/// free; of new ones nothing is known. Distances are Euclidean in normalised joints.
class RoadmapGraph : public Roadmap<ValidityState> {
 public:
  explicit RoadmapGraph(std::shared_ptr<const geometric::RobotModel> model);

  /// The node at `q`, or whole turns from it, added if there is none, with edges to its nearest.
  int node_at(const Configuration& q);

  /// Which edges a path may take.
  enum class Edges {
    kOnceFree,  ///< Those found free before.
    kAny,       ///< Others too, as if they were much longer.
  };
  /// The shortest path over what is not refused, by A*; empty if there is none.
  [[nodiscard]] std::vector<int> shortest_path(int from, int to, Edges edges,
                                               const SceneChanges& changes) const;

 private:
  std::shared_ptr<const geometric::RobotModel> model_;
};

/// What a DynamicRoadmap keeps from one query to the next.
struct RoadmapMemory {
  int max_nodes;  ///< When there are more, all but those of the last path are forgotten.
  std::unique_ptr<RoadmapGraph> graph;
  SceneChanges changes = {};
  Path last_path = {};                        ///< Empty: none was found yet.
  ReplanSource source = ReplanSource::kNone;  ///< Of the path of the last query.
};

}  // namespace handway::planning
