#include "features/glove/basis_report.h"

#include "handway/geometric/math/units.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/color_math.h"
#include "widgets/style/theme.h"

#include <QLabel>
#include <QPainter>
#include <QPolygonF>
#include <QStringList>

#include <algorithm>
#include <utility>

namespace handway::gui {
namespace {

using geometric::kDegree;
using geometric::kMillimetre;
using sampling::BasisStudy;
using sampling::Interval;

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

namespace {

QString interval_text(const Interval& interval, double unit) {
  return QStringLiteral("%1 (%2–%3)")
      .arg(interval.mean / unit, 0, 'f', 1)
      .arg(interval.low / unit, 0, 'f', 1)
      .arg(interval.high / unit, 0, 'f', 1);
}

QString table(const QStringList& rows) {
  return QStringLiteral("<table cellspacing=0 cellpadding=2>%1</table>").arg(rows.join(QString()));
}

QString row(const QStringList& cells) {
  return QStringLiteral("<tr><td>%1</td></tr>")
      .arg(cells.join(QStringLiteral("</td><td align=right>&nbsp;")));
}

QString enough_text(const BasisStudy& study) {
  QStringList enough;
  for (const double error : sampling::kReportedErrors) {
    const int directions = study.enough_for(error);
    const QString wanted = QString::number(error / kMillimetre);
    enough << (directions < 0 ? QObject::tr("%1 mm: all PMDs are not enough").arg(wanted)
                              : QObject::tr("%1 mm: <b>%2 PMDs</b>").arg(wanted).arg(directions));
  }
  return QObject::tr("Enough for %1").arg(enough.join(QStringLiteral("; ")));
}

QString reconstruction_text(const BasisStudy& study) {
  QStringList rows{row({QObject::tr("PMDs"), QObject::tr("mean, mm"), QObject::tr("95 % below"),
                        QObject::tr("variance")})};
  for (const sampling::ReconstructionError& error : study.reconstruction) {
    rows << row({QString::number(error.directions), interval_text(error.fingertip, kMillimetre),
                 QString::number(error.most / kMillimetre, 'f', 1),
                 QStringLiteral("%1 %").arg(100.0 * error.variance, 0, 'f', 1)});
  }
  return table(rows);
}

QString stability_text(const BasisStudy& study) {
  QStringList head{QObject::tr("s recorded")};
  for (std::size_t k = 1; k <= study.stability.back().angles.size(); ++k) {
    head << (k == 1 ? QObject::tr("PMD 1") : QObject::tr("1 to %1").arg(k));
  }
  QStringList rows{row(head)};
  for (const sampling::BasisStability& stability : study.stability) {
    QStringList cells{QString::number(stability.seconds, 'f', 0)};
    for (const Interval& angle : stability.angles) {
      cells << QStringLiteral("%1° (%2–%3)")
                   .arg(angle.mean / kDegree, 0, 'f', 0)
                   .arg(angle.low / kDegree, 0, 'f', 0)
                   .arg(angle.high / kDegree, 0, 'f', 0);
    }
    rows << row(cells);
  }
  return QObject::tr("<b>Stability</b>: largest angle to the directions of the whole recording") +
         table(rows);
}

QString persons_text(const BasisStudy& study) {
  QStringList rows{row(
      {QObject::tr("mm at the fingertips"), QObject::tr("own basis"), QObject::tr("the others'")})};
  for (const sampling::PersonFit& person : study.persons) {
    rows << row({QString::fromStdString(person.name).toHtmlEscaped(),
                 interval_text(person.own, kMillimetre),
                 interval_text(person.others, kMillimetre)});
  }
  rows << row(
      {QObject::tr("a new person (estimate)"), {}, interval_text(study.newcomer, kMillimetre)});
  return QObject::tr(
             "<b>Persons</b>: each recording with its own basis and with that of the others") +
         table(rows);
}

QString study_text(const BasisStudy& study, double confidence) {
  QString text = QObject::tr(
                     "<b>Number of PMDs</b>: fingertip error for postures not used for the basis "
                     "(%1 % confidence)<br>%2")
                     .arg(100.0 * confidence, 0, 'f', 0)
                     .arg(enough_text(study)) +
                 reconstruction_text(study);
  if (!study.stability.empty()) {
    text += QStringLiteral("<br>") + stability_text(study);
  }
  if (!study.persons.empty()) {
    text += QStringLiteral("<br>") + persons_text(study);
  }
  return text;
}

}  // namespace

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
    return [this, study, text = study_text(study, input.settings.confidence)] {
      chart_->set_errors(study.reconstruction);
      text_->setText(text);
    };
  });
}

}  // namespace handway::gui
