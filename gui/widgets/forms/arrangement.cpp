#include "widgets/forms/arrangement.h"

#include <QWidget>

namespace handway::gui {
namespace {

QBoxLayout* arranged(QBoxLayout::Direction direction, std::initializer_list<PanelPart> parts,
                     int gap) {
  auto* layout = new QBoxLayout(direction);
  layout->setSpacing(gap);
  for (const PanelPart& part : parts) {
    if (part.widget) {
      layout->addWidget(part.widget, part.stretch, part.alignment);
    } else if (part.layout) {
      layout->addLayout(part.layout, part.stretch);
    } else {
      layout->addStretch(part.stretch);
    }
  }
  return layout;
}

}  // namespace

PanelPart room(int stretch) { return {static_cast<QWidget*>(nullptr), stretch}; }

QBoxLayout* in_row(std::initializer_list<PanelPart> parts, int gap) {
  return arranged(QBoxLayout::LeftToRight, parts, gap);
}

QBoxLayout* in_column(std::initializer_list<PanelPart> parts, int gap) {
  return arranged(QBoxLayout::TopToBottom, parts, gap);
}

void lay_out(QWidget& widget, QLayout* content, const QMargins& margins) {
  content->setContentsMargins(margins);
  widget.setLayout(content);
}

QWidget* boxed(QLayout* content, const QMargins& margins) {
  auto* box = new QWidget;
  lay_out(*box, content, margins);
  return box;
}

}  // namespace handway::gui
