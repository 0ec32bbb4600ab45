#pragma once

#include "handway/planning/core/observer.h"
#include "handway/planning/planners/planner.h"
#include "model/planning/microscope.h"

#include <QString>
#include <QTimer>
#include <QWidget>

#include <memory>

class QComboBox;
class QLabel;
class QPushButton;
class QSlider;
class QToolButton;

namespace handway::gui {

class Document;
class ListingView;
class PlanSettings;
class SceneView;
class Workbench;

/// The algorithm microscope: records a run of the paper's planner and replays it line by line,
/// with the sample in question as the robot on screen and the roadmap as it was.
class MicroscopePanel : public QWidget {
  Q_OBJECT

 public:
  /// All outlive it. @param planning whose planner, settings and seed are taken.
  MicroscopePanel(Document& document, PlanSettings& planning, SceneView& view,
                  QWidget* parent = nullptr);

  [[nodiscard]] Microscope& microscope() { return microscope_; }
  [[nodiscard]] QSize sizeHint() const override { return {640, 270}; }

 signals:
  /// A recorded run takes the robot: nothing else should move it.
  void taken();

 private:
  [[nodiscard]] QWidget* make_controls();
  [[nodiscard]] QToolButton* make_button(const QString& name, const QString& icon_name,
                                         const QString& tip);
  void refresh_icons();
  void record();
  void take_run();
  void show_step();
  void step(int direction);
  void set_running(bool running);
  void show_state();
  [[nodiscard]] StepFilter filter() const;
  [[nodiscard]] std::shared_ptr<planning::Planner> make_planner() const;

  Document& document_;
  PlanSettings& planning_;
  SceneView& view_;
  Microscope microscope_;
  QPushButton* record_;
  QToolButton* rewind_;
  QToolButton* back_;
  QToolButton* run_;
  QToolButton* forward_;
  QSlider* position_;
  QComboBox* filter_;
  QComboBox* pace_;
  QLabel* count_;
  QLabel* words_;
  QLabel* state_;
  ListingView* caller_;
  ListingView* called_;
  QTimer clock_;
};

/// Adds the panel below the view.
void add_microscope(Workbench& workbench);

}  // namespace handway::gui
