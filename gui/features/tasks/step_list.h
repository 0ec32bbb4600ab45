#pragma once

#include "handway/geometric/scene/program.h"

#include <QSize>
#include <QString>
#include <QTreeWidget>

#include <vector>

namespace handway::gui {

/// Returns the words for a step: "pick can", "place on table", "move to start".
[[nodiscard]] QString words_of(const geometric::ProgramStep& step);

/// Lists the steps of a program with their numbers. Disabled ones are struck through. A step can be
/// dragged to another place.
class StepList : public QTreeWidget {
  Q_OBJECT

 public:
  explicit StepList(QWidget* parent = nullptr);

  /// Shows other steps, without telling anyone. @param selected row; the nearest one is selected.
  void show_steps(const std::vector<geometric::ProgramStep>& steps, int selected);
  /// Returns the selected row; -1 without one.
  [[nodiscard]] int row() const;

  void dropEvent(QDropEvent* event) override;
  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;

 signals:
  /// A user has dragged the step of a row to another place. @param to its row there.
  void step_dragged(int from, int to);

 protected:
  /// Keeps the selected step in sight.
  void resizeEvent(QResizeEvent* event) override;

 private:
  /// Height of this many rows, or of all if there are fewer, px.
  [[nodiscard]] int height_of(int rows) const;
};

}  // namespace handway::gui
