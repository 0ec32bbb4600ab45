#include "widgets/panels/result_text.h"

#include "handway/geometric/math/units.h"
#include "handway/planning/queries/failure_explanation.h"
#include "widgets/style/theme.h"

#include <QLocale>

namespace handway::gui {
namespace {

QString headline(const QString& text, const QColor& color) {
  return QStringLiteral("<p style=\"margin:0 0 6px 0\"><b style=\"color:%1\">%2</b></p>")
      .arg(html(color), text);
}

QString paragraph(const QString& text) {
  return QStringLiteral("<p style=\"margin:0 0 6px 0\">%1</p>").arg(text.toHtmlEscaped());
}

QString capitalised(const QString& text) { return text.left(1).toUpper() + text.mid(1); }

// Below a paragraph, whose lower margin counts for nothing there.
QString begin_table() {
  return QStringLiteral("<table cellspacing=\"0\" cellpadding=\"1\" style=\"margin-top:6px\">");
}

QString row(const QString& name, const QString& value) {
  return QStringLiteral(
             "<tr><td style=\"color:%1;padding-right:14px\">%2</td><td "
             "align=\"right\">%3</td></tr>")
      .arg(html(colors_of(current_theme()).muted), name, value);
}

QString seconds(double value) {
  return value < 1.0 ? QStringLiteral("%1 ms").arg(value * 1e3, 0, 'f', 0)
                     : QStringLiteral("%1 s").arg(value, 0, 'f', 2);
}

QString count(std::uint64_t value) {
  return QLocale(QLocale::English).toString(static_cast<qulonglong>(value));
}

}  // namespace

QString status_text(planning::PlanStatus status) {
  switch (status) {
    case planning::PlanStatus::kSolved:
      return QObject::tr("Path found");
    case planning::PlanStatus::kStartInvalid:
      return QObject::tr("The start is not valid");
    case planning::PlanStatus::kGoalInvalid:
      return QObject::tr("The goal is not valid");
    case planning::PlanStatus::kSamplesSpent:
      return QObject::tr("No path found: the samples are used up");
    case planning::PlanStatus::kTimeLimit:
      return QObject::tr("No path found in the time given");
    case planning::PlanStatus::kCancelled:
      return QObject::tr("Cancelled");
    case planning::PlanStatus::kStalled:
      return QObject::tr("No path found: nothing is left to sample");
    case planning::PlanStatus::kInfeasible:
      return QObject::tr("There is no path");
  }
  return {};
}

QString result_text(const planning::PlanResult& result, const QString& note) {
  const ThemeColors colors = colors_of(current_theme());
  const bool searched = !result.solved() && result.status != planning::PlanStatus::kStartInvalid &&
                        result.status != planning::PlanStatus::kGoalInvalid &&
                        result.status != planning::PlanStatus::kCancelled;
  const bool is_proven = result.status == planning::PlanStatus::kInfeasible;
  QString text =
      headline(searched && !is_proven && !result.reason.empty() ? QObject::tr("No path found")
                                                                : status_text(result.status),
               result.solved() ? colors.good : colors.bad);
  if (!note.isEmpty()) {
    text += paragraph(note);
  }
  if (!result.reason.empty()) {
    // The headline says it already.
    const QString reason = QString::fromStdString(result.reason);
    const QString stem = QObject::tr("No path found: ");
    text += paragraph(reason.startsWith(stem) ? capitalised(reason.mid(stem.size())) : reason);
  }
  for (const std::string& sentence : planning::explain_failure(result)) {
    text += paragraph(QString::fromStdString(sentence));
  }
  text += begin_table();
  text += row(QObject::tr("Planning"), seconds(result.time_s));
  if (result.solved() && result.smoothing_s > 0.0) {
    text += row(QObject::tr("Smoothing"), seconds(result.smoothing_s));
  }
  text += row(QObject::tr("Samples"), count(result.statistics.samples));
  text += row(QObject::tr("Nodes"), count(result.statistics.nodes));
  if (result.solved()) {
    text += row(QObject::tr("Waypoints"), count(result.path.waypoints.size()));
    text += row(QObject::tr("Clearance"),
                QStringLiteral("≥ %1 mm").arg(result.certificate.min_clearance_mm, 0, 'f', 2));
  }
  text += QStringLiteral("</table>");
  for (const planning::OutOfMargin& near : result.out_of_margin) {
    const QString end = near.at_goal ? QObject::tr("goal") : QObject::tr("start");
    text +=
        paragraph(QObject::tr("%1 and %2 are %3 mm apart at the %4: next to it they keep less "
                              "than the margin.")
                      .arg(QString::fromStdString(near.pair.a), QString::fromStdString(near.pair.b))
                      .arg(geometric::millimetres(near.pair.distance), 0, 'f', 2)
                      .arg(end));
  }
  return text;
}

QString replanned_text(const planning::PlanResult& result, const QString& way) {
  const ThemeColors colors = colors_of(current_theme());
  QString text = result.solved()
                     ? headline(QObject::tr("Path follows the scene"), colors.good)
                     : headline(QObject::tr("No path in the scene as it is now"), colors.bad) +
                           paragraph(QString::fromStdString(result.reason));
  text += begin_table();
  text += row(QObject::tr("Planning again"), seconds(result.time_s + result.smoothing_s));
  if (result.solved()) {
    text += row(QObject::tr("From"), way);
    text += row(QObject::tr("Waypoints"), count(result.path.waypoints.size()));
    text += row(QObject::tr("Clearance"),
                QStringLiteral("≥ %1 mm").arg(result.certificate.min_clearance_mm, 0, 'f', 2));
  }
  return text + QStringLiteral("</table>");
}

QString optimizing_text(const OptimizeProgress& progress) {
  QString text = headline(QObject::tr("Optimising the path"), colors_of(current_theme()).good);
  text += begin_table();
  text += row(QObject::tr("Cost"), QObject::tr("%1, %2 before")
                                       .arg(progress.cost, 0, 'f', 3)
                                       .arg(progress.cost_before, 0, 'f', 3));
  text += row(QObject::tr("Length"), QStringLiteral("%1").arg(progress.length, 0, 'f', 3));
  if (progress.hand_distance) {
    text += row(QObject::tr("Hand to PMD subspace"),
                QObject::tr("%1 on average").arg(*progress.hand_distance, 0, 'f', 3));
  }
  text += row(QObject::tr("Waypoints"), count(progress.path.waypoints.size()));
  text += row(QObject::tr("Time"), QObject::tr("%1 s").arg(progress.seconds, 0, 'f', 1));
  return text + QStringLiteral("</table>");
}

QString result_line(const planning::PlanResult& result) {
  if (result.solved()) {
    return QObject::tr("Path found in %1, %2 waypoints")
        .arg(seconds(result.time_s), count(result.path.waypoints.size()));
  }
  return result.reason.empty() ? status_text(result.status) : QString::fromStdString(result.reason);
}

QString failure_text(const QString& message) {
  return headline(QObject::tr("Planning failed"), colors_of(current_theme()).bad) +
         QStringLiteral("<p style=\"margin:0\">%1</p>").arg(message.toHtmlEscaped());
}

}  // namespace handway::gui
