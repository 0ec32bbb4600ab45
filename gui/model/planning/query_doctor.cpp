#include "model/planning/query_doctor.h"

#include "handway/geometric/robot/limit_violation.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <utility>

namespace handway::gui {
namespace {

std::vector<std::string> joints_beyond_limits(const geometric::RobotModel& model,
                                              const geometric::Configuration& q) {
  std::vector<std::string> names;
  for (const geometric::LimitViolation& violation : geometric::limit_violations(model, q)) {
    names.push_back(violation.joint);
  }
  return names;
}

}  // namespace

QueryDoctor::QueryDoctor(QObject* parent) : QObject(parent) {}

void QueryDoctor::examine(const std::shared_ptr<const geometric::Scene>& scene,
                          const std::shared_ptr<const PreparedProblem>& problem) {
  if (!problem || !scene || (!scene->start && !scene->goal)) {
    job_.cancel();
    emit diagnosed({});
    return;
  }
  job_.run([this, problem, has_start = scene->start.has_value(),
            has_goal = scene->goal.has_value()](const std::stop_token& stop) -> LatestJob::Answer {
    std::vector<EndDiagnosis> ends;
    try {
      if (const PreparedProblem::Problem prepared = problem->wait(stop)) {
        ends = diagnose(*prepared, has_start, has_goal, stop);
      }
    } catch (const std::exception&) {
      return nullptr;  // the collision display says why the scene can't be checked
    }
    return [this, ends = std::move(ends)] { emit diagnosed(ends); };
  });
}

namespace {

using geometric::SceneObject;

void add_once(std::vector<std::string>& names, const std::string& name) {
  if (std::ranges::find(names, name) == names.end()) {
    names.push_back(name);
  }
}

/// Contacts that are left in a changed scene.
std::size_t collisions_in(const planning::PlanningProblem& before, geometric::Scene scene,
                          const geometric::Configuration& q) {
  const planning::PlanningProblem problem = planning::updated_problem(
      before, std::make_shared<const geometric::Scene>(std::move(scene)), before.basis);
  const auto checker = problem.checker->clone();
  return geometric::touching_pairs(*checker, q).size();
}

}  // namespace

geometric::Scene remedied(const geometric::Scene& scene, const EndRemedy& remedy) {
  geometric::Scene mended = scene;
  for (SceneObject& object : mended.objects) {
    if (std::ranges::find(remedy.objects, object.name) == remedy.objects.end()) {
      continue;
    }
    if (remedy.kind == EndRemedy::Kind::kHollow) {
      object.solid = false;
    } else if (remedy.kind == EndRemedy::Kind::kTouchLinks && object.attachment) {
      for (const std::string& link : remedy.links) {
        add_once(object.attachment->touching, link);
      }
    }
  }
  return mended;
}

EndRemedy find_remedy(const planning::PlanningProblem& problem,
                      const std::vector<geometric::Contact>& contacts,
                      const geometric::Configuration& q) {
  const geometric::Scene& scene = *problem.scene;
  EndRemedy hollow{EndRemedy::Kind::kHollow, {}, {}};
  EndRemedy touch{EndRemedy::Kind::kTouchLinks, {}, {}};
  for (const geometric::Contact& contact : contacts) {
    for (const auto& [name, other] :
         {std::pair(contact.a, contact.b), std::pair(contact.b, contact.a)}) {
      const SceneObject* object = geometric::find_object(scene, name);
      if (!object) {
        continue;
      }
      if (!object->attachment && object->solid) {
        add_once(hollow.objects, name);
      } else if (object->attachment && problem.model().find_link(other)) {
        add_once(touch.objects, name);
        add_once(touch.links, other);
      }
    }
  }
  for (const EndRemedy& remedy : {hollow, touch}) {
    if (!remedy.objects.empty() &&
        collisions_in(problem, remedied(scene, remedy), q) < contacts.size()) {
      return remedy;
    }
  }
  return {};
}

std::vector<EndDiagnosis> diagnose(const planning::PlanningProblem& problem, bool has_start,
                                   bool has_goal, const std::stop_token& stop) {
  std::vector<EndDiagnosis> ends;
  const auto checker = problem.checker->clone();
  for (const bool is_start : {true, false}) {
    if (!(is_start ? has_start : has_goal) || stop.stop_requested()) {
      continue;
    }
    EndDiagnosis end;
    end.is_start = is_start;
    end.q = is_start ? problem.start : problem.goal;
    end.beyond_limits = joints_beyond_limits(problem.model(), end.q);
    const bool refused = checker->first_collision(end.q).has_value();
    if (!refused && end.beyond_limits.empty()) {
      continue;
    }
    if (refused) {
      end.contacts = geometric::find_contacts(*checker, end.q);
      end.violated = geometric::violated_constraints(*checker, end.q);
      end.remedy = find_remedy(problem, end.contacts, end.q);
    }
    end.nearest = planning::find_nearest_free(problem, end.q, {}, stop);
    ends.push_back(std::move(end));
  }
  return ends;
}

}  // namespace handway::gui
