#include "widgets/panels/run_table.h"

#include "handway/geometric/math/units.h"
#include "handway/planning/core/plan_result.h"
#include "model/planning/path_history.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

#include <QFont>
#include <QHeaderView>
#include <QObject>
#include <QSortFilterProxyModel>
#include <QStringList>

#include <algorithm>
#include <utility>

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

// What is said of a result, as plain text.
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
  words.figures.emplace_back(QObject::tr("Planning"), seconds_text(result.time_s));
  if (result.solved() && result.smoothing_s > 0.0) {
    words.figures.emplace_back(QObject::tr("Smoothing"), seconds_text(result.smoothing_s));
  }
  words.figures.emplace_back(QObject::tr("Samples"), count_text(result.statistics.samples));
  words.figures.emplace_back(QObject::tr("Nodes"), count_text(result.statistics.nodes));
  if (result.solved()) {
    words.figures.emplace_back(QObject::tr("Waypoints"), count_text(result.path.waypoints.size()));
    words.figures.emplace_back(
        QObject::tr("Clearance"),
        QStringLiteral("≥ %1 mm").arg(result.certificate.min_clearance_mm, 0, 'f', 2));
  }
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

QString result_text(const planning::PlanResult& result, const QString& note) {
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
                QStringLiteral("≥ %1 mm").arg(result.certificate.min_clearance_mm, 0, 'f', 2));
  }
  return text + QStringLiteral("</table>");
}

