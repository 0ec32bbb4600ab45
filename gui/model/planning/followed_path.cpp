#include "model/planning/followed_path.h"

#include "handway/planning/core/planning_context.h"
#include "handway/planning/planners/auto_planner.h"
#include "model/document/scene_edits.h"

#include <algorithm>
#include <string>
#include <utility>

namespace handway::gui {
namespace {

using geometric::Scene;
using geometric::SceneObject;
using planning::Path;
using planning::PlanResult;

constexpr double kTimeLimit = 2.0;  // s, of one query

/// Answers the first query with a path that is known already.
class KnownPathFirst : public planning::Planner {
 public:
  KnownPathFirst(Path path, std::unique_ptr<Planner> rest)
      : path_(std::move(path)), rest_(std::move(rest)) {
    objective() = rest_->objective();
  }

  [[nodiscard]] std::string name() const override { return rest_->name(); }
  [[nodiscard]] std::string description() const override { return rest_->description(); }
  [[nodiscard]] planning::PlannerCapabilities capabilities() const override {
    return rest_->capabilities();
  }

 protected:
  void do_plan(planning::PlanningContext& context, PlanResult& result) override {
    if (path_.waypoints.empty()) {
      rest_->plan_within(context, result);
      return;
    }
    result.path = std::exchange(path_, {});
    result.status = planning::PlanStatus::kSolved;
  }
  [[nodiscard]] std::vector<planning::Parameter> own_parameters() override { return {}; }

 private:
  Path path_;
  std::unique_ptr<Planner> rest_;
};

bool same_pose(const geometric::Pose& a, const geometric::Pose& b) {
  return a.matrix() == b.matrix();
}

bool same_robots(const Scene& a, const Scene& b) {
  return std::ranges::equal(a.robots, b.robots, [&](const auto& x, const auto& y) {
    const bool is_first = &x == &a.robots.front();
    return x.model == y.model && same_pose(x.X_WB, y.X_WB) &&
           (is_first || x.configuration == y.configuration);
  });
}

bool same_carried(const Scene& a, const Scene& b) {
  const auto carried = [](const Scene& scene) {
    std::vector<const SceneObject*> found;
    for (const SceneObject& object : scene.objects) {
      if (object.attachment) {
        found.push_back(&object);
      }
    }
    return found;
  };
  return std::ranges::equal(carried(a), carried(b), [](const SceneObject* x, const SceneObject* y) {
    return x->name == y->name && x->attachment->link == y->attachment->link &&
           x->attachment->robot == y->attachment->robot &&
           x->attachment->touching == y->attachment->touching && same_pose(x->X_PO, y->X_PO) &&
           same_shape(x->shape, y->shape) && x->solid == y->solid;
  });
}

}  // namespace

FollowedPath::FollowedPath(const planning::PlanningProblem& problem, Path path,
                           const planning::PlanRequest& request, const std::stop_token& stop)
    : roadmap_(problem, {},
               std::make_unique<KnownPathFirst>(std::move(path),
                                                std::make_unique<planning::AutoPlanner>())),
      request_(request),
      scene_(problem.scene) {
  request_.time_limit_s = std::min(request.time_limit_s, kTimeLimit);
  (void)roadmap_.plan(request_, stop);
}

bool FollowedPath::move_to(const Scene& scene) {
  const auto before = std::exchange(scene_, std::make_shared<const Scene>(scene));
  if (!same_robots(*before, scene) || !same_carried(*before, scene) ||
      before->constraints != scene.constraints || !scene.start || !scene.goal) {
    return false;
  }
  for (const SceneObject& old : before->objects) {
    const SceneObject* now = geometric::find_object(scene, old.name);
    if (old.attachment) {
      continue;
    }
    if (!now || !same_shape(old.shape, now->shape) || old.solid != now->solid) {
      roadmap_.remove_object(old.name);
    } else if (!same_pose(old.X_PO, now->X_PO)) {
      roadmap_.move_object(old.name, now->X_PO);
    }
  }
  for (const SceneObject& now : scene.objects) {
    const SceneObject* old = geometric::find_object(*before, now.name);
    if (!now.attachment &&
        (!old || !same_shape(old->shape, now.shape) || old->solid != now.solid)) {
      roadmap_.add_object(now);
    }
  }
  roadmap_.set_start(*scene.start);
  roadmap_.set_goal(*scene.goal);
  return true;
}

PlanResult FollowedPath::plan(const std::stop_token& stop) { return roadmap_.plan(request_, stop); }

}  // namespace handway::gui
