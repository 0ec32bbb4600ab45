#pragma once

#include "handway/geometric/collision/narrow_phase/contact.h"
#include "handway/planning/queries/nearest_free.h"
#include "model/document/prepared_problem.h"
#include "model/jobs/background.h"

#include <QMetaType>
#include <QObject>

#include <memory>
#include <string>
#include <vector>

namespace handway::gui {

/// What of the scene may not be meant as it is, where a start or goal is in collision.
struct EndRemedy {
  enum class Kind {
    kNone,
    kHollow,      ///< The robot is inside of closed objects that are taken as filled.
    kTouchLinks,  ///< An attached object touches links that it may not touch.
  };

  Kind kind = Kind::kNone;
  std::vector<std::string> objects;
  std::vector<std::string> links;  ///< Of kTouchLinks.
};

/// What is wrong with a start or a goal, and what could be taken instead.
struct EndDiagnosis {
  bool is_start = true;
  geometric::Configuration q;                ///< What was looked at.
  std::vector<geometric::Contact> contacts;  ///< Deepest first.
  std::vector<std::string> beyond_limits;    ///< Names of joints.
  std::vector<std::string> violated;         ///< As violated_constraints() says.
  planning::NearestFree nearest;
  EndRemedy remedy;
};

/// Looks at start and goal on a thread of its own.
class QueryDoctor : public QObject {
  Q_OBJECT

 public:
  explicit QueryDoctor(QObject* parent = nullptr);

  /// Looks at those ends that `scene` has. diagnosed() follows, unless it is asked again before.
  /// @param problem of that scene; null: nothing to look at.
  void examine(const std::shared_ptr<const geometric::Scene>& scene,
               const std::shared_ptr<const PreparedProblem>& problem);
  [[nodiscard]] bool is_busy() const { return job_.is_busy(); }

 signals:
  /// @param ends those that planning would refuse, start first; mostly none.
  void diagnosed(const std::vector<handway::gui::EndDiagnosis>& ends);

 private:
  LatestJob job_;
};

/// What planning would refuse about the scene's start and goal.
[[nodiscard]] std::vector<EndDiagnosis> diagnose(const planning::PlanningProblem& problem,
                                                 bool has_start, bool has_goal,
                                                 const std::stop_token& stop);

/// What would free `q`: hollow objects around the robot, or links that an attached object may
/// touch. kNone if neither does.
/// @param contacts all of `q`.
[[nodiscard]] EndRemedy find_remedy(const planning::PlanningProblem& problem,
                                    const std::vector<geometric::Contact>& contacts,
                                    const geometric::Configuration& q);

/// The scene with that remedy.
[[nodiscard]] geometric::Scene remedied(const geometric::Scene& scene, const EndRemedy& remedy);

}  // namespace handway::gui

Q_DECLARE_METATYPE(std::vector<handway::gui::EndDiagnosis>)
