#include "widgets/panels/floating_card.h"

#include "widgets/forms/arrangement.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

#include <QEvent>
#include <QLabel>
#include <QPushButton>
#include <QStyle>
#include <QToolButton>
#include <QVariant>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kMargin = 12;  // px

}  // namespace

FloatingCard::FloatingCard(QWidget* host, const char* name, const char* role) : QFrame(host) {
  setObjectName(QLatin1String(name));
  setProperty("role", role);
  setAttribute(Qt::WA_StyledBackground);
  host->installEventFilter(this);
  hide();
}

void FloatingCard::appear() {
  show();
  place();
  raise();
}

QToolButton* FloatingCard::make_close(const char* name, const QString& tip) {
  auto* close = named(name, new QToolButton);
  close->setIcon(icon("close"));
  close->setAutoRaise(true);
  close->setToolTip(tip);
  return close;
}

QToolButton* FloatingCard::make_fold(const QString& name, QWidget& details) {
  auto* fold = new QToolButton;
  fold->setObjectName(name);
  fold->setCheckable(true);
  fold->setArrowType(Qt::DownArrow);
  fold->setAutoRaise(true);
  fold->setToolTip(tr("Fold this card"));
  connect(fold, &QToolButton::toggled, this, [this, fold, &details](bool folded) {
    fold->setArrowType(folded ? Qt::RightArrow : Qt::DownArrow);
    details.setVisible(!folded);
    layout()->activate();
    place();
  });
  return fold;
}

void FloatingCard::stand_where_it_hides_least(const QSize& size,
                                              const std::vector<QPoint>& to_be_seen) {
  const QRect within = parentWidget()->rect().adjusted(kMargin, kMargin, -kMargin, -kMargin);
  QRect best;
  auto least = std::numeric_limits<std::ptrdiff_t>::max();
  for (const Qt::Alignment corner :
       {Qt::AlignRight | Qt::AlignBottom, Qt::AlignLeft | Qt::AlignBottom,
        Qt::AlignLeft | Qt::AlignTop, Qt::AlignRight | Qt::AlignTop}) {
    const QRect there = QStyle::alignedRect(Qt::LeftToRight, corner, size, within);
    const std::ptrdiff_t hidden = hidden_at(there, to_be_seen);
    if (hidden < least) {
      least = hidden;
      best = there;
    }
  }
  setGeometry(best);
}

std::ptrdiff_t FloatingCard::hidden_at(const QRect& place,
                                       const std::vector<QPoint>& to_be_seen) const {
  constexpr std::ptrdiff_t kCard = 1000;  // points that count as much as a card
  const auto points =
      std::ranges::count_if(to_be_seen, [&](const QPoint& p) { return place.contains(p); });
  const auto cards = std::ranges::count_if(
      others(), [&](const FloatingCard* other) { return place.intersects(other->geometry()); });
  return points + kCard * cards;
}

QRect FloatingCard::between_high_cards(int least) const {
  const QRect host = parentWidget()->rect();
  QRect between = host;
  for (const FloatingCard* other : others()) {
    const QRect there = other->geometry();
    if (2 * there.height() <= host.height()) {
      continue;
    }
    if (there.center().x() < host.center().x()) {
      between.setLeft(std::max(between.left(), there.right() + 1));
    } else {
      between.setRight(std::min(between.right(), there.left() - 1));
    }
  }
  return between.width() < least ? host : between;
}

QList<FloatingCard*> FloatingCard::others() const {
  QList<FloatingCard*> others;
  for (QObject* child : parentWidget()->children()) {
    if (auto* card = qobject_cast<FloatingCard*>(child);
        card && card != this && !card->isHidden()) {
      others.append(card);
    }
  }
  return others;
}

