#include "features/viewing/section_tool.h"

#include "features/workbench.h"
#include "view3d/scene_view.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/quantity_field.h"
#include "widgets/forms/typed_input.h"
#include "widgets/style/actions.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QSlider>
#include <QToolButton>

#include <algorithm>
#include <cmath>

namespace handway::gui {
namespace {

constexpr int kSteps = 1000;         // of the slider
constexpr double kFarthest = 100.0;  // m

}  // namespace

SectionCard::SectionCard(QWidget* host)
    : FloatingCard(host, "section_card", "legend"),
      axis_(named("section_axis", new QComboBox)),
      slider_(named("section_slider", new QSlider(Qt::Horizontal))),
      field_(named("section_place",
                   new QuantityField(QuantityField::Kind::kLength, -kFarthest, kFarthest))),
      other_side_(named("section_side", new QCheckBox(tr("Other side")))) {
  axis_->addItems({QStringLiteral("X"), QStringLiteral("Y"), QStringLiteral("Z")});
  slider_->setAccessibleName(tr("Position of the section plane"));
  slider_->setRange(0, kSteps);
  field_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  other_side_->setToolTip(tr("Cut away the other side of the objects"));
  QToolButton* close = make_close("section_close", tr("Show objects whole"));
  auto* form = new QFormLayout;
  form->addRow(tr("Across"), axis_);
  form->addRow(tr("At"), field_);
  lay_out(*this,
          in_column(
              {in_row({{heading(tr("Section plane")), 1}, close}), form, slider_, other_side_}, 6),
          {12, 6, 8, 10});
  connect(close, &QToolButton::clicked, this, &SectionCard::closed);
  connect(axis_, qOverload<int>(&QComboBox::activated), this, &SectionCard::show_axis);
  connect(other_side_, &QCheckBox::toggled, this, &SectionCard::changed);
  connect(field_, &QuantityField::quantity_edited, this, &SectionCard::set_place);
  connect(slider_, &QSlider::valueChanged, this, [this](int step) {
    const double share = static_cast<double>(step) / kSteps;
    set_place(room_.lower[axis_->currentIndex()] + share * room_.size()[axis_->currentIndex()]);
  });
}

void SectionCard::begin(const geometric::Aabb& room, const Eigen::Vector3d& cut,
                        const Eigen::Vector3d& towards) {
  room_ = room;
  cut_ = cut;
  Eigen::Index axis = 0;
  towards.cwiseAbs().maxCoeff(&axis);
  axis_->setCurrentIndex(static_cast<int>(axis));
  {
    const QSignalBlocker quiet(other_side_);
    other_side_->setChecked(towards[axis] < 0.0);
  }
  show_axis();
  appear();
}

void SectionCard::show_axis() { set_place(cut_[axis_->currentIndex()]); }

void SectionCard::set_place(double place) {
  const int axis = axis_->currentIndex();
  cut_[axis] = place;
  field_->show_quantity(place);
  const double size = room_.size()[axis];
  show_value(
      *slider_,
      size > 0.0 ? static_cast<int>(std::lround(kSteps * (place - room_.lower[axis]) / size)) : 0);
  emit changed();
}

Eigen::Hyperplane<double, 3> SectionCard::plane() const {
  const Eigen::Vector3d axis = Eigen::Vector3d::Unit(axis_->currentIndex());
  return {other_side_->isChecked() ? Eigen::Vector3d(-axis) : axis, cut_};
}

void SectionCard::place() { stand_at_lower_right(); }

SectionTool::SectionTool(Workbench& workbench)
    : workbench_(workbench),
      action_(workbench.make_action(QStringLiteral("section"), tr("Se&ction plane"),
                                    QKeySequence(Qt::Key_X),
                                    tr("Cut objects open, to see into shelves"))),
      card_(new SectionCard(&workbench.view)) {
  action_->setCheckable(true);
  workbench_.add_to_menu(MainMenu::kView, {1, 11}, action_);
  workbench_.add_to_bar(MainBar::kTools, {3, 3}, action_);
  connect(action_, &QAction::toggled, this, &SectionTool::turn_on);
  connect(card_, &SectionCard::closed, action_, [this] { action_->setChecked(false); });
  connect(card_, &SectionCard::changed, this,
          [this] { workbench_.view.set_section(card_->plane()); });
  const auto follow_scene = [this] {
    const auto& scene = workbench_.document.scene();
    allow(*action_,
          scene && !scene->objects.empty() ? QString() : tr("There are no objects to cut open."));
    if (!action_->isEnabled()) {
      action_->setChecked(false);
    }
  };
  connect(&workbench_.document, &Document::opened, this, [this, follow_scene] {
    action_->setChecked(false);
    follow_scene();
  });
  connect(&workbench_, &Workbench::scene_shown, this, &SectionTool::open_up);
  connect(&workbench_.document, &Document::edited, this, follow_scene);
  follow_scene();
}

void SectionTool::open_up() {
  if (const auto& before = workbench_.view.opening_section()) {
    action_->setChecked(true);
    cut(*before);
  }
}

// The plane is through the middle of the selection, or else of all objects, open towards the
// camera.
void SectionTool::turn_on(bool on) {
  if (!on) {
    card_->hide();
    workbench_.view.set_section({});
    return;
  }
  const planning::ObjectNames& selected = workbench_.editor.selected_objects();
  cut(bounds(*workbench_.document.scene(), workbench_.document.configuration(),
             selected.empty() ? all_objects() : selected)
          .centre());
}

void SectionTool::cut(const Eigen::Vector3d& before) {
  card_->begin(
      bounds(*workbench_.document.scene(), workbench_.document.configuration(), all_objects()),
      before, workbench_.view.camera().orientation().col(2));
}

planning::ObjectNames SectionTool::all_objects() const {
  planning::ObjectNames all;
  for (const geometric::SceneObject& object : workbench_.document.scene()->objects) {
    all.push_back(object.name);
  }
  return all;
}

}  // namespace handway::gui
