#include "widgets/forms/folding_row.h"

#include <QBoxLayout>

#include <algorithm>

namespace handway::gui {

FoldingRow::FoldingRow(std::initializer_list<QLayout*> parts, int gap, QWidget* parent)
    : QWidget(parent), layout_(new QBoxLayout(QBoxLayout::LeftToRight, this)) {
  layout_->setContentsMargins(0, 0, 0, 0);
  layout_->setSpacing(gap);
  for (QLayout* part : parts) {
    layout_->addLayout(part, 1);
  }
}

int FoldingRow::width_in_a_row() const {
  int width = (layout_->count() - 1) * layout_->spacing();
  for (int i = 0; i < layout_->count(); ++i) {
    width += layout_->itemAt(i)->minimumSize().width();
  }
  return width;
}

QSize FoldingRow::minimumSizeHint() const {
  int widest = 0;
  for (int i = 0; i < layout_->count(); ++i) {
    widest = std::max(widest, layout_->itemAt(i)->minimumSize().width());
  }
  return {widest, layout_->minimumSize().height()};
}

void FoldingRow::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  layout_->setDirection(width() < width_in_a_row() ? QBoxLayout::TopToBottom
                                                   : QBoxLayout::LeftToRight);
}

}  // namespace handway::gui
