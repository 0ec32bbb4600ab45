#include "features/glove/capture_coach.h"

#include "features/glove/capture_hints.h"
#include "features/glove/coverage_bars.h"
#include "handway/geometric/math/units.h"
#include "widgets/style/glove_colors.h"

#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QTextDocument>
#include <QVBoxLayout>
#include <QVariant>

#include <cmath>

namespace handway::gui {
namespace {

constexpr double kPercent = 100.0;
constexpr double kFirstHint = 5.0;  // s
constexpr double kHintEvery = 1.0;  // s
constexpr int kHintLines = 3;

QString dotted(const QColor& color, const QString& text) {
  return QStringLiteral("<span style=\"color:%1\">●</span>&nbsp; %2")
      .arg(html(color), text.toHtmlEscaped());
}

}  // namespace

CaptureCoach::CaptureCoach(QWidget* parent)
    : QWidget(parent),
      headline_(new QLabel),
      progress_(new QProgressBar),
      advice_(new QLabel),
      hints_label_(new QLabel),
      bars_(new CoverageBars),
      restart_(new QPushButton(tr("Start anew"))) {
  headline_->setObjectName(QStringLiteral("coverage_headline"));
  advice_->setObjectName(QStringLiteral("capture_advice"));
  hints_label_->setObjectName(QStringLiteral("capture_hints"));
  restart_->setObjectName(QStringLiteral("capture_restart"));
  restart_->setToolTip(tr("Forget the postures so far"));
  progress_->setTextVisible(false);
  progress_->setFixedHeight(6);
  progress_->setRange(0, 100);
  advice_->setWordWrap(true);
  hints_label_->setWordWrap(true);
  hints_label_->setAlignment(Qt::AlignTop);
  hints_label_->setMinimumHeight(fontMetrics().lineSpacing() * kHintLines + 14);
  auto* top = new QVBoxLayout;
  top->setContentsMargins(12, 10, 12, 6);
  top->setSpacing(7);
  top->addWidget(headline_);
  top->addWidget(progress_);
  top->addWidget(advice_);
  top->addWidget(hints_label_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 10);
  layout->setSpacing(6);
  layout->addLayout(top);
  layout->addWidget(bars_);
  auto* bottom = new QVBoxLayout;
  bottom->setContentsMargins(12, 6, 12, 0);
  bottom->addWidget(restart_, 0, Qt::AlignLeft);
  layout->addLayout(bottom);
  layout->addStretch();
  connect(restart_, &QPushButton::clicked, this, &CaptureCoach::restart_requested);
  show_progress({});
}

void CaptureCoach::restart(const device::HandMapping& mapping,
                           const std::vector<std::string>& joints,
                           const std::vector<bool>& driven) {
  mapping_ = mapping;
  coverage_.restart(joints, driven);
  hints_.clear();
  hints_at_ = -1.0;
  show_progress({});
}

void CaptureCoach::add(const Eigen::VectorXd& posture) { coverage_.add(posture); }

void CaptureCoach::show_progress(const CapturedPostures& postures) {
  bars_->show_coverage(coverage_);
  const auto percent = static_cast<int>(std::lround(coverage_.share() * kPercent));
  headline_->setText(tr("<b>%1 %</b> of the joints' ranges visited").arg(percent));
  progress_->setValue(percent);
  show_advice(postures);
  show_hints(postures.count() > 0 ? postures.duration() : -1.0);
}

void CaptureCoach::show_advice(const CapturedPostures& postures) {
  const ThemeColors colors = colors_of(current_theme());
  if (postures.count() == 0) {
    advice_->setText(dotted(colors.muted, tr("Connect a glove, then move your hand freely")));
    return;
  }
  if (!postures.turn()) {
    advice_->setText(dotted(attention_color(), tr("Keep moving: too early to tell")));
    return;
  }
  const QString turn = tr("%1° in %2 s")
                           .arg(*postures.turn() / geometric::kDegree, 0, 'f', 1)
                           .arg(CapturedPostures::kWindow, 0, 'f', 0);
  if (!postures.has_settled()) {
    advice_->setText(dotted(attention_color(),
                            tr("Keep moving: the main motion directions turned by %1").arg(turn)));
  } else if (!hints_.isEmpty()) {
    advice_->setText(dotted(
        colors.good, tr("The main motion directions have settled (%1). Some joints can still go "
                        "further:")
                         .arg(turn)));
  } else {
    advice_->setText(dotted(
        colors.good,
        tr("Enough: the main motion directions have settled (%1). You can stop.").arg(turn)));
  }
}

// Hints stay long enough to be read.
void CaptureCoach::show_hints(double duration) {
  if (duration < 0.0) {
    hints_label_->setText({});
    return;
  }
  if (duration < kFirstHint) {
    hints_label_->setText(
        tr("Open and close the hand, spread the fingers, bring the thumb across "
           "the palm"));
    return;
  }
  if (hints_at_ >= 0.0 && duration < hints_at_ + kHintEvery) {
    return;
  }
  hints_at_ = duration;
  hints_ = capture_hints(coverage_, mapping_, kHintLines);
  QString text;
  for (const QString& hint : hints_) {
    text += QStringLiteral("<div>→&nbsp; %1</div>").arg(hint.toHtmlEscaped());
  }
  hints_label_->setText(hints_.isEmpty() ? tr("All joints have been through most of their ranges")
                                         : text);
}

QString CaptureCoach::advice() const {
  QTextDocument text;
  text.setHtml(advice_->text());
  return text.toPlainText();
}

}  // namespace handway::gui
