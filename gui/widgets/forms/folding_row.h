#pragma once

#include <QWidget>

#include <initializer_list>

class QBoxLayout;
class QLayout;

namespace handway::gui {

/// Parts beside each other where there is room, and else one below the other.
class FoldingRow : public QWidget {
 public:
  /// @param gap between the parts, px.
  FoldingRow(std::initializer_list<QLayout*> parts, int gap, QWidget* parent = nullptr);

  /// Has the width of the widest part.
  [[nodiscard]] QSize minimumSizeHint() const override;

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  [[nodiscard]] int width_in_a_row() const;

  QBoxLayout* layout_;
};

}  // namespace handway::gui
