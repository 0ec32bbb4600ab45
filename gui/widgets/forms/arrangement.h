#pragma once

#include <QBoxLayout>
#include <QLatin1String>
#include <QMargins>
#include <QString>

#include <initializer_list>

class QLabel;
class QWidget;

namespace handway::gui {

/// Part of a row or a column: a widget, or a row, column, grid or form. A `stretched` part shares
/// the room that is left, beside others in that proportion.
struct PanelPart {
  PanelPart(QWidget* which, int stretched = 0, Qt::Alignment where = {})  // NOLINT(*-explicit-*)
      : widget(which), stretch(stretched), alignment(where) {}
  PanelPart(QLayout* which, int stretched = 0)  // NOLINT(*-explicit-*)
      : layout(which), stretch(stretched) {}

  QWidget* widget = nullptr;
  QLayout* layout = nullptr;  ///< Null like widget: only a space.
  int stretch = 0;
  Qt::Alignment alignment = {};
};

/// Room that is left empty.
[[nodiscard]] PanelPart room(int stretch = 0);

/// The gap of the row or column around, or of the style.
inline constexpr int kUsualGap = -1;

/// Parts from left to right. @param gap between them, px.
[[nodiscard]] QBoxLayout* in_row(std::initializer_list<PanelPart> parts, int gap = kUsualGap);
/// Parts from top to bottom. @param gap between them, px.
[[nodiscard]] QBoxLayout* in_column(std::initializer_list<PanelPart> parts, int gap = kUsualGap);

/// Puts all of a row, column, grid or form into a widget. @param margins around it, px.
void lay_out(QWidget& widget, QLayout* content, const QMargins& margins = {});
/// A widget of its own for it.
[[nodiscard]] QWidget* boxed(QLayout* content, const QMargins& margins = {});

/// Gives an object the name by which tests, scripts and kept settings find it.
template <typename Object>
[[nodiscard]] Object* named(const char* name, Object* object) {
  object->setObjectName(QLatin1String(name));
  return object;
}

/// Makes the heading of a part of a panel.
[[nodiscard]] QLabel* heading(const QString& text = {});
/// Words that are read after all others: what explains, counts or names.
[[nodiscard]] QLabel* note(const QString& text = {});

}  // namespace handway::gui
