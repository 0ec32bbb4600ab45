#include "features/postures/distance_row.h"

#include "widgets/style/theme.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>

#include <algorithm>

namespace handway::gui {
namespace {

constexpr int kNameWidth = 144;
constexpr int kNumberWidth = 44;
constexpr int kThickness = 6;  // px
constexpr int kMarkHeight = 14;

}  // namespace

class DistanceRow::Bar : public QWidget {
 public:
  void show_distance(std::optional<double> distance, std::optional<double> usual) {
    distance_ = distance;
    usual_ = usual;
    update();
  }
  [[nodiscard]] QSize sizeHint() const override { return {80, kMarkHeight + 4}; }

 protected:
  void paintEvent(QPaintEvent* event) override {
    QWidget::paintEvent(event);
    const ThemeColors colors = colors_of(current_theme());
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    const double top = 0.5 * (height() - kThickness);
    const auto fill = [&](double part, const QColor& color) {
      painter.setBrush(color);
      painter.drawRoundedRect(QRectF(0.0, top, part * width(), kThickness), 3.0, 3.0);
    };
    fill(1.0, colors.border);
    if (distance_) {
      fill(std::clamp(*distance_ / kMost, 0.0, 1.0), colors.accent);
    }
    if (usual_ && *usual_ < kMost) {
      painter.setBrush(colors.text);
      painter.drawRect(
          QRectF(*usual_ / kMost * width() - 1.0, 0.5 * (height() - kMarkHeight), 2, kMarkHeight));
    }
  }

 private:
  std::optional<double> distance_;
  std::optional<double> usual_;
};

DistanceRow::DistanceRow(const QString& name, QWidget* parent)
    : QWidget(parent), bar_(new Bar), number_(new QLabel) {
  auto* label = new QLabel(name);
  label->setFixedWidth(kNameWidth);
  number_->setMinimumWidth(kNumberWidth);
  number_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  layout->addWidget(label);
  layout->addWidget(bar_, 1);
  layout->addWidget(number_);
  show_distance(std::nullopt);
}

void DistanceRow::show_distance(std::optional<double> distance, std::optional<double> usual) {
  bar_->show_distance(distance, usual);
  number_->setText(distance ? QString::number(*distance, 'f', 3) : QString(QChar(0x2013)));
}

QString DistanceRow::text() const { return number_->text(); }

}  // namespace handway::gui
