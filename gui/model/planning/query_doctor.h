#pragma once

#include "handway/geometric/collision/narrow_phase/contact.h"
#include "handway/planning/queries/collision_remedy.h"
#include "handway/planning/queries/nearest_free.h"
#include "model/document/prepared_problem.h"
#include "model/jobs/background.h"

#include <QMetaType>
#include <QObject>
#include <QStringList>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace handway::gui {

/// Diagnosis of a start or a goal in collision, with an alternative.
struct EndDiagnosis {
  bool is_start = true;
  geometric::Configuration q;                ///< The diagnosed configuration.
  std::vector<geometric::Contact> contacts;  ///< Deepest first.
  std::vector<std::string> beyond_limits;    ///< Names of joints.
  std::vector<std::string> violated;         ///< See violated_constraints().
  planning::NearestFree nearest;
  std::optional<planning::CollisionRemedy> remedy;  ///< Alternative that may be meant.
};

/// Checks start and goal in the background.
class QueryDoctor : public QObject {
  Q_OBJECT

 public:
  explicit QueryDoctor(QObject* parent = nullptr);

  /// Checks those ends that `scene` has. diagnosed() follows, unless this is called again before.
  /// @param problem of that scene; null: nothing to check.
  void examine(const std::shared_ptr<const geometric::Scene>& scene,
               const std::shared_ptr<const PreparedProblem>& problem);
  [[nodiscard]] bool is_busy() const { return job_.is_busy(); }

 signals:
  /// @param ends those that planning would refuse, start first; mostly none.
  void diagnosed(const std::vector<handway::gui::EndDiagnosis>& ends);
  /// @param warnings of the planning problem, where they differ from those that were reported last.
  void warned(const QStringList& warnings);

 private:
  void report(const std::vector<std::string>& warnings);

  LatestJob job_;
  QStringList reported_;
};

/// Returns the errors that planning would report about the scene's start and goal.
[[nodiscard]] std::vector<EndDiagnosis> diagnose(const planning::PlanningProblem& problem,
                                                 bool has_start, bool has_goal,
                                                 const std::stop_token& stop);

}  // namespace handway::gui

Q_DECLARE_METATYPE(std::vector<handway::gui::EndDiagnosis>)