QString optimizing_text(const OptimizeProgress& progress) {
  QString text = headline(QObject::tr("Optimising the path"), colors_of(current_theme()).good);
  text += begin_table();
  text += row(QObject::tr("Cost"), QObject::tr("%1, before %2")
                                       .arg(progress.cost, 0, 'f', 3)
                                       .arg(progress.cost_before, 0, 'f', 3));
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

namespace {

constexpr std::size_t kMostFaults = 4;
constexpr std::size_t kMostJoints = 4;

QString tr(const char* text) { return QObject::tr(text); }

QString strong(const QString& text, const QColor& color) {
  return QStringLiteral("<b style=\"color:%1\">%2</b>").arg(html(color), text.toHtmlEscaped());
}

QString faults_text(const planning::TimedPath& motion) {
  QString text = strong(tr("Not cleared to run"), colors_of(current_theme()).bad);
  const auto& faults = motion.preflight.faults;
  for (std::size_t i = 0; i < std::min(faults.size(), kMostFaults); ++i) {
    text += QStringLiteral("<br>") + QString::fromStdString(faults[i].text).toHtmlEscaped();
  }
  if (faults.size() > kMostFaults) {
    text += QStringLiteral("<br>") + tr("and %1 more").arg(faults.size() - kMostFaults);
  }
  if (faults.empty()) {
    text += QStringLiteral("<br>") + QString::fromStdString(motion.blends.fault).toHtmlEscaped();
  }
  return text;
}

QString shortfall_text(const planning::PreflightReport& report) {
  const planning::ClearanceShortfall& place = *report.shortfall;
  const QString off =
      report.assumed_following_error
          ? tr("%1 mm for a following error of up to %2° (assumed; none was measured)")
          : tr("%1 mm for the measured following error of up to %2°");
  QString needed = off.arg(place.following_mm, 0, 'f', 1)
                       .arg(geometric::degrees(place.following_error), 0, 'f', 2);
  if (place.margin_mm > 0.0) {
    needed = tr("%1, and %2 mm margin").arg(needed).arg(place.margin_mm, 0, 'f', 1);
  }
  return strong(tr("Cleared, but too close"), attention_color()) + QStringLiteral("<br>") +
         tr("<b>%1</b> and <b>%2</b> are %3 mm apart at %4 s. %5 mm are needed: %6.")
             .arg(QString::fromStdString(place.a).toHtmlEscaped(),
                  QString::fromStdString(place.b).toHtmlEscaped())
             .arg(place.clearance_mm, 0, 'f', 2)
             .arg(place.place, 0, 'f', 2)
             .arg(place.needed_mm(), 0, 'f', 1)
             .arg(needed) +
         QStringLiteral("<br>") + QString::fromStdString(report.advice()).toHtmlEscaped();
}

}  // namespace

QString motion_text(const planning::TimedPath& motion) {
  if (!motion.cleared()) {
    return faults_text(motion);
  }
  const planning::PreflightReport& report = motion.preflight;
  QString text = report.is_tight() ? shortfall_text(report)
                                   : strong(tr("Cleared to run"), colors_of(current_theme()).good);
  const auto add = [&text](const QString& line) { text += QStringLiteral("<br>") + line; };
  add(tr("The motion takes %1 s.").arg(report.duration, 0, 'f', 2));
  const auto add_share = [&](const QString& line, const planning::LimitShare& share) {
    if (share.share > 0.0) {
      add(line.arg(100.0 * share.share, 0, 'f', 0)
              .arg(QString::fromStdString(share.joint).toHtmlEscaped()));
    }
  };
  add_share(tr("The velocity is at most %1 % of its limit (joint %2)."), report.velocity);
  add_share(tr("The acceleration is at most %1 % of its limit (joint %2)."), report.acceleration);
  if (report.closest_pair.empty()) {
    add(tr("Robot and objects stay more than 50 mm apart."));
  } else {
    add(tr("The smallest clearance is %1 mm, at %2 s (%3).")
            .arg(report.min_clearance_mm, 0, 'f', 2)
            .arg(report.min_clearance_time, 0, 'f', 2)
            .arg(QString::fromStdString(report.closest_pair).toHtmlEscaped()));
  }
  for (const std::string& line : planning::assumption_lines(report.assumed, kMostJoints)) {
    const QString words = QString::fromStdString(line).toHtmlEscaped();
    add(words.left(1).toUpper() + words.mid(1) + QLatin1Char('.'));
  }
  return text;
}

QString cause_of(const execution::MotionOutcome& outcome) {
  const std::string& cause = outcome.collision.empty() ? outcome.fault : outcome.collision;
  return cause.empty() ? tr("on request") : QString::fromStdString(cause);
}

QString outcome_text(const execution::MotionOutcome& outcome) {
  const ThemeColors colors = colors_of(current_theme());
  QString text;
  if (outcome.done) {
    text = strong(tr("Done in %1 s").arg(outcome.time, 0, 'f', 2), colors.good);
  } else {
    text = strong(tr("Stopped after %1 s").arg(outcome.time, 0, 'f', 2), colors.bad);
    if (!outcome.fault.empty() || !outcome.collision.empty()) {
      text += QStringLiteral("<br>") + cause_of(outcome).toHtmlEscaped();
    }
    text += QStringLiteral("<br>") +
            (outcome.at_rest_ms >= 0.0
                 ? tr("At rest %1 ms after the stop").arg(outcome.at_rest_ms, 0, 'f', 0)
                 : strong(tr("Rest not confirmed: look at the robot"), colors.bad));
  }
  double error = 0.0;
  for (const execution::FollowingError& device : outcome.errors) {
    error = std::max(error, device.max().maxCoeff());
  }
  return text + QStringLiteral("<br>") +
         tr("Largest following error %1° (%2 rad)")
             .arg(geometric::degrees(error), 0, 'f', 2)
             .arg(error, 0, 'f', 4);
}

namespace {

template <typename Value>
QVariant known(const std::optional<Value>& value) {
  return value ? QVariant::fromValue(*value) : QVariant();
}

QVariant known(const std::optional<std::uint64_t>& value) {
  return value ? QVariant(static_cast<qulonglong>(*value)) : QVariant();
}

QVariant value_of(const RunRow& row, int column) {
  switch (column) {
    case RunTable::kNumber:
      return row.number;
    case RunTable::kPlanner:
      return row.planner;
    case RunTable::kPreset:
      return row.preset;
    case RunTable::kSeed:
      return static_cast<qulonglong>(row.seed);
    case RunTable::kTime:
      return row.time_s;
    case RunTable::kOutcome:
      return row.outcome;
    case RunTable::kSamples:
      return known(row.samples);
    case RunTable::kNodes:
      return known(row.nodes);
    case RunTable::kLength:
      return known(row.length);
    case RunTable::kDuration:
      return known(row.duration);
    case RunTable::kClearance:
      return known(row.clearance);
    case RunTable::kHandDistance:
      return known(row.hand_distance);
    default:
      return {};
  }
}

int decimals_of(int column) {
  return column == RunTable::kTime || column == RunTable::kHandDistance ? 3 : 2;
}

QVariant text_of(const RunRow& row, int column) {
  const QVariant value = value_of(row, column);
  if (!value.isValid()) {
    return QStringLiteral("–");
  }
  return value.type() == QVariant::Double
             ? QString::number(value.toDouble(), 'f', decimals_of(column))
             : value;
}

bool is_words(int column) {
  return column == RunTable::kPlanner || column == RunTable::kPreset ||
         column == RunTable::kOutcome;
}

}  // namespace

void RunTable::clear() { set_rows({}); }

void RunTable::set_rows(std::vector<RunRow> rows) {
  beginResetModel();
  rows_ = std::move(rows);
  endResetModel();
}

void RunTable::add(const std::vector<RunRow>& rows) {
  if (rows.empty()) {
    return;
  }
  const int first = rowCount();
  beginInsertRows({}, first, first + static_cast<int>(rows.size()) - 1);
  rows_.insert(rows_.end(), rows.begin(), rows.end());
  endInsertRows();
}

int RunTable::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

int RunTable::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(kColumns);
}

