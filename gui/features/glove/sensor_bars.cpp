#include "features/glove/sensor_bars.h"

#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/math/units.h"
#include "widgets/style/color_math.h"
#include "widgets/style/theme.h"

#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>

#include <algorithm>
#include <cmath>

namespace handway::gui {
namespace {

constexpr int kStill = 3;                // counts, as in RecordingQuality
constexpr int kMoved = 12;               // counts
constexpr int kEnoughMoving = 4;         // sensors
constexpr double kPatience = 5.0;        // s
constexpr double kRecent = 0.02;         // weight of the latest frame
constexpr double kMostlyAtEnd = 0.5;     // share
constexpr std::uint16_t kLargest = 255;  // counts

}  // namespace

void SensorWatch::take(const device::GloveFrame& frame) {
  const bool first = first_time_ < 0.0;
  if (first) {
    first_time_ = frame.time;
  }
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    Sensor& sensor = sensors_.at(i);
    const std::uint16_t counts = frame.counts.at(i);
    sensor.least = first ? counts : std::min(sensor.least, counts);
    sensor.most = first ? counts : std::max(sensor.most, counts);
    sensor.counts = counts;
    const bool at_end = counts == 1 || counts >= kLargest;
    sensor.at_end += kRecent * ((at_end ? 1.0 : 0.0) - sensor.at_end);
  }
  const bool judge = frame.time - first_time_ > kPatience && moving() >= kEnoughMoving;
  for (Sensor& sensor : sensors_) {
    if (sensor.counts == 0) {
      sensor.verdict = Verdict::kMissing;
    } else if (sensor.at_end > kMostlyAtEnd) {
      sensor.verdict = Verdict::kSaturated;
    } else if (judge && sensor.most - sensor.least < kStill) {
      sensor.verdict = Verdict::kDead;
    } else {
      sensor.verdict = Verdict::kGood;
    }
  }
}

int SensorWatch::moving() const {
  return static_cast<int>(std::ranges::count_if(
      sensors_, [](const Sensor& sensor) { return sensor.most - sensor.least > kMoved; }));
}

namespace {

using Verdict = SensorWatch::Verdict;

constexpr int kSensorRow = 19;
constexpr int kGap = 7;  // between fingers
constexpr int kBarMargin = 12;
constexpr int kLetterWidth = 16;
constexpr int kSensorName = 106;
constexpr int kCountsWidth = 30;
constexpr int kDegreesWidth = 42;
constexpr int kSensorBar = 7;
constexpr double kCountsOfASensor = 255.0;
constexpr double kBeyond = 1e-9;  // rad

// The abduction sensors sit between two fingers and come after the second; each
// is shown with the finger that its name says.
constexpr std::array<int, device::kGloveSensors> kOrder{0,  1,  2,  3,  4,  5,  6,  10, 7,  8,  9,
                                                        11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21};
constexpr std::array<int, 5> kGroupBegins{4, 8, 11, 15, 19};  // places in kOrder

int place_of(int sensor) {
  return static_cast<int>(std::ranges::find(kOrder, sensor) - kOrder.begin());
}

int gaps_before(int place) {
  return static_cast<int>(
      std::ranges::count_if(kGroupBegins, [&](int begin) { return place >= begin; }));
}

QString joined(const std::vector<std::string>& names) {
  QStringList list;
  for (const std::string& name : names) {
    list << QString::fromStdString(name);
  }
  return list.join(QStringLiteral(", "));
}

QString text_of(std::string_view text) {
  return QString::fromUtf8(text.data(), static_cast<int>(text.size()));
}

}  // namespace

