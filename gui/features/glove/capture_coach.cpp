#include "features/glove/capture_coach.h"

#include "handway/device/glove/calibration_fit.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/human_hand.h"
#include "handway/geometric/math/units.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/color_math.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

#include <QLabel>
#include <QObject>
#include <QPainter>
#include <QProgressBar>
#include <QPushButton>
#include <QTextDocument>
#include <QVariant>

#include <algorithm>
#include <cmath>

namespace handway::gui {
double JointVisits::share() const {
  return static_cast<double>(std::ranges::count(visited, true)) / kBins;
}

void JointCoverage::restart(const std::vector<std::string>& joints,
                            const std::vector<bool>& driven) {
  joints_.assign(joints.size(), {});
  for (std::size_t j = 0; j < joints.size(); ++j) {
    joints_[j].joint = joints[j];
    joints_[j].driven = driven[j];
  }
}

void JointCoverage::add(const Eigen::VectorXd& posture) {
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    JointVisits& visits = joints_[j];
    visits.now = std::clamp(posture[static_cast<Eigen::Index>(j)], 0.0, 1.0);
    visits.least = std::min(visits.least, visits.now);
    visits.most = std::max(visits.most, visits.now);
    const int bin =
        std::min(static_cast<int>(visits.now * JointVisits::kBins), JointVisits::kBins - 1);
    visits.visited.at(static_cast<std::size_t>(bin)) = true;
  }
}

double JointCoverage::share() const {
  double sum = 0.0;
  int driven = 0;
  for (const JointVisits& visits : joints_) {
    if (visits.driven) {
      sum += visits.share();
      ++driven;
    }
  }
  return driven > 0 ? sum / driven : 0.0;
}

namespace {

constexpr int kRowHeight = 21;
constexpr int kSideMargin = 12;
constexpr int kNameWidth = 118;
constexpr int kPercentWidth = 44;
constexpr int kBarHeight = 9;
constexpr double kPercentPerShare = 100.0;

}  // namespace

QString joint_label(const std::string& joint) {
  QString text = QString::fromStdString(joint).replace(QLatin1Char('_'), QLatin1Char(' '));
  if (!text.isEmpty()) {
    text[0] = text[0].toUpper();
  }
  return text;
}

CoverageBars::CoverageBars(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("coverage_bars"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setToolTip(tr("Range of each joint: the visited part is filled, the line is the present value"));
}

void CoverageBars::show_coverage(const JointCoverage& coverage) {
  const bool other_size = coverage.joints().size() != joints_.size();
  joints_ = coverage.joints();
  if (other_size) {
    updateGeometry();
  }
  update();
}

QSize CoverageBars::sizeHint() const {
  return {scaled(300), static_cast<int>(joints_.size()) * scaled(kRowHeight)};
}

void CoverageBars::paintEvent(QPaintEvent*) {
  const ThemeColors colors = colors_of(current_theme());
  QPainter painter(this);
  set_text_size(painter, 12);
  const int bar_x = kSideMargin + scaled(kNameWidth);
  const int bar_width = width() - bar_x - scaled(kPercentWidth) - kSideMargin;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const JointVisits& visits = joints_[j];
    const int top = static_cast<int>(j) * scaled(kRowHeight);
    painter.setPen(visits.driven ? colors.text : colors.muted);
    painter.drawText(QRect(kSideMargin, top, scaled(kNameWidth), scaled(kRowHeight)),
                     Qt::AlignVCenter, joint_label(visits.joint));
    const QRectF bar(bar_x, top + (scaled(kRowHeight) - kBarHeight) / 2.0, bar_width, kBarHeight);
    painter.fillRect(bar, faded(colors.border, visits.driven ? 0.7 : 0.35));
    const double bin = bar.width() / JointVisits::kBins;
    for (int b = 0; b < JointVisits::kBins && visits.driven; ++b) {
      if (visits.visited.at(static_cast<std::size_t>(b))) {
        const int begin = b;
        while (b + 1 < JointVisits::kBins && visits.visited.at(static_cast<std::size_t>(b) + 1)) {
          ++b;
        }
        painter.fillRect(
            QRectF(bar.left() + begin * bin, bar.top(), (b + 1 - begin) * bin, bar.height()),
            faded(colors.accent, 0.85));
      }
    }
    const bool begun = visits.most >= visits.least;
    if (begun && visits.driven) {
      const double x = bar.left() + visits.now * (bar.width() - 2.0);
      painter.fillRect(QRectF(x, bar.top() - 3.0, 2.0, bar.height() + 6.0), colors.text);
    }
    const QRect percent(width() - kSideMargin - scaled(kPercentWidth), top, scaled(kPercentWidth),
                        scaled(kRowHeight));
    painter.setPen(colors.muted);
    painter.drawText(
        percent, Qt::AlignVCenter | Qt::AlignRight,
        visits.driven ? QStringLiteral("%1 %").arg(std::lround(visits.share() * kPercentPerShare))
                      : tr("fixed"));
  }
}

