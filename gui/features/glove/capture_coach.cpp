#include "features/glove/capture_coach.h"

#include "features/glove/capture_hints.h"
#include "features/glove/combination_squares.h"
#include "features/glove/coverage_bars.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/math/units.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QTextDocument>

#include <cmath>

namespace handway::gui {
namespace {

constexpr double kPercentCovered = 100.0;
constexpr double kFirstHint = 5.0;  // s
constexpr double kHintEvery = 1.0;  // s
constexpr int kHintLines = 3;

}  // namespace

CaptureCoach::CaptureCoach(QWidget* parent)
    : QWidget(parent),
      headline_(named("coverage_headline", new QLabel)),
      progress_(new QProgressBar),
      advice_(named("capture_advice", new QLabel)),
      hints_label_(named("capture_hints", new QLabel)),
      bars_(new CoverageBars),
      together_(named("combinations_headline", new QLabel)),
      squares_(new CombinationSquares),
      restart_(named("capture_restart", new QPushButton(tr("Start again")))) {
  restart_->setToolTip(tr("Delete the postures so far"));
  progress_->setTextVisible(false);
  progress_->setFixedHeight(6);
  progress_->setRange(0, 100);
  for (QLabel* label : {headline_, advice_, hints_label_, together_}) {
    label->setTextFormat(Qt::RichText);
  }
  advice_->setWordWrap(true);
  hints_label_->setWordWrap(true);
  hints_label_->setAlignment(Qt::AlignTop);
  hints_label_->setMinimumHeight(fontMetrics().lineSpacing() * kHintLines + 14);
  auto* top = in_column({headline_, progress_, advice_, hints_label_}, 7);
  top->setContentsMargins(12, 10, 12, 6);
  together_->setWordWrap(true);
  together_->setContentsMargins(kSideMargin, 6, kSideMargin, 0);
  auto* bottom = in_column({{restart_, 0, Qt::AlignLeft}});
  bottom->setContentsMargins(12, 6, 12, 0);
  lay_out(*this, in_column({top, bars_, together_, squares_, bottom, room()}, 6), {0, 0, 0, 10});
  connect(restart_, &QPushButton::clicked, this, &CaptureCoach::restart_requested);
  show_progress({});
}

void CaptureCoach::restart(const device::HandMapping& mapping,
                           const std::vector<std::string>& joints,
                           const std::vector<bool>& driven) {
  mapping_ = mapping;
  coverage_.restart(joints, driven);
  combinations_.restart();
  hints_.clear();
  hints_at_ = -1.0;
  show_progress({});
}

void CaptureCoach::add(const Eigen::VectorXd& posture, const device::GloveAngles& angles,
                       const device::PersonRanges& ranges) {
  coverage_.add(posture);
  combinations_.add(angles, ranges);
}

void CaptureCoach::show_progress(const CapturedPostures& postures) {
  bars_->show_coverage(coverage_);
  squares_->show_combinations(combinations_);
  const QString missing = combinations_.missing();
  together_->setText(tr("<b>%1 %</b> of combinations of two fingers")
                         .arg(std::lround(combinations_.share() * kPercentCovered)) +
                     (missing.isEmpty() ? QString() : tr("; try: %1").arg(missing.toLower())));
  const auto percent = static_cast<int>(std::lround(coverage_.share() * kPercentCovered));
  headline_->setText(tr("<b>%1 %</b> of the joints' ranges visited").arg(percent));
  progress_->setValue(percent);
  show_advice(postures);
  show_hints(postures.count() > 0 ? postures.duration() : -1.0);
}

void CaptureCoach::show_advice(const CapturedPostures& postures) {
  const ThemeColors colors = colors_of(current_theme());
  const auto advise = [this](const QString& text, const QColor& color) {
    advice_->setText(dotted(text, color));
  };
  if (postures.count() == 0) {
    advise(tr("Connect a glove, then move your hand freely"), colors.muted);
    return;
  }
  if (!postures.turn()) {
    advise(tr("Keep moving: not enough data yet"), attention_color());
    return;
  }
  const QString turn = tr("%1° in %2 s")
                           .arg(*postures.turn() / geometric::kDegree, 0, 'f', 1)
                           .arg(CapturedPostures::kWindow, 0, 'f', 0);
  if (!postures.has_settled()) {
    advise(tr("Keep moving: the main motion directions turned by %1").arg(turn), attention_color());
  } else if (!hints_.isEmpty()) {
    advise(tr("The main motion directions have settled (%1). Some joints can still go further:")
               .arg(turn),
           colors.good);
  } else {
    advise(tr("Enough: the main motion directions have settled (%1). You can stop.").arg(turn),
           colors.good);
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
  hints_label_->setText(hints_.isEmpty() ? tr("All joints have covered most of their ranges")
                                         : text);
}

QString CaptureCoach::advice() const {
  QTextDocument text;
  text.setHtml(advice_->text());
  return text.toPlainText();
}

}  // namespace handway::gui
