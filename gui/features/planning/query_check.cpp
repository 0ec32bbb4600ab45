#include "features/planning/query_check.h"

#include "model/document/document.h"
#include "model/document/scene_editor.h"
#include "model/playback/path_player.h"
#include "view3d/scene_view.h"
#include "view3d/view_gizmo.h"
#include "widgets/forms/arrangement.h"
#include "widgets/panels/dock_layout.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

#include <QLabel>
#include <QPushButton>
#include <QStringList>
#include <QToolButton>
#include <QVariant>

#include <algorithm>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kMostContacts = 2;
constexpr int kSpacing = 12;  // px, between the parts of the card

QString words(const std::string& name) { return QString::fromStdString(name).toHtmlEscaped(); }

QString contact_text(const geometric::Contact& contact) {
  const QString depth =
      contact.depth < geometric::Contact::kMostDepth
          ? QObject::tr("%1 mm deep").arg(geometric::millimetres(contact.depth), 0, 'f', 1)
          : QObject::tr("more than %1 mm deep").arg(geometric::millimetres(contact.depth));
  const Eigen::Vector3d p = contact.p_W / geometric::kMillimetre;
  return QObject::tr("<b>%1</b> is in <b>%2</b>, %3, at (%4, %5, %6) mm")
      .arg(words(contact.a), words(contact.b), depth)
      .arg(p.x(), 0, 'f', 0)
      .arg(p.y(), 0, 'f', 0)
      .arg(p.z(), 0, 'f', 0);
}

QString words(const std::vector<std::string>& names) {
  QStringList all;
  for (const std::string& name : names) {
    all << QStringLiteral("<b>%1</b>").arg(words(name));
  }
  return all.join(QStringLiteral(", "));
}

bool is_hollow(const planning::CollisionRemedy& remedy) {
  return remedy.kind == planning::CollisionRemedy::Kind::kHollow;
}

QString remedy_text(const planning::CollisionRemedy& remedy) {
  return is_hollow(remedy)
             ? QObject::tr(
                   "The robot is inside of %1, which is solid. If it is a cell or a room, make it "
                   "hollow: then only its walls collide.")
                   .arg(words(remedy.objects))
             : QObject::tr("%1 is attached and touches %2. If it is held there, allow the contact.")
                   .arg(words(remedy.objects), words(remedy.links));
}

}  // namespace

QString diagnosis_text(const geometric::RobotModel& model, const EndDiagnosis& end) {
  QStringList lines;
  if (!end.beyond_limits.empty()) {
    QStringList joints;
    for (const std::string& joint : end.beyond_limits) {
      joints << words(joint);
    }
    lines << QObject::tr("Out of limits: <b>%1</b>").arg(joints.join(QStringLiteral(", ")));
  }
  for (const std::string& violated : end.violated) {
    lines << QObject::tr("Violates %1").arg(words(violated));
  }
  const int named = std::min(kMostContacts, static_cast<int>(end.contacts.size()));
  for (int i = 0; i < named; ++i) {
    lines << contact_text(end.contacts[static_cast<std::size_t>(i)]);
  }
  if (const int others = static_cast<int>(end.contacts.size()) - named; others > 0) {
    lines << (others == 1 ? QObject::tr("and one more pair")
                          : QObject::tr("and %1 more pairs").arg(others));
  }
  if (end.remedy) {
    lines << remedy_text(*end.remedy);
  }
  if (end.nearest.q) {
    lines << QObject::tr("Nearest free posture: %1")
                 .arg(words(planning::describe_change(model, end.q, *end.nearest.q)));
  } else {
    lines << QObject::tr("No free posture was found within %1°")
                 .arg(geometric::degrees(planning::NearestFreeOptions{}.most_distance), 0, 'f', 0);
  }
  const QString which = end.is_start ? QObject::tr("Start") : QObject::tr("Goal");
  return QStringLiteral("<b>%1</b><br>%2")
      .arg(end.contacts.empty() ? QObject::tr("%1 not valid").arg(which)
                                : QObject::tr("%1 in collision").arg(which),
           lines.join(QStringLiteral("<br>")));
}

DoctorCard::DoctorCard(QWidget* host, std::function<std::vector<QPoint>()> to_be_seen)
    : FloatingCard(host, "doctor", "banner"),
      to_be_seen_(std::move(to_be_seen)),
      picture_(new QLabel),
      text_(named("doctor_text", new QLabel)),
      area_(new PanelArea),
      close_(make_close("doctor_close", tr("Put this message away"))),
      show_(named("doctor_show", new QPushButton(tr("Show")))),
      use_(named("doctor_use", new QPushButton(tr("Use posture")))),
      mend_(named("doctor_mend", new QPushButton)) {
  text_->setTextFormat(Qt::RichText);
  text_->setWordWrap(true);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  show_->setToolTip(tr("Move the robot to the free posture"));
  use_->setToolTip(tr("Use the free posture instead"));
  use_->setProperty("role", "primary");
  area_->setWidget(text_);
  area_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Ignored);
  connect(close_, &QToolButton::clicked, this, &QWidget::hide);
  connect(mend_, &QPushButton::clicked, this, [this] { emit remedied(*end_.remedy); });
  connect(show_, &QPushButton::clicked, this, [this] { emit shown(*end_.nearest.q); });
  connect(use_, &QPushButton::clicked, this,
          [this] { emit accepted(end_.is_start, *end_.nearest.q); });
  lay_out(
      *this,
      in_column(
          {{in_row({{picture_, 0, Qt::AlignTop}, {area_, 1}, {close_, 0, Qt::AlignTop}}, kSpacing),
            1},
           in_row({mend_, show_, use_, room()})},
          6),
      {14, 10, 8, 10});
}