namespace {

using device::Finger;

constexpr int kBent = FingerCombinations::kStates - 1;
constexpr double kHalf = 0.33;  // of a typical joint's flexion, and kMostly: where states end
constexpr double kMostly = 0.67;

/// Sensors whose mean says how bent a finger is, indices into cyberglove_sensors().
const std::array<std::vector<int>, device::kFingers>& bending_sensors() {
  static const auto kSensors = [] {
    std::array<std::vector<int>, device::kFingers> sensors;
    const std::array<std::vector<const char*>, device::kFingers> names{
        {{"ThumbRotate", "ThumbIJ"},
         {"IndexMPJ", "IndexPIJ"},
         {"MiddleMPJ", "MiddlePIJ"},
         {"RingMPJ", "RingPIJ"},
         {"PinkieMPJ", "PinkiePIJ"}}};
    for (std::size_t f = 0; f < names.size(); ++f) {
      for (const char* name : names.at(f)) {
        sensors.at(f).push_back(device::find_sensor(name).value());
      }
    }
    return sensors;
  }();
  return kSensors;
}

std::optional<int> state_of(std::size_t finger, const device::GloveAngles& angles,
                            const device::PersonRanges& ranges) {
  double sum = 0.0;
  int count = 0;
  for (const int sensor : bending_sensors().at(finger)) {
    const auto place = static_cast<std::size_t>(sensor);
    if (std::isfinite(angles.angles.at(place))) {
      sum += device::typical_angle(ranges, sensor, angles.angles.at(place)) /
             device::typical_angle_ranges().at(place).second;
      ++count;
    }
  }
  if (count == 0) {
    return std::nullopt;
  }
  const double bent = sum / count;
  return bent > kMostly ? kBent : bent > kHalf ? 1 : 0;
}

QString finger_label(std::size_t finger) {
  const std::string& name = device::name_of(static_cast<Finger>(finger));
  return joint_label(name);
}

}  // namespace

void FingerCombinations::add(const device::GloveAngles& angles,
                             const device::PersonRanges& ranges) {
  std::array<std::optional<int>, device::kFingers> states;
  for (std::size_t f = 0; f < states.size(); ++f) {
    states.at(f) = state_of(f, angles, ranges);
    measured_.at(f) = measured_.at(f) || states.at(f);
  }
  for (std::size_t a = 0; a < states.size(); ++a) {
    for (std::size_t b = a + 1; b < states.size(); ++b) {
      if (states.at(a) && states.at(b)) {
        cells_.at(a).at(b).at(static_cast<std::size_t>(*states.at(a) * kStates + *states.at(b))) =
            true;
      }
    }
  }
}

bool FingerCombinations::visited(Finger a, int state_of_a, Finger b, int state_of_b) const {
  return cells_.at(static_cast<std::size_t>(a))
      .at(static_cast<std::size_t>(b))
      .at(static_cast<std::size_t>(state_of_a * kStates + state_of_b));
}

