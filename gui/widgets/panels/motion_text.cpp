#include "widgets/panels/motion_text.h"

#include "handway/geometric/math/units.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

#include <QObject>

#include <algorithm>
#include <cstddef>
#include <string>

namespace handway::gui {
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
  QString needed = off.arg(geometric::millimetres(place.following), 0, 'f', 1)
                       .arg(geometric::degrees(place.following_error), 0, 'f', 2);
  if (place.margin > 0.0) {
    needed =
        tr("%1, and %2 mm margin").arg(needed).arg(geometric::millimetres(place.margin), 0, 'f', 1);
  }
  return strong(tr("Cleared, but too close"), attention_color()) + QStringLiteral("<br>") +
         tr("<b>%1</b> and <b>%2</b> are %3 mm apart at %4 s. %5 mm are needed: %6.")
             .arg(QString::fromStdString(place.a).toHtmlEscaped(),
                  QString::fromStdString(place.b).toHtmlEscaped())
             .arg(geometric::millimetres(place.clearance), 0, 'f', 2)
             .arg(place.place, 0, 'f', 2)
             .arg(geometric::millimetres(place.needed()), 0, 'f', 1)
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
            .arg(geometric::millimetres(report.min_clearance), 0, 'f', 2)
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

}  // namespace handway::gui
