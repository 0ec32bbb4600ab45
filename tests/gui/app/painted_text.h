#pragma once

#include <QList>
#include <QPolygonF>
#include <QString>

class QWidget;

namespace handway::test {

/// A piece of text as a widget paints it.
struct PaintedText {
  QString text;
  QPolygonF outline;  ///< Of its letters, in the widget's coordinates.
  QRectF room;        ///< What is painted of it: the clip there, in the widget's coordinates.
};

/// What a widget itself paints, its children apart.
[[nodiscard]] QList<PaintedText> painted_texts(QWidget& widget);

}  // namespace handway::test
