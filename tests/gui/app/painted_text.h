#pragma once

#include <QList>
#include <QPolygonF>
#include <QString>

class QWidget;

namespace handway::test {

/// A piece of text as a widget paints it.
struct PaintedText {
  QString text;
  QPolygonF outline;  ///< Outline of its letters, in the widget's coordinates.
  QRectF room;        ///< Visible part: the clip there, in the widget's coordinates.
};

/// Returns the texts that a widget itself paints, without its children.
[[nodiscard]] QList<PaintedText> painted_texts(QWidget& widget);

}  // namespace handway::test
