#pragma once

#include "model/planning/path_history.h"

#include <QTableWidget>

#include <optional>

namespace handway::gui {

/// The figures of two paths side by side, with what the right one has more or less; the better
/// of two numbers is bold and green where more or less is better.
class FigureTable : public QTableWidget {
  Q_OBJECT

 public:
  explicit FigureTable(QWidget* parent = nullptr);

  /// Nothing: dashes.
  void show_figures(const std::optional<PathFigures>& left,
                    const std::optional<PathFigures>& right);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void fill();

  std::optional<PathFigures> left_;
  std::optional<PathFigures> right_;
};

}  // namespace handway::gui
