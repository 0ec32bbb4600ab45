#include "widgets/forms/labels.h"

#include <QLabel>
#include <QVariant>

namespace handway::gui {
namespace {

QLabel* label(const QString& text, const char* role) {
  auto* made = new QLabel(text);
  made->setProperty("role", role);
  return made;
}

}  // namespace

QLabel* heading(const QString& text) { return label(text, "heading"); }

QLabel* note(const QString& text) { return label(text, "note"); }

}  // namespace handway::gui
