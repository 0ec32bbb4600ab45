#include "widgets/panels/result_text.h"

#include "handway/geometric/math/units.h"
#include "model/planning/path_history.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

#include <QObject>
#include <QStringList>

#include <string>
#include <utility>
#include <vector>

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

// Returns the words for a result, as plain text.
struct ResultWords {
  QString headline;
  QStringList paragraphs;
  std::vector<std::pair<QString, QString>> figures;  // names and values
  QStringList notes;
};

ResultWords words_of(const planning::PlanResult& result) {
  ResultWords words;
  const bool searched = !result.solved() && result.status != planning::PlanStatus::kStartInvalid &&
                        result.status != planning::PlanStatus::kGoalInvalid &&
                        result.status != planning::PlanStatus::kCancelled;
  const bool is_proven = result.status == planning::PlanStatus::kInfeasible;
  words.headline = searched && !is_proven && !result.reason.empty() ? QObject::tr("No path found")
                                                                    : status_text(result.status);
  if (!result.reason.empty()) {
    // The headline says it already.
    const QString reason = QString::fromStdString(result.reason);
    const QString stem = QObject::tr("No path found: ");
    words.paragraphs << (reason.startsWith(stem) ? capitalised(reason.mid(stem.size())) : reason);
  }
  for (const std::string& sentence : planning::explain_failure(result)) {
    words.paragraphs << QString::fromStdString(sentence);
  }
  if (result.solved()) {
    words.figures.emplace_back(
        QObject::tr("Clearance"),
        QStringLiteral("≥ %1 mm").arg(geometric::millimetres(result.certificate.min_clearance), 0,
                                      'f', 2));
    words.figures.emplace_back(QObject::tr("Waypoints"), count_text(result.path.waypoints.size()));
  }
  words.figures.emplace_back(QObject::tr("Planning"), seconds_text(result.time_s));
  if (result.solved() && result.smoothing_s > 0.0) {
    words.figures.emplace_back(QObject::tr("Smoothing"), seconds_text(result.smoothing_s));
  }
  words.figures.emplace_back(QObject::tr("Samples"), count_text(result.statistics.samples));
  words.figures.emplace_back(QObject::tr("Nodes"), count_text(result.statistics.nodes));
  for (const planning::OutOfMargin& near : result.out_of_margin) {
    const QString end = near.at_goal ? QObject::tr("goal") : QObject::tr("start");
    words.notes << QObject::tr(
                       "%1 and %2 are %3 mm apart at the %4: near it their clearance is less than "
                       "the margin.")
                       .arg(QString::fromStdString(near.pair.a),
                            QString::fromStdString(near.pair.b))
                       .arg(geometric::millimetres(near.pair.distance), 0, 'f', 2)
                       .arg(end);
  }
  return words;
}

}  // namespace

QString result_text(const planning::PlanResult& result, const QString& note,
                    const std::optional<PathFigures>& figures) {
  const ThemeColors colors = colors_of(current_theme());
  const ResultWords words = words_of(result);
  QString text = headline(words.headline, result.solved() ? colors.good : colors.bad);
  if (!note.isEmpty()) {
    text += paragraph(note);
  }
  for (const QString& sentence : words.paragraphs) {
    text += paragraph(sentence);
  }
  text += begin_table();
  if (figures) {
    text += row(QObject::tr("Motion"), seconds_text(figures->duration));
    if (figures->to_subspace) {
      text += row(QObject::tr("Hand to PMDs"), QString::number(figures->to_subspace->mean, 'f', 3));
    }
  }
  for (const auto& [name, value] : words.figures) {
    text += row(name, value);
  }
  text += QStringLiteral("</table>");
  for (const QString& sentence : words.notes) {
    text += paragraph(sentence);
  }
  return text;
}

QString result_tip(const planning::PlanResult& result) {
  const ResultWords words = words_of(result);
  QStringList lines{words.headline};
  lines << words.paragraphs;
  for (const auto& [name, value] : words.figures) {
    lines << QStringLiteral("%1: %2").arg(name, value);
  }
  lines << words.notes;
  return lines.join(QLatin1Char('\n'));
}

QString replanned_text(const planning::PlanResult& result, const QString& source) {
  const ThemeColors colors = colors_of(current_theme());
  QString text =
      result.solved()
          ? headline(QObject::tr("Path follows the scene"), colors.good) + paragraph(source)
          : headline(QObject::tr("No path in the present scene"), colors.bad) +
                paragraph(QString::fromStdString(result.reason));
  text += begin_table();
  text += row(QObject::tr("Replanned in"), seconds_text(result.time_s + result.smoothing_s));
  if (result.solved()) {
    text += row(QObject::tr("Waypoints"), count_text(result.path.waypoints.size()));
    text += row(QObject::tr("Clearance"),
                QStringLiteral("≥ %1 mm").arg(
                    geometric::millimetres(result.certificate.min_clearance), 0, 'f', 2));
  }
  return text + QStringLiteral("</table>");
}

QString optimizing_text(const OptimizeProgress& progress) {
  QString text = headline(QObject::tr("Optimising the path"), colors_of(current_theme()).good);
  text += begin_table();
  text += row(QObject::tr("Cost"), QObject::tr("%1, before %2")
                                       .arg(progress.cost.cost, 0, 'f', 3)
                                       .arg(progress.cost_before, 0, 'f', 3));
  text += row(QObject::tr("No path below"), QObject::tr("%1, gap at most %2 %")
                                                .arg(progress.cost.least, 0, 'f', 3)
                                                .arg(100.0 * progress.cost.gap(), 0, 'f', 1));
  text += row(QObject::tr("Length"), QStringLiteral("%1").arg(progress.length, 0, 'f', 3));
  if (progress.hand_distance) {
    text += row(QObject::tr("Hand to PMD subspace"),
                QObject::tr("%1 on average").arg(*progress.hand_distance, 0, 'f', 3));
  }
  text += row(QObject::tr("Waypoints"), count_text(progress.path.waypoints.size()));
  text += row(QObject::tr("Time"), QObject::tr("%1 s").arg(progress.seconds, 0, 'f', 1));
  return text + QStringLiteral("</table>");
}

QString failure_text(const QString& message) {
  return headline(QObject::tr("Planning failed"), colors_of(current_theme()).bad) +
         QStringLiteral("<p style=\"margin:0\">%1</p>").arg(message.toHtmlEscaped());
}

}  // namespace handway::gui