SensorBars::SensorBars(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("sensor_bars"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void SensorBars::clear() {
  watch_.restart();
  latest_.reset();
  clamped_.clear();
  update();
}

void SensorBars::set_mapping(const device::HandMapping& mapping) {
  driven_ = {};
  for (const device::JointMapping& mapped : mapping.joints) {
    if (mapped.sensor >= 0) {
      driven_.at(static_cast<std::size_t>(mapped.sensor)).push_back(mapped.joint);
    }
  }
  update();
}

void SensorBars::show_samples(const std::vector<GloveSample>& samples,
                              const device::HandMapper* mapper) {
  for (const GloveSample& sample : samples) {
    watch_.take(sample.frame);
  }
  latest_ = samples.back();
  clamped_.clear();
  if (mapper && latest_->posture.size() == static_cast<Eigen::Index>(mapper->joints().size())) {
    for (Eigen::Index j = 0; j < latest_->posture.size(); ++j) {
      if (std::abs(latest_->unclamped[j] - latest_->posture[j]) > kBeyond) {
        clamped_.push_back(mapper->joints()[static_cast<std::size_t>(j)]);
      }
    }
  }
  update();
}

QSize SensorBars::sizeHint() const {
  const int rows = device::kGloveSensors;
  return {scaled(300),
          rows * scaled(kSensorRow) + static_cast<int>(kGroupBegins.size()) * kGap + 8};
}

QSize SensorBars::minimumSizeHint() const {
  constexpr int kLeastBar = 60;
  const int words =
      scaled(kLetterWidth) + scaled(kSensorName) + scaled(kCountsWidth) + scaled(kDegreesWidth);
  return {2 * kBarMargin + words + kLeastBar, sizeHint().height()};
}

int SensorBars::top_of(int sensor) const {
  const int place = place_of(sensor);
  return 4 + place * scaled(kSensorRow) + gaps_before(place) * kGap;
}

bool SensorBars::at_limit(int sensor) const {
  return std::ranges::any_of(
      driven_.at(static_cast<std::size_t>(sensor)),
      [this](const std::string& joint) { return std::ranges::count(clamped_, joint) > 0; });
}

void SensorBars::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  for (int sensor = 0; sensor < device::kGloveSensors; ++sensor) {
    paint_row(painter, sensor);
  }
}

void SensorBars::paint_row(QPainter& painter, int sensor) const {
  const ThemeColors colors = colors_of(current_theme());
  const auto index = static_cast<std::size_t>(sensor);
  const device::GloveSensor& about = device::cyberglove_sensors()[index];
  const SensorWatch::Sensor& state = watch_.sensors().at(index);
  const bool used = !driven_.at(index).empty();
  const bool present = latest_ && state.verdict != Verdict::kMissing;
  const int top = top_of(sensor);
  const auto cell = [top](int x, int width) { return QRect(x, top, width, scaled(kSensorRow)); };

  set_text_size(painter, 12);
  painter.setPen(faded(colors.muted, 0.9));
  painter.drawText(cell(kBarMargin, scaled(kLetterWidth)), Qt::AlignVCenter,
                   QString(QLatin1Char(about.letter)));
  painter.setPen(used ? colors.text : colors.muted);
  painter.drawText(cell(kBarMargin + scaled(kLetterWidth), scaled(kSensorName)), Qt::AlignVCenter,
                   text_of(about.label));

  const int degrees_x = width() - kBarMargin - scaled(kDegreesWidth);
  const int counts_x = degrees_x - scaled(kCountsWidth);
  const int bar_x = kBarMargin + scaled(kLetterWidth) + scaled(kSensorName) + 4;
  const QRectF bar(bar_x, top + (scaled(kSensorRow) - kSensorBar) / 2.0, counts_x - bar_x - 4,
                   kSensorBar);
  painter.setPen(Qt::NoPen);
  painter.setBrush(faded(colors.border, present ? 0.75 : 0.45));
  painter.drawRoundedRect(bar, 3.5, 3.5);
  if (!present) {
    painter.setPen(faded(colors.muted, 0.7));
    painter.drawText(cell(counts_x, scaled(kCountsWidth)), Qt::AlignVCenter | Qt::AlignRight,
                     QStringLiteral("–"));
    return;
  }
  const bool broken = state.verdict == Verdict::kSaturated || state.verdict == Verdict::kDead;
  const bool limited = at_limit(sensor);
  const QColor tone = broken    ? colors.bad
                      : limited ? attention_color()
                      : used    ? colors.accent
                                : colors.muted;
  const auto x_of = [&bar](double counts) { return bar.width() * counts / kCountsOfASensor; };
  QRectF seen = bar;
  seen.setLeft(bar.left() + x_of(state.least));
  seen.setWidth(std::max(2.0, x_of(state.most) - x_of(state.least)));
  painter.setBrush(faded(tone, 0.28));
  painter.drawRoundedRect(seen, 2, 2);
  QRectF now = bar;
  now.setWidth(std::max(3.0, x_of(state.counts)));
  painter.setBrush(faded(tone, used || broken ? 0.95 : 0.55));
  painter.drawRoundedRect(now, 3.5, 3.5);

  painter.setPen(broken ? colors.bad : colors.muted);
  painter.drawText(cell(counts_x, scaled(kCountsWidth)), Qt::AlignVCenter | Qt::AlignRight,
                   QString::number(state.counts));
  const double angle = latest_->angles.angles.at(index);
  const QString degrees = broken ? (state.verdict == Verdict::kDead ? tr("dead") : tr("at end"))
                          : std::isfinite(angle)
                              ? QStringLiteral("%1°").arg(std::lround(angle / geometric::kDegree))
                              : QStringLiteral("–");
  painter.setPen(broken    ? colors.bad
                 : limited ? attention_color()
                 : used    ? colors.text
                           : colors.muted);
  painter.drawText(cell(degrees_x, scaled(kDegreesWidth)), Qt::AlignVCenter | Qt::AlignRight,
                   degrees);
}

QString SensorBars::explain(int sensor) const {
  const auto index = static_cast<std::size_t>(sensor);
  const device::GloveSensor& about = device::cyberglove_sensors()[index];
  const SensorWatch::Sensor& state = watch_.sensors().at(index);
  const std::vector<std::string>& joints = driven_.at(index);
  QString text = tr("%1, sensor %2").arg(text_of(about.name)).arg(QLatin1Char(about.letter));
  text += QLatin1Char('\n') +
          (joints.empty() ? tr("Drives no joint") : tr("Drives %1").arg(joined(joints)));
  if (latest_ && state.verdict == Verdict::kMissing) {
    return text + QLatin1Char('\n') + tr("This glove does not have this sensor");
  }
  if (latest_) {
    text += QLatin1Char('\n') + tr("Seen so far: %1 to %2 counts").arg(state.least).arg(state.most);
  }
  if (state.verdict == Verdict::kDead) {
    text += QLatin1Char('\n') + tr("Does not change although other sensors do: check its cable");
  } else if (state.verdict == Verdict::kSaturated) {
    text += QLatin1Char('\n') + tr("At the end of its range: check its gain and its cable");
  } else if (at_limit(sensor)) {
    text += QLatin1Char('\n') + tr("Exceeds the limit of the joint");
  }
  return text;
}

bool SensorBars::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    for (int sensor = 0; sensor < device::kGloveSensors; ++sensor) {
      const QRect row(0, top_of(sensor), width(), scaled(kSensorRow));
      if (row.contains(help->pos())) {
        QToolTip::showText(help->globalPos(), explain(sensor), this, row);
        return true;
      }
    }
    QToolTip::hideText();
  }
  return QWidget::event(event);
}

}  // namespace handway::gui