double FingerCombinations::share() const {
  std::ptrdiff_t filled = 0;
  std::size_t all = 0;
  for (std::size_t a = 0; a < cells_.size(); ++a) {
    for (std::size_t b = a + 1; b < cells_.size(); ++b) {
      if (measured_.at(a) && measured_.at(b)) {
        filled += std::ranges::count(cells_.at(a).at(b), true);
        all += cells_.at(a).at(b).size();
      }
    }
  }
  return all > 0 ? static_cast<double>(filled) / static_cast<double>(all) : 0.0;
}

QString FingerCombinations::missing() const {
  for (std::size_t a = 0; a < cells_.size(); ++a) {
    for (std::size_t b = a + 1; b < cells_.size(); ++b) {
      if (!measured_.at(a) || !measured_.at(b)) {
        continue;
      }
      const auto text = QObject::tr("%1 bent, %2 straight");
      if (!visited(static_cast<Finger>(a), kBent, static_cast<Finger>(b), 0)) {
        return text.arg(finger_label(a), finger_label(b).toLower());
      }
      if (!visited(static_cast<Finger>(a), 0, static_cast<Finger>(b), kBent)) {
        return text.arg(finger_label(b), finger_label(a).toLower());
      }
    }
  }
  return {};
}

namespace {

constexpr int kSquare = 42;        // px, of two fingers
constexpr int kSquareGap = 10;     // px
constexpr int kFingerWidth = 62;   // px, of a finger's name
constexpr int kFingerHeight = 18;  // px

}  // namespace