QVariant RunTable::data(const QModelIndex& index, int role) const {
  const RunRow& row = rows_[static_cast<std::size_t>(index.row())];
  if (role == Qt::DisplayRole) {
    return text_of(row, index.column());
  }
  if (role == kSortRole) {
    return value_of(row, index.column());
  }
  if (role == Qt::TextAlignmentRole) {
    return static_cast<int>((is_words(index.column()) ? Qt::AlignLeft : Qt::AlignRight) |
                            Qt::AlignVCenter);
  }
  if (role == Qt::ToolTipRole) {
    return row.tip;
  }
  if (role == Qt::FontRole && row.stands_out) {
    QFont bold;
    bold.setBold(true);
    return bold;
  }
  return {};
}

QVariant RunTable::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) {
    return {};
  }
  if (role == Qt::TextAlignmentRole) {
    return static_cast<int>((is_words(section) ? Qt::AlignLeft : Qt::AlignRight) |
                            Qt::AlignVCenter);
  }
  if (role == Qt::ToolTipRole && section == kHandDistance) {
    return tr(
        "Mean distance of the hand from the nearest recorded posture of a person, or from the "
        "principal motion directions if none is recorded; smaller is more human-like");
  }
  if (role == Qt::ToolTipRole && section == kLength) {
    return tr("Length in joints normalised to [0, 1]");
  }
  if (role != Qt::DisplayRole) {
    return {};
  }
  switch (section) {
    case kNumber:
      return tr("Run");
    case kPlanner:
      return tr("Planner");
    case kPreset:
      return tr("Preset");
    case kSeed:
      return tr("Seed");
    case kTime:
      return tr("Time [s]");
    case kOutcome:
      return tr("Outcome");
    case kSamples:
      return tr("Samples");
    case kNodes:
      return tr("Nodes");
    case kLength:
      return tr("Length");
    case kDuration:
      return tr("Motion [s]");
    case kClearance:
      return tr("Clearance [mm]");
    case kHandDistance:
      return tr("Hand");
    default:
      return {};
  }
}

namespace {

constexpr int kRowHeight = 24;  // px
constexpr int kLeastColumn = 36;

// Wide enough for what is usually there, px.
int width_of(int column) {
  switch (column) {
    case RunTable::kNumber:
      return 46;
    case RunTable::kPlanner:
      return 104;
    case RunTable::kPreset:
      return 84;
    case RunTable::kSeed:
      return 50;
    case RunTable::kOutcome:
      return 106;
    case RunTable::kDuration:
      return 78;
    case RunTable::kClearance:
      return 112;
    default:
      return 64;
  }
}

}  // namespace

RunView::RunView(QSortFilterProxyModel& runs, std::initializer_list<RunTable::Column> columns,
                 QWidget* parent)
    : QTableView(parent) {
  runs.setSortRole(RunTable::kSortRole);
  setModel(&runs);
  for (int column = 0; column < RunTable::kColumns; ++column) {
    setColumnHidden(column, std::ranges::find(columns, column) == columns.end());
  }
  for (int column = 0; column < RunTable::kColumns; ++column) {
    setColumnWidth(column, scaled(width_of(column)));
  }
  setSortingEnabled(true);
  setSelectionBehavior(QAbstractItemView::SelectRows);
  setSelectionMode(QAbstractItemView::SingleSelection);
  setEditTriggers(QAbstractItemView::NoEditTriggers);
  setShowGrid(false);
  setWordWrap(false);
  setProperty("role", "runs");
  verticalHeader()->hide();
  verticalHeader()->setDefaultSectionSize(scaled(kRowHeight));
  horizontalHeader()->setHighlightSections(false);
  horizontalHeader()->setMinimumSectionSize(scaled(kLeastColumn));
}

}  // namespace handway::gui
