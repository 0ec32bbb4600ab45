#pragma once

#include <QWidget>

#include <optional>

class QLabel;

namespace handway::gui {

/// A distance in normalised joints: its name, a bar from 0 to kMost, and the number.
class DistanceRow : public QWidget {
 public:
  static constexpr double kMost = 1.0;  ///< Where the bar is full.

  explicit DistanceRow(const QString& name, QWidget* parent = nullptr);

  /// Nothing: a dash. @param usual is marked on the bar; nothing: no mark.
  void show_distance(std::optional<double> distance, std::optional<double> usual = std::nullopt);
  [[nodiscard]] QString text() const;

 private:
  class Bar;

  Bar* bar_;
  QLabel* number_;
};

}  // namespace handway::gui
