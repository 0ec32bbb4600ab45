#include "widgets/panels/link_status.h"

#include "widgets/forms/arrangement.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

#include <QFrame>
#include <QLabel>
#include <QVariant>

namespace handway::gui {
namespace {

using device::StreamState;

constexpr double kMilli = 1e3;

QString state_text(StreamState state, const QString& what) {
  switch (state) {
    case StreamState::kConnecting:
      return QObject::tr("Connecting…");
    case StreamState::kStreaming:
      return what;
    case StreamState::kUnplugged:
      return QObject::tr("The sensor is unplugged from its unit: plug it in again");
    case StreamState::kLost:
      return QObject::tr("Connection lost, trying again…");
    case StreamState::kEnded:
      return QObject::tr("The recording has ended");
    case StreamState::kFailed:
    case StreamState::kStopped:
      break;
  }
  return QObject::tr("Not connected");
}

QColor state_color(StreamState state) {
  const ThemeColors colors = colors_of(current_theme());
  switch (state) {
    case StreamState::kStreaming:
      return colors.good;
    case StreamState::kConnecting:
    case StreamState::kUnplugged:
      return attention_color();
    case StreamState::kLost:
    case StreamState::kFailed:
      return colors.bad;
    default:
      return colors.muted;
  }
}

QLabel* figure(const QString& name) {
  auto* label = note();
  label->setObjectName(name);
  return label;
}

}  // namespace

LinkStatus::LinkStatus(const QString& name, QWidget* parent)
    : QWidget(parent),
      state_(new QLabel),
      problem_(new QFrame),
      problem_text_(new QLabel),
      rate_(figure(name + QStringLiteral("_rate"))),
      delay_(figure(name + QStringLiteral("_delay"))),
      dropouts_(figure(name + QStringLiteral("_dropouts"))) {
  state_->setObjectName(name + QStringLiteral("_state"));
  state_->setTextFormat(Qt::RichText);
  state_->setWordWrap(true);
  problem_->setProperty("role", "banner");
  problem_text_->setObjectName(name + QStringLiteral("_error"));
  problem_text_->setWordWrap(true);
  problem_text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  lay_out(*problem_, in_column({problem_text_}), {10, 7, 10, 7});
  problem_->hide();
  rate_->setToolTip(tr("Frames that arrived in the last second"));
  delay_->setToolTip(tr("From the arrival of a frame to its picture on the screen"));
  dropouts_->setToolTip(tr("Pauses of more than three and a half frames since connecting"));
  lay_out(*this, in_column({state_, problem_, in_row({rate_, delay_, dropouts_, room()}, 14)}, 4));
  show_state(StreamState::kStopped, {}, {}, {});
  clear_statistics();
}

void LinkStatus::show_state(StreamState state, const QString& what, const QString& device,
                            const QString& error) {
  state_->setText(dotted(state_text(state, what), state_color(state)));
  state_->setToolTip(device);
  problem_text_->setText(error);
  problem_->setVisible(!error.isEmpty());
}

void LinkStatus::show_statistics(const device::StreamStatistics& statistics, double to_screen) {
  rate_->setText(tr("%1 Hz").arg(statistics.rate, 0, 'f', 0));
  if (to_screen > 0.0) {
    delay_->setText(tr("%1 ms to screen").arg(to_screen * kMilli, 0, 'f', 0));
  } else if (statistics.latency > 0.0) {
    delay_->setText(tr("%1 ms to answer").arg(statistics.latency * kMilli, 0, 'f', 1));
  }
  dropouts_->setText(statistics.dropouts == 1 ? tr("1 dropout")
                                              : tr("%1 dropouts").arg(statistics.dropouts));
  rate_->show();
  delay_->setVisible(to_screen > 0.0 || statistics.latency > 0.0);
  dropouts_->show();
}

void LinkStatus::clear_statistics() {
  for (QLabel* label : {rate_, delay_, dropouts_}) {
    label->hide();
  }
}

QString LinkStatus::error() const {
  return problem_->isHidden() ? QString() : problem_text_->text();
}

}  // namespace handway::gui
