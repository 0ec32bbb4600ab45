#include "painted_text.h"

#include <QFontMetricsF>
#include <QPaintDevice>
#include <QPaintEngine>
#include <QPainter>
#include <QPainterPath>
#include <QWidget>

namespace handway::test {
namespace {

/// Notes the texts, and paints nothing.
class TextEngine : public QPaintEngine {
 public:
  TextEngine() : QPaintEngine(QPaintEngine::AllFeatures) {}

  QList<PaintedText> texts;

  bool begin(QPaintDevice* /*device*/) override { return true; }
  bool end() override { return true; }
  void updateState(const QPaintEngineState& /*state*/) override {}
  void drawPath(const QPainterPath& /*path*/) override {}
  void drawPolygon(const QPointF* /*points*/, int /*count*/, PolygonDrawMode /*mode*/) override {}
  void drawPixmap(const QRectF& /*where*/, const QPixmap& /*what*/,
                  const QRectF& /*part*/) override {}
  void drawImage(const QRectF& /*where*/, const QImage& /*what*/, const QRectF& /*part*/,
                 Qt::ImageConversionFlags /*flags*/) override {}
  [[nodiscard]] Type type() const override { return QPaintEngine::User; }

  void drawTextItem(const QPointF& base, const QTextItem& item) override {
    if (item.text().trimmed().isEmpty()) {
      return;
    }
    const QTransform to_device = painter()->combinedTransform();
    const QRectF letters =
        QFontMetricsF(item.font()).tightBoundingRect(item.text().trimmed()).translated(base);
    const QRectF clip = painter()->clipBoundingRect();
    texts.append({item.text(), to_device.map(QPolygonF(letters)),
                  clip.isEmpty() ? QRectF() : to_device.mapRect(clip)});
  }
};

class TextDevice : public QPaintDevice {
 public:
  explicit TextDevice(const QWidget& widget) : widget_(widget) {}
  [[nodiscard]] QPaintEngine* paintEngine() const override { return &engine_; }
  [[nodiscard]] const QList<PaintedText>& texts() const { return engine_.texts; }

 protected:
  [[nodiscard]] int metric(PaintDeviceMetric metric) const override {
    switch (metric) {
      case PdmWidth:
        return widget_.width();
      case PdmHeight:
        return widget_.height();
      case PdmDpiX:
      case PdmPhysicalDpiX:
        return widget_.logicalDpiX();
      case PdmDpiY:
      case PdmPhysicalDpiY:
        return widget_.logicalDpiY();
      case PdmWidthMM:
        return widget_.widthMM();
      case PdmHeightMM:
        return widget_.heightMM();
      case PdmDevicePixelRatio:
        return 1;
      case PdmDevicePixelRatioScaled:
        return static_cast<int>(devicePixelRatioFScale());
      default:
        return 24;  // bits of a colour, and other metrics that texts don't use
    }
  }

 private:
  const QWidget& widget_;
  mutable TextEngine engine_;
};

}  // namespace

QList<PaintedText> painted_texts(QWidget& widget) {
  TextDevice device(widget);
  widget.render(&device, {}, {}, {});
  return device.texts();
}

}  // namespace handway::test