CombinationSquares::CombinationSquares(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("combination_squares"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setToolTip(
      tr("A square for each pair of fingers, from straight to bent along both axes; visited "
         "combinations are filled"));
}

void CombinationSquares::show_combinations(const FingerCombinations& combinations) {
  combinations_ = combinations;
  update();
}

QSize CombinationSquares::sizeHint() const {
  const int squares = (device::kFingers - 1) * scaled(kSquare + kSquareGap);
  return {kSideMargin + scaled(kFingerWidth) + squares, scaled(kFingerHeight) + squares};
}

void CombinationSquares::paintEvent(QPaintEvent*) {
  const ThemeColors colors = colors_of(current_theme());
  QPainter painter(this);
  set_text_size(painter, 12);
  const int step = scaled(kSquare + kSquareGap);
  const double cell = scaled(kSquare) / static_cast<double>(FingerCombinations::kStates);
  for (int a = 0; a < device::kFingers; ++a) {
    for (int b = a + 1; b < device::kFingers; ++b) {
      const int x = kSideMargin + scaled(kFingerWidth) + a * step;
      const int y = scaled(kFingerHeight) + (b - 1) * step;
      for (int i = 0; i < FingerCombinations::kStates; ++i) {
        for (int j = 0; j < FingerCombinations::kStates; ++j) {
          const bool visited =
              combinations_.visited(static_cast<Finger>(a), i, static_cast<Finger>(b), j);
          painter.fillRect(QRectF(x + i * cell, y + j * cell, cell - 1.0, cell - 1.0),
                           visited ? faded(colors.accent, 0.85) : faded(colors.border, 0.7));
        }
      }
      painter.setPen(colors.text);
      if (b == a + 1) {
        painter.drawText(QRect(x, y - scaled(kFingerHeight), step, scaled(kFingerHeight)),
                         Qt::AlignVCenter, finger_label(static_cast<std::size_t>(a)));
      }
      if (a == 0) {
        painter.drawText(QRect(kSideMargin, y, scaled(kFingerWidth), scaled(kSquare)),
                         Qt::AlignVCenter, finger_label(static_cast<std::size_t>(b)));
      }
    }
  }
}

namespace {

constexpr double kHardly = 0.2;   // of the joint's range
constexpr double kLittle = 0.5;   // of the joint's range
constexpr double kMissing = 0.3;  // of the joint's range, at one end
constexpr const char* kSpreading = "jnr";
constexpr const char* kFingerBending = "ghklopst";
constexpr char kThumbRoll = 'c';

bool is_in(const char* letters, char letter) {
  return std::string_view(letters).find(letter) != std::string_view::npos;
}

// One joint that a sensor drives, in terms of the person's hand.
struct Moved {
  char letter = ' ';
  QString label;
  double range = 0.0;
  double not_bent = 0.0;       // of the range, missing at the end where the sensor's angle is large
  double not_stretched = 0.0;  // at the other end
};

bool rises(const device::JointMapping& mapped) {
  return mapped.curve.empty() ? mapped.gain > 0.0
                              : mapped.curve.back().joint > mapped.curve.front().joint;
}

std::vector<Moved> moved_joints(const JointCoverage& coverage, const device::HandMapping& mapping) {
  std::vector<Moved> result;
  for (const JointVisits& visits : coverage.joints()) {
    const auto mapped =
        std::ranges::find(mapping.joints, visits.joint, &device::JointMapping::joint);
    if (!visits.driven || mapped == mapping.joints.end() || mapped->sensor < 0) {
      continue;
    }
    const auto& sensor = device::cyberglove_sensors()[static_cast<std::size_t>(mapped->sensor)];
    Moved moved{sensor.letter,
                QString::fromUtf8(sensor.label.data(), static_cast<int>(sensor.label.size())),
                visits.range(), 1.0 - visits.most, visits.least};
    if (!rises(*mapped)) {
      std::swap(moved.not_bent, moved.not_stretched);
    }
    if (std::ranges::count(result, moved.letter, &Moved::letter) == 0) {
      result.push_back(moved);
    }
  }
  return result;
}

// Returns whether at least half of the finger-bending joints, and two of them, miss that end.
bool most_miss(const std::vector<Moved>& joints, double Moved::*end) {
  int bending = 0;
  int missing = 0;
  for (const Moved& joint : joints) {
    if (is_in(kFingerBending, joint.letter)) {
      ++bending;
      missing += joint.*end > kMissing ? 1 : 0;
    }
  }
  return missing >= 2 && 2 * missing >= bending;
}

bool none_spreads(const std::vector<Moved>& joints) {
  const auto still = [](const Moved& joint) { return joint.range < kHardly; };
  int spreading = 0;
  for (const Moved& joint : joints) {
    if (is_in(kSpreading, joint.letter)) {
      ++spreading;
      if (!still(joint)) {
        return false;
      }
    }
  }
  return spreading > 1;
}

}  // namespace

QStringList capture_hints(const JointCoverage& coverage, const device::HandMapping& mapping,
                          int most) {
  const std::vector<Moved> joints = moved_joints(coverage, mapping);
  QStringList hints;
  const bool fist = most_miss(joints, &Moved::not_bent);
  const bool flat = most_miss(joints, &Moved::not_stretched);
  const bool spread = none_spreads(joints);
  if (spread) {
    hints << QObject::tr("Spread the fingers and close them again");
  }
  if (fist) {
    hints << QObject::tr("Make a tight fist");
  }
  if (flat) {
    hints << QObject::tr("Stretch all fingers out");
  }
  for (const Moved& joint : joints) {
    const bool bending = is_in(kFingerBending, joint.letter);
    if (joint.range >= kHardly || (spread && is_in(kSpreading, joint.letter)) ||
        (bending && (fist || flat))) {
      continue;
    }
    hints << (joint.letter == kThumbRoll ? QObject::tr("Bring the thumb across the palm and back")
                                         : QObject::tr("%1 has hardly moved").arg(joint.label));
  }
  for (const Moved& joint : joints) {
    if (joint.range < kHardly) {
      continue;
    }
    if (!is_in(kFingerBending, joint.letter)) {
      if (joint.range < kLittle) {
        hints << QObject::tr("%1: go further both ways").arg(joint.label);
      }
    } else if (!fist && joint.not_bent > kMissing) {
      hints << QObject::tr("%1: bend further").arg(joint.label);
    } else if (!flat && joint.not_stretched > kMissing) {
      hints << QObject::tr("%1: stretch further").arg(joint.label);
    }
  }
  return hints.mid(0, most);
}

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
