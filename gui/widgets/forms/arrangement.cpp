#include "widgets/forms/arrangement.h"

#include <QLabel>
#include <QVariant>
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

QLabel* label(const QString& text, const char* role) {
  auto* made = new QLabel(text);
  made->setProperty("role", role);
  return made;
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

QLabel* heading(const QString& text) { return label(text, "heading"); }

QLabel* note(const QString& text) { return label(text, "note"); }

}  // namespace handway::gui
