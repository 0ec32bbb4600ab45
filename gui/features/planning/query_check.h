#pragma once

#include "model/planning/query_doctor.h"
#include "widgets/panels/floating_card.h"

#include <QLabel>
#include <QObject>
#include <QPoint>

#include <functional>
#include <memory>
#include <vector>

class QLabel;
class QPushButton;
class QToolButton;

namespace handway::gui {

class Document;
class PanelArea;
class Posing;
class SceneEditor;
class SceneView;

/// Floats over the view while start or goal can't be planned with: says what touches what, how deep
/// and where, and offers the nearest free posture.
class DoctorCard : public FloatingCard {
  Q_OBJECT

 public:
  /// @param to_be_seen where in the view something is that it should not cover.
  DoctorCard(QWidget* host, std::function<std::vector<QPoint>()> to_be_seen);

  /// Shows the first of `ends`; none: hides the card.
  void show_diagnoses(const std::shared_ptr<const geometric::RobotModel>& model,
                      const std::vector<EndDiagnosis>& ends);
  /// The scene was edited: what is shown can't be used until it was looked at again.
  void show_pending();
  /// Returns the text of the card; empty while it is hidden.
  [[nodiscard]] QString text() const;

 signals:
  /// A click on Show.
  void shown(const Eigen::VectorXd& q);
  /// A click on Use it.
  void accepted(bool is_start, const Eigen::VectorXd& q);
  /// A click on what mends the scene.
  void remedied(const handway::planning::CollisionRemedy& remedy);

 private:
  void place() override;

  std::function<std::vector<QPoint>()> to_be_seen_;
  QLabel* picture_;
  QLabel* text_;
  PanelArea* area_;  ///< Scrolls the text in a small view.
  QToolButton* close_;
  QPushButton* show_;
  QPushButton* use_;
  QPushButton* mend_;
  EndDiagnosis end_;
};

/// One or two sentences about what is wrong, as rich text.
[[nodiscard]] QString diagnosis_text(const geometric::RobotModel& model, const EndDiagnosis& end);

/// Checks start and goal of the document: an end that can't be planned with is explained in the
/// view, with a free posture nearby as an alternative.
class QueryCheck : public QObject {
  Q_OBJECT

 public:
  /// All outlive it. The card floats over the view.
  QueryCheck(Document& document, SceneEditor& editor, Posing& posing, SceneView& view,
             QObject* parent = nullptr);

  [[nodiscard]] bool is_busy() const { return doctor_.is_busy(); }
  [[nodiscard]] const DoctorCard& card() const { return *card_; }

 signals:
  /// New warnings of the planning problem, as that an end was moved onto a limit.
  void warned(const QStringList& warnings);

 private:
  void examine();
  void take(const std::vector<EndDiagnosis>& ends);
  [[nodiscard]] std::vector<QPoint> to_be_seen() const;

  Document& document_;
  SceneView& view_;
  QueryDoctor doctor_;
  std::vector<Eigen::Vector3d> contacts_;  ///< Contacts of the explained end, world, m.
  DoctorCard* card_;
};

}  // namespace handway::gui