void FloatingCard::stand_at_lower_right() {
  const QSize room = parentWidget()->size() - QSize(2 * kMargin, 2 * kMargin);
  const int width = std::min(sizeHint().width(), room.width());
  const int height =
      layout()->hasHeightForWidth() ? layout()->totalHeightForWidth(width) : sizeHint().height();
  QRect place(QPoint(), QSize(width, std::min(height, room.height())));
  place.moveBottomRight(parentWidget()->rect().bottomRight() - QPoint(kMargin, kMargin));
  for (const FloatingCard* other : others()) {
    if (place.intersects(other->geometry())) {
      place.moveBottom(other->geometry().top() - kMargin);
    }
  }
  setGeometry(place);
}

void FloatingCard::place_others() const {
  for (FloatingCard* card : others()) {
    card->place();
  }
}

void FloatingCard::showEvent(QShowEvent* event) {
  QFrame::showEvent(event);
  place_others();
}

void FloatingCard::hideEvent(QHideEvent* event) {
  QFrame::hideEvent(event);
  place_others();
}

void FloatingCard::resizeEvent(QResizeEvent* event) {
  QFrame::resizeEvent(event);
  place_others();
}

bool FloatingCard::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize && !isHidden()) {
    place();
  }
  return QFrame::eventFilter(watched, event);
}

Banner::Banner(QWidget* host)
    : FloatingCard(host, "banner", ""),  // show_text() says of what role
      picture_(new QLabel),
      text_(named("banner_text", new QLabel)),
      answers_(new QWidget),
      accept_(named("banner_accept", new QPushButton)),
      refuse_(named("banner_refuse", new QPushButton)) {
  text_->setTextFormat(Qt::RichText);
  text_->setWordWrap(true);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  QToolButton* close = make_close("banner_close", tr("Put this message away"));
  connect(close, &QToolButton::clicked, this, &QWidget::hide);
  lay_out(
      *this,
      in_column({in_row({{picture_, 0, Qt::AlignTop}, {text_, 1}, {close, 0, Qt::AlignTop}}, 12),
                 {answers_, 0, Qt::AlignRight}}),
      {14, 10, 8, 10});
  connect(accept_, &QPushButton::clicked, this, [this] {
    hide();
    on_accept_();
  });
  connect(refuse_, &QPushButton::clicked, this, [this] {
    hide();
    on_refuse_();
  });
  lay_out(*answers_, in_row({accept_, refuse_}));
}

void Banner::show_message(const QString& title, const QString& message) {
  show_text(title, message, false);
}

void Banner::hide_message() {
  if (!is_offer_) {
    hide();
  }
}

void Banner::offer(const QString& title, const QString& message, const QString& accept,
                   std::function<void()> on_accept, const QString& refuse,
                   std::function<void()> on_refuse) {
  accept_->setText(accept);
  refuse_->setText(refuse);
  for (QPushButton* answer : {accept_, refuse_}) {
    answer->setMinimumWidth(answer->sizeHint().width());
  }
  on_accept_ = std::move(on_accept);
  on_refuse_ = std::move(on_refuse);
  show_text(title, message, true);
}

void Banner::show_text(const QString& title, const QString& message, bool is_offer) {
  is_offer_ = is_offer;
  set_role(*this, is_offer ? QStringLiteral("offer") : QStringLiteral("banner"));
  const ThemeColors colors = colors_of(current_theme());
  picture_->setPixmap(is_offer ? icon("undo", colors.accent).pixmap(24, 24)
                               : icon("warning", colors.bad).pixmap(24, 24));
  answers_->setVisible(is_offer);
  text_->setText(
      QStringLiteral("<b>%1</b><br>%2").arg(title.toHtmlEscaped(), message.toHtmlEscaped()));
  appear();
}

QString Banner::message() const { return text_->text(); }

void Banner::place() {
  const int width = std::min(parentWidget()->width() - 32, scaled(760));
  const int height = std::max(layout()->heightForWidth(width), minimumSizeHint().height());
  setGeometry((parentWidget()->width() - width) / 2, 16, width, height);
  layout()->activate();
  const int lacking = text_->heightForWidth(text_->width()) - text_->height();
  resize(width, height + std::max(lacking, 0));
}

}  // namespace handway::gui