void DoctorCard::show_diagnoses(const std::shared_ptr<const geometric::RobotModel>& model,
                                const std::vector<EndDiagnosis>& ends) {
  if (ends.empty()) {
    hide();
    return;
  }
  end_ = ends.front();
  picture_->setPixmap(icon("warning", colors_of(current_theme()).bad).pixmap(24, 24));
  text_->setText(diagnosis_text(*model, end_).replace(QLatin1Char('_'), QLatin1String("_&#8203;")));
  for (QPushButton* button : {show_, use_}) {
    button->setVisible(end_.nearest.q.has_value());
    button->setEnabled(true);
  }
  mend_->setVisible(end_.remedy.has_value());
  mend_->setEnabled(true);
  mend_->setText(end_.remedy && is_hollow(*end_.remedy) ? tr("Make hollow") : tr("Allow contact"));
  appear();
}

void DoctorCard::show_pending() {
  show_->setEnabled(false);
  use_->setEnabled(false);
  mend_->setEnabled(false);
}

QString DoctorCard::text() const {
  return isHidden() ? QString() : text_->text().remove(QLatin1String("&#8203;"));
}

// The card is as high as its text, if the view has room; otherwise the text scrolls. It is at the
// foot of the view, or at its head if that hides less of the colliding bodies.
void DoctorCard::place() {
  constexpr int kMargin = 12;
  constexpr int kAxes = 108;  // left of it stands the axes cross
  const QRect free = between_high_cards(scaled(320));
  const QSize room = free.size() - QSize(2 * kMargin, 2 * kMargin);
  const int axes = std::max(0, kAxes - free.left());
  const bool beside_axes = room.width() - axes > scaled(420);
  const int width =
      std::min(beside_axes ? room.width() - axes + kMargin : room.width(), scaled(720));
  const QMargins around = layout()->contentsMargins();
  const int for_words = width - around.left() - around.right() - 2 * kSpacing -
                        picture_->sizeHint().width() - close_->sizeHint().width();
  const bool has_answers = !show_->isHidden() || !mend_->isHidden();
  const int answers = has_answers ? use_->sizeHint().height() + layout()->spacing() : 0;
  const int left =
      free.left() + (beside_axes ? std::max(axes, (free.width() - width) / 2) : kMargin);
  const std::vector<QPoint> to_be_seen = to_be_seen_();
  const auto stand = [&](int wanted) {
    const int height = std::min(wanted, room.height());
    const QRect head(left, kMargin, width, height);
    const QRect foot(left, parentWidget()->height() - height - kMargin, width, height);
    setGeometry(hidden_at(head, to_be_seen) < hidden_at(foot, to_be_seen) ? head : foot);
    layout()->activate();
  };
  stand(around.top() + text_->heightForWidth(for_words) + answers + around.bottom());
  const QSize words = area_->viewport()->size();  // what the layout left of that
  stand(height() + std::max(text_->heightForWidth(words.width()) - words.height(), 0));
}

QueryCheck::QueryCheck(Document& document, SceneEditor& editor, Posing& posing, SceneView& view,
                       QObject* parent)
    : QObject(parent),
      document_(document),
      view_(view),
      card_(new DoctorCard(&view, [this] { return to_be_seen(); })) {
  connect(&document_, &Document::opened, this, [this] {
    take({});  // what was found is of the scene before
    examine();
  });
  connect(&document_, &Document::edited, this, [this](const planning::SceneState& before) {
    if (before.scene != document_.scene()) {
      examine();
    }
  });
  connect(&doctor_, &QueryDoctor::diagnosed, this, &QueryCheck::take);
  connect(&doctor_, &QueryDoctor::warned, this, &QueryCheck::warned);
  connect(card_, &DoctorCard::shown, &posing, &Posing::set);
  connect(card_, &DoctorCard::remedied, &editor,
          [&editor](const planning::CollisionRemedy& remedy) {
            planning::SceneState next = editor.state();
            next.scene =
                std::make_shared<const geometric::Scene>(planning::remedied(*next.scene, remedy));
            const QString what = SceneEditor::words_for(remedy.objects);
            editor.apply(is_hollow(remedy) ? tr("Make %1 hollow").arg(what)
                                           : tr("Let %1 touch the robot").arg(what),
                         std::move(next), remedy.objects);
          });
  connect(card_, &DoctorCard::accepted, &editor, [&editor](bool is_start, const auto& q) {
    is_start ? editor.set_start(q) : editor.set_goal(q);
  });
}

void QueryCheck::examine() {
  card_->show_pending();
  doctor_.examine(document_.scene(), document_.problem());
}

void QueryCheck::take(const std::vector<EndDiagnosis>& ends) {
  contacts_.clear();
  if (!ends.empty()) {
    for (const geometric::Contact& contact : ends.front().contacts) {
      contacts_.push_back(contact.p_W);
    }
  }
  view_.set_contacts(contacts_);
  card_->show_diagnoses(document_.robot() ? document_.robot()->model : nullptr, ends);
}

// The contacts, and where the bodies around them begin to be recognised.
std::vector<QPoint> QueryCheck::to_be_seen() const {
  constexpr double kAround = 0.1;  // m
  std::vector<QPoint> places;
  const auto add = [&](const Eigen::Vector3d& point) {
    if (view_.camera().place_of(point)) {  // it is before the camera
      places.push_back(place_of(view_.camera(), view_.size(), point).toPoint());
    }
  };
  for (const Eigen::Vector3d& contact : contacts_) {
    add(contact);
    for (int axis = 0; axis < 3; ++axis) {
      add(contact + kAround * Eigen::Vector3d::Unit(axis));
      add(contact - kAround * Eigen::Vector3d::Unit(axis));
    }
  }
  return places;
}

}  // namespace handway::gui
