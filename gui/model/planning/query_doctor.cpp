#include "model/planning/query_doctor.h"

#include "handway/geometric/robot/limit_violation.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <utility>

namespace handway::gui {
namespace {

std::vector<std::string> joints_beyond_limits(const planning::PlanningProblem& problem,
                                              const geometric::Configuration& q) {
  std::vector<std::string> names;
  for (const geometric::LimitViolation& violation :
       geometric::limit_violations(problem.model(), q, problem.joints.fixed)) {
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
    std::vector<std::string> warnings;
    try {
      if (const PreparedProblem::Problem prepared = problem->wait(stop)) {
        ends = diagnose(*prepared, has_start, has_goal, stop);
        warnings = prepared->warnings;
      }
    } catch (const std::exception&) {
      return nullptr;  // the collision display says why the scene can't be checked
    }
    return [this, ends = std::move(ends), warnings = std::move(warnings)] {
      report(warnings);
      emit diagnosed(ends);
    };
  });
}

void QueryDoctor::report(const std::vector<std::string>& warnings) {
  QStringList list;
  for (const std::string& warning : warnings) {
    list << QString::fromStdString(warning);
  }
  if (list != std::exchange(reported_, list) && !list.isEmpty()) {
    emit warned(list);
  }
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
    end.beyond_limits = joints_beyond_limits(problem, end.q);
    const bool refused = checker->first_collision(end.q).has_value();
    if (!refused && end.beyond_limits.empty()) {
      continue;
    }
    if (refused) {
      end.contacts = geometric::find_contacts(*checker, end.q);
      end.violated = geometric::violated_constraints(*checker, end.q);
      const auto remedies = planning::find_remedies(problem, end.q, end.contacts);
      end.remedy = remedies.empty() ? std::nullopt : std::optional(remedies.front());
    }
    end.nearest = planning::find_nearest_free(problem, end.q, {}, stop);
    ends.push_back(std::move(end));
  }
  return ends;
}

}  // namespace handway::gui
