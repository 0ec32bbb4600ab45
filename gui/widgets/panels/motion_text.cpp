#include "widgets/panels/motion_text.h"

#include "handway/geometric/math/units.h"
#include "widgets/style/theme.h"

#include <QObject>
#include <QStringList>

#include <algorithm>

namespace handway::gui {
namespace {

constexpr std::size_t kMostFaults = 4;
constexpr std::size_t kMostJoints = 4;

QString tr(const char* text) { return QObject::tr(text); }

QString colored(const QString& text, const QColor& color) {
  return QStringLiteral("<b style=\"color:%1\">%2</b>").arg(html(color), text.toHtmlEscaped());
}

QString faults_text(const planning::TimedPath& motion) {
  QString text = colored(tr("Not cleared to run"), colors_of(current_theme()).bad);
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

}  // namespace

QString motion_text(const planning::TimedPath& motion) {
  if (!motion.cleared()) {
    return faults_text(motion);
  }
  const planning::PreflightReport& report = motion.preflight;
  QString text = colored(tr("Cleared to run"), colors_of(current_theme()).good);
  const auto add = [&text](const QString& line) { text += QStringLiteral("<br>") + line; };
  add(tr("%1 s").arg(report.duration, 0, 'f', 2));
  const auto add_share = [&](const QString& line, const planning::LimitShare& share) {
    if (share.share > 0.0) {
      add(line.arg(100.0 * share.share, 0, 'f', 0).arg(QString::fromStdString(share.joint)));
    }
  };
  add_share(tr("Velocity up to %1 % of the limit (%2)"), report.velocity);
  add_share(tr("Acceleration up to %1 % of the limit (%2)"), report.acceleration);
  add(tr("Clearance %1 mm (%2)")
          .arg(report.min_clearance_mm, 0, 'f', 2)
          .arg(QString::fromStdString(report.closest_pair)));
  for (const std::string& line : planning::assumption_lines(report.assumed, kMostJoints)) {
    add(QString::fromStdString(line).toHtmlEscaped());
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
    text = colored(tr("Done in %1 s").arg(outcome.time, 0, 'f', 2), colors.good);
  } else {
    text = colored(tr("Stopped after %1 s").arg(outcome.time, 0, 'f', 2), colors.bad);
    if (!outcome.fault.empty() || !outcome.collision.empty()) {
      text += QStringLiteral("<br>") + cause_of(outcome).toHtmlEscaped();
    }
    text += QStringLiteral("<br>") +
            (outcome.at_rest_ms >= 0.0
                 ? tr("At rest %1 ms after the stop").arg(outcome.at_rest_ms, 0, 'f', 0)
                 : colored(tr("Not seen at rest: look at the robot"), colors.bad));
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
