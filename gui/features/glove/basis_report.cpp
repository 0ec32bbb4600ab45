#include "features/glove/basis_report.h"

#include "handway/geometric/math/units.h"
#include "handway/report/rendering/html.h"
#include "handway/report/studies/basis_study_document.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/color_math.h"
#include "widgets/style/theme.h"

#include <QLabel>
#include <QPainter>
#include <QPolygonF>

#include <algorithm>
#include <string>
#include <utility>

namespace handway::gui {
namespace {

using geometric::kMillimetre;
using sampling::BasisStudy;

constexpr int kScaleWidth = 30;   // px, left of the plane
constexpr int kScaleHeight = 16;  // px, below it
constexpr int kLines = 4;         // across the plane

/// A step of 1, 2 or 5 times a power of ten.
double round_step(double least) {
  double step = 0.1;
  for (int i = 0; step < least; ++i) {
    step *= i % 3 == 1 ? 2.5 : 2.0;
  }
  return step;
}

}  // namespace

ReconstructionChart::ReconstructionChart(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("reconstruction_chart"));
  setAccessibleName(tr("Error at the fingertips by the number of PMDs"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void ReconstructionChart::set_errors(std::vector<sampling::ReconstructionError> errors) {
  errors_ = std::move(errors);
  setVisible(!errors_.empty());
  update();
}

void ReconstructionChart::paintEvent(QPaintEvent*) {
  if (errors_.empty()) {
    return;
  }
  const ThemeColors colors = colors_of(current_theme());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  set_text_size(painter, 10);
  const QRectF area =
      QRectF(rect()).adjusted(scaled(kScaleWidth), scaled(7), -6, -scaled(kScaleHeight));
  const double step = round_step(errors_.front().fingertip.high / kMillimetre / kLines);
  const double top = step * kLines;
  const auto x = [&](std::size_t k) {
    return area.left() + area.width() * static_cast<double>(k) /
                             static_cast<double>(std::max<std::size_t>(errors_.size() - 1, 1));
  };
  const auto y = [&](double error) {
    return area.bottom() - std::min(error / kMillimetre / top, 1.0) * area.height();
  };
  for (int line = 0; line <= kLines; ++line) {
    const double level = area.bottom() - area.height() * line / kLines;
    painter.setPen(QPen(colors.border, 1.0));
    painter.drawLine(QPointF(area.left(), level), QPointF(area.right(), level));
    painter.setPen(colors.text);
    painter.drawText(QRectF(0, level - scaled(7), area.left() - 4, scaled(14)),
                     Qt::AlignRight | Qt::AlignVCenter, QString::number(step * line));
  }
  QPolygonF band;
  QPolygonF mean;
  for (std::size_t k = 0; k < errors_.size(); ++k) {
    band << QPointF(x(k), y(errors_[k].fingertip.high));
    mean << QPointF(x(k), y(errors_[k].fingertip.mean));
    if (k % std::max<std::size_t>(errors_.size() / 6, 1) == 0) {
      painter.drawText(QRectF(x(k) - scaled(10), area.bottom() + 2, scaled(20), scaled(13)),
                       Qt::AlignCenter, QString::number(errors_[k].directions));
    }
  }
  for (std::size_t k = errors_.size(); k-- > 0;) {
    band << QPointF(x(k), y(errors_[k].fingertip.low));
  }
  painter.setPen(Qt::NoPen);
  painter.setBrush(faded(colors.accent, 0.25));
  painter.drawPolygon(band);
  painter.setPen(QPen(colors.accent, 1.6));
  painter.drawPolyline(mean);
}

BasisReportView::BasisReportView(QWidget* parent)
    : QWidget(parent), chart_(new ReconstructionChart), text_(named("basis_report", note())) {
  text_->setWordWrap(true);
  text_->setTextFormat(Qt::RichText);
  lay_out(*this, in_column({chart_, text_, room()}, 6));
  connect(&job_, &LatestJob::failed, this, [this](const QString& message) {
    chart_->set_errors({});
    text_->setText(message.toHtmlEscaped());
  });
  set_input(std::nullopt, {});
}

QString BasisReportView::text() const { return text_->text(); }

void BasisReportView::set_input(std::optional<BasisStudyInput> input, const QString& reason) {
  input_ = std::move(input);
  is_due_ = true;
  if (!input_) {
    job_.cancel();
    chart_->set_errors({});
    text_->setText(reason.toHtmlEscaped());
  } else if (isVisible()) {
    make();
  }
}

void BasisReportView::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  make();
}

void BasisReportView::make() {
  if (!input_ || !std::exchange(is_due_, false)) {
    return;
  }
  job_.run([this, input = *input_](const std::stop_token&) {
    const BasisStudy study =
        sampling::study_basis(input.recordings, input.fingertips, input.settings);
    const std::string text =
        report::to_rich_text(report::basis_study_document(study, input.settings.confidence));
    return [this, study, text] {
      chart_->set_errors(study.reconstruction);
      text_->setText(QString::fromStdString(text));
    };
  });
}

}  // namespace handway::gui
