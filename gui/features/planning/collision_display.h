#pragma once

#include "model/document/collision_monitor.h"
#include "model/planning/query_doctor.h"
#include "widgets/panels/floating_card.h"

#include <QColor>
#include <QLabel>
#include <QObject>
#include <QPoint>

#include <functional>
#include <memory>
#include <vector>

class QAction;

class QLabel;
class QPushButton;
class QToolButton;

namespace handway::gui {

class PanelArea;
class SceneView;

/// "in collision: A with B", or how far the closest bodies are apart.
class CollisionLabel : public QLabel {
  Q_OBJECT

 public:
  explicit CollisionLabel(QWidget* parent = nullptr);

  void show_report(const CollisionReport& report);
  void show_nothing();
  /// The answer is to come.
  void show_pending();

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  /// @param all for the tool tip.
  void show_words(const QColor& color, const QString& words, const QString& all);
  void elide();

  QColor color_;
  QString words_;
};

/// Watches the document's posture: colliding bodies are red in the view, and named in a label; a
/// line shows where the closest bodies are closest.
class CollisionDisplay : public QObject {
  Q_OBJECT

 public:
  /// Makes the label; a window takes it over. @param monitor outlives it, as do the others.
  CollisionDisplay(CollisionMonitor& monitor, SceneView& view, QObject* parent = nullptr);

  [[nodiscard]] CollisionLabel* label() const { return label_; }
  /// The switch of the line between the bodies that are closest.
  [[nodiscard]] QAction* closest_shown() const { return closest_shown_; }
  /// Resets for another scene, without a result yet.
  void show_scene();

 signals:
  void failed(const QString& message);

 private:
  SceneView& view_;
  CollisionLabel* label_;
  QAction* closest_shown_;
};

class Document;
class Posing;
class SceneEditor;

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
