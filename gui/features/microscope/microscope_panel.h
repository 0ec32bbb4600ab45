#pragma once

#include "handway/planning/core/observer.h"
#include "handway/planning/planners/planner.h"
#include "model/planning/microscope.h"

#include <QString>
#include <QTimer>
#include <QWidget>

#include <span>
#include <string_view>

class QLabel;
class QPlainTextEdit;

class QComboBox;
class QPushButton;
class QSlider;
class QToolButton;

namespace handway::gui {

/// Algorithms 1 to 4 of the paper (sections 5.1 to 5.3), its lines in other words.
struct AlgorithmListing {
  int algorithm;
  const char* title;                        ///< "SampleArm(step, ρₐ)"
  std::span<const std::string_view> lines;  ///< Line 1 first, indented by two spaces a level.
};

/// @pre algorithm is 1 to 4.
[[nodiscard]] const AlgorithmListing& algorithm_listing(int algorithm);

/// One of the paper's listings with its line numbers, one line marked.
class ListingView : public QWidget {
  Q_OBJECT

 public:
  explicit ListingView(QWidget* parent = nullptr);

  /// @param algorithm 1 to 4. @param line from 1. @param calls paler: the line only calls
  /// another algorithm.
  void show_line(int algorithm, int line, bool calls);
  void clear();
  [[nodiscard]] int algorithm() const { return algorithm_; }
  [[nodiscard]] int line() const { return line_; }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void show_title();
  void mark();

  QLabel* title_;
  QPlainTextEdit* text_;
  int algorithm_ = 0;  ///< 0: none.
  int line_ = 0;
  bool calls_ = false;
};

class Document;
class PlanSettings;
class SceneView;
class Workbench;

/// Returns the result of a line of the algorithm as a sentence. @pre index is one of the run's
/// steps.
[[nodiscard]] QString step_text(const RecordedRun& run, std::size_t index);

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
