#include "features/tasks/step_fields.h"

#include "features/tasks/step_list.h"
#include "handway/geometric/formats/program_steps.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/parameter_form.h"
#include "widgets/forms/pose_form.h"
#include "widgets/forms/quantity_field.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>

#include <variant>

namespace handway::gui {
namespace {

using geometric::LineStep;
using geometric::OutputStep;
using geometric::PickStep;
using geometric::PlaceStep;
using geometric::PoseStep;
using geometric::PostureStep;
using geometric::WaitStep;

constexpr double kLargestOutput = 1e6;  // as in files
constexpr int kLengthWidth = 90;        // px, of two fields beside each other in a card

/// Rows of the list of values of an output.
enum OutputRow { kOn, kOff, kNumber };

// Words for a place step that names more than one support.
QString place_words(const geometric::ProgramStep& step) {
  const QString words = words_of(step);
  return std::get<PlaceStep>(step).pose ? QObject::tr("%1, at a pose").arg(words) : words;
}

bool is_plain(const PlaceStep& place) { return place.supports.size() == 1 && !place.pose; }

QuantityField* make_length(const char* name, double least) {
  return named(name, new QuantityField(QuantityField::Kind::kLength, least,
                                       geometric::kLongestStraightMotion));
}

QLabel* label_for(QWidget* field, const QString& text) {
  auto* label = new QLabel(text);
  label->setBuddy(field);
  field->setAccessibleName(text);
  return label;
}

}  // namespace

StepFields::StepFields(QWidget* parent)
    : QWidget(parent),
      named_(new QWidget),
      name_label_(new QLabel),
      name_(named("program_name", new QComboBox)),
      framed_(new QWidget),
      frame_label_(new QLabel),
      frame_(named("program_frame", new QComboBox)),
      lengths_(new QWidget),
      first_label_(new QLabel),
      first_(make_length("program_first_length", 0.0)),
      second_label_(new QLabel),
      second_(make_length("program_second_length", 0.0)),
      pose_(new PoseForm),
      line_(new QWidget),
      shift_{make_length("program_line_x", -geometric::kLongestStraightMotion),
             make_length("program_line_y", -geometric::kLongestStraightMotion),
             make_length("program_line_z", -geometric::kLongestStraightMotion)},
      wait_(new QWidget),
      duration_(named("program_wait", new NumberField(1e-3, geometric::kLongestWait))),
      output_(new QWidget),
      output_name_(named("program_output_name", new QLineEdit)),
      output_value_(named("program_output_value", new QComboBox)),
      output_number_(
          named("program_output_number", new NumberField(-kLargestOutput, kLargestOutput))) {
  for (auto* field : pose_->findChildren<QuantityField*>()) {  // an object has such, too
    field->setObjectName(QStringLiteral("program_") + field->objectName());
  }
  first_->setToolTip(tr("Length of the straight motion; less where that is blocked"));
  second_->setToolTip(first_->toolTip());
  for (QuantityField* field : {first_, second_}) {
    field->setMinimumWidth(scaled(kLengthWidth));
  }
  duration_->setSuffix(tr(" s"));
  output_name_->setToolTip(tr("Name of the output, as the controller has it"));
  output_value_->addItems({tr("On"), tr("Off"), tr("Number")});
  output_number_->setAccessibleName(tr("Number"));
  lay_out(*named_, in_row({name_label_, {name_, 1}}, 8));
  lay_out(*framed_, in_row({frame_label_, {frame_, 1}}, 8));
  lay_out(*lengths_, in_row({first_label_, {first_, 1}, second_label_, {second_, 1}}, 8));
  lay_out(
      *line_,
      in_column({in_row({label_for(shift_[0], QStringLiteral("X")),
                         {shift_[0], 1},
                         label_for(shift_[1], QStringLiteral("Y")),
                         {shift_[1], 1}},
                        6),
                 in_row({label_for(shift_[2], QStringLiteral("Z")), {shift_[2], 1}, room(1)}, 6)},
                5));
  lay_out(*wait_, in_row({label_for(duration_, tr("Time")), {duration_, 1}}, 8));
  lay_out(
      *output_,
      in_column(
          {in_row({label_for(output_name_, tr("Output")), {output_name_, 1}}, 8),
           in_row({label_for(output_value_, tr("Value")), {output_value_, 1}, {output_number_, 1}},
                  8)},
          5));
  lay_out(*this, in_column({named_, framed_, lengths_, pose_, line_, wait_, output_, room(1)}, 5));
  connect_fields();
}

void StepFields::connect_fields() {
  connect(name_, qOverload<int>(&QComboBox::activated), this, &StepFields::take_name);
  connect(frame_, qOverload<int>(&QComboBox::activated), this, &StepFields::take_frame);
  connect(first_, &QuantityField::quantity_edited, this, &StepFields::take_lengths);
  connect(second_, &QuantityField::quantity_edited, this, &StepFields::take_lengths);
  connect(pose_, &PoseForm::pose_edited, this, [this](const geometric::Pose& X) {
    change<PoseStep>([&](PoseStep& move) { move.goal.X_WG = X; });
  });
  for (QuantityField* field : shift_) {
    connect(field, &QuantityField::quantity_edited, this, &StepFields::take_line);
  }
  connect(duration_, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          [this](double time) { change<WaitStep>([&](WaitStep& wait) { wait.duration = time; }); });
  connect(output_name_, &QLineEdit::editingFinished, this, &StepFields::take_output);
  connect(output_value_, qOverload<int>(&QComboBox::activated), this, &StepFields::take_output);
  connect(output_number_, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          &StepFields::take_output);
}

void StepFields::show_step(const geometric::ProgramStep& step, const StepNames& names) {
  step_ = step;
  names_ = names;
  const bool is_pick = std::holds_alternative<PickStep>(step_);
  const bool is_place = std::holds_alternative<PlaceStep>(step_);
  const bool is_pose = std::holds_alternative<PoseStep>(step_);
  const bool is_line = std::holds_alternative<LineStep>(step_);
  const bool is_wait = std::holds_alternative<WaitStep>(step_);
  const bool is_output = std::holds_alternative<OutputStep>(step_);
  named_->setVisible(!is_line && !is_wait && !is_output);
  framed_->setVisible(is_pose || is_line);
  lengths_->setVisible(is_pick || is_place);
  pose_->setVisible(is_pose);
  line_->setVisible(is_line);
  wait_->setVisible(is_wait);
  output_->setVisible(is_output);
  name_->setToolTip(QString());
  std::visit([this](const auto& one) { show_values(one); }, step_);
}

void StepFields::show_values(const PickStep& pick) {
  offer(tr("Object"), names_.objects, QString::fromStdString(pick.object));
  show_lengths(tr("Approach"), pick.approach, tr("Lift"), pick.lift);
}

void StepFields::show_values(const PlaceStep& place) {
  offer(tr("Place on"), names_.supports,
        is_plain(place) ? QString::fromStdString(place.supports.front()) : place_words(step_));
  show_lengths(tr("Lower"), place.lower, tr("Retreat"), place.retreat);
}

void StepFields::show_values(const PostureStep& move) {
  offer(tr("Posture"), names_.postures, QString::fromStdString(move.posture));
}

void StepFields::show_values(const PoseStep& move) {
  offer(tr("Link"), names_.links, QString::fromStdString(move.goal.link));
  offer_frames(tr("In"), {tr("world")}, move.goal.reference);
  frame_->setToolTip(
      tr("Object or frame in which the pose is given, and with which it moves. If you choose "
         "another one, the pose stays where it is"));
  pose_->show_pose(move.goal.X_WG);
}

void StepFields::show_values(const LineStep& line) {
  offer_frames(tr("Along axes of"), {tr("world"), tr("palm")}, line.reference);
  frame_->setToolTip(tr("Object or frame along whose axes the palm moves"));
  for (std::size_t i = 0; i < 3; ++i) {
    shift_.at(i)->show_quantity(line.shift[static_cast<Eigen::Index>(i)]);
  }
}

void StepFields::show_values(const WaitStep& wait) {
  const QSignalBlocker quiet(duration_);
  duration_->setValue(wait.duration);
}

void StepFields::show_values(const OutputStep& output) {
  const QSignalBlocker quiet_name(output_name_);
  const QSignalBlocker quiet_number(output_number_);
  output_name_->setText(QString::fromStdString(output.name));
  const bool* on = std::get_if<bool>(&output.value);
  output_value_->setCurrentIndex(on ? (*on ? kOn : kOff) : kNumber);
  output_number_->setVisible(on == nullptr);
  output_number_->setValue(on ? 0.0 : std::get<double>(output.value));
}

void StepFields::show_values(const geometric::AlternativesStep& /*step*/) {
  offer(tr("Step"), {}, words_of(step_));
  name_->setToolTip(tr("The values of this step are changed in the scene's file"));
}

void StepFields::show_lengths(const QString& first, double first_length, const QString& second,
                              double second_length) {
  first_label_->setText(first);
  first_->setAccessibleName(first);
  first_->show_quantity(first_length);
  second_label_->setText(second);
  second_->setAccessibleName(second);
  second_->show_quantity(second_length);
}

void StepFields::offer(const QString& label, const QStringList& names, const QString& chosen) {
  name_label_->setText(label);
  name_->setAccessibleName(label);
  const QSignalBlocker quiet(name_);
  name_->clear();
  name_->addItems(names);
  if (name_->findText(chosen) < 0) {
    name_->insertItem(0, chosen);
  }
  name_->setCurrentText(chosen);
}

void StepFields::offer_frames(const QString& label, const QStringList& first,
                              const std::string& chosen) {
  frame_label_->setText(label);
  frame_->setAccessibleName(label);
  const QSignalBlocker quiet(frame_);
  frames_before_ = static_cast<int>(first.size());
  frame_->clear();
  frame_->addItems(first + names_.supports);
  if (chosen.empty() || (chosen == geometric::kPalmAxes && frames_before_ > 1)) {
    frame_->setCurrentIndex(chosen.empty() ? 0 : 1);
    return;
  }
  const QString name = QString::fromStdString(chosen);
  if (!names_.supports.contains(name)) {
    frame_->addItem(name);
  }
  const auto known = static_cast<int>(names_.supports.indexOf(name));
  frame_->setCurrentIndex(known < 0 ? frame_->count() - 1 : frames_before_ + known);
}

std::string StepFields::chosen_frame() const {
  const int row = frame_->currentIndex();
  if (row < frames_before_) {
    return row == 0 ? "" : geometric::kPalmAxes;
  }
  return frame_->currentText().toStdString();
}

const geometric::Pose* StepFields::find_frame(const std::string& reference) const {
  static const geometric::Pose kWorld = geometric::Pose::Identity();
  if (reference.empty()) {
    return &kWorld;
  }
  const auto found = names_.X_WF.find(reference);
  return found == names_.X_WF.end() ? nullptr : &found->second;
}

template <typename Step>
bool StepFields::change(const std::function<void(Step&)>& edit) {
  auto* step = std::get_if<Step>(&step_);
  if (step == nullptr) {
    return false;
  }
  edit(*step);
  emit edited(step_);
  return true;
}

void StepFields::take_name() {
  const QString text = name_->currentText();
  const std::string name = text.toStdString();
  const auto place_there = [&](PlaceStep& place) {
    if (names_.supports.contains(text)) {
      place.supports = {name};
      place.pose.reset();
    }
  };
  static_cast<void>(change<PickStep>([&](PickStep& pick) { pick.object = name; }) ||
                    change<PlaceStep>(place_there) ||
                    change<PostureStep>([&](PostureStep& move) { move.posture = name; }) ||
                    change<PoseStep>([&](PoseStep& move) { move.goal.link = name; }));
}

void StepFields::take_lengths() {
  const double first = first_->quantity();
  const double second = second_->quantity();
  const auto of_pick = [&](PickStep& pick) {
    pick.approach = first;
    pick.lift = second;
  };
  const auto of_place = [&](PlaceStep& place) {
    place.lower = first;
    place.retreat = second;
  };
  static_cast<void>(change<PickStep>(of_pick) || change<PlaceStep>(of_place));
}

void StepFields::take_frame() {
  const std::string reference = chosen_frame();
  const auto of_pose = [&](PoseStep& move) {
    const geometric::Pose* before = find_frame(move.goal.reference);
    const geometric::Pose* after = find_frame(reference);
    if (before != nullptr && after != nullptr && reference != move.goal.reference) {
      move.goal.X_WG = after->inverse() * *before * move.goal.X_WG;
    }
    move.goal.reference = reference;
  };
  static_cast<void>(change<PoseStep>(of_pose) ||
                    change<LineStep>([&](LineStep& line) { line.reference = reference; }));
}

// A vector without a length, or too long a one, waits for the next field.
void StepFields::take_line() {
  const Eigen::Vector3d shift(shift_[0]->quantity(), shift_[1]->quantity(), shift_[2]->quantity());
  if (shift.norm() > 0.0 && shift.norm() <= geometric::kLongestStraightMotion) {
    change<LineStep>([&](LineStep& line) { line.shift = shift; });
  }
}

void StepFields::take_output() {
  const auto* shown = std::get_if<OutputStep>(&step_);
  if (shown == nullptr) {
    return;
  }
  OutputStep output = *shown;
  const std::string name = output_name_->text().trimmed().toStdString();
  output.name = name.empty() ? output.name : name;
  const int row = output_value_->currentIndex();
  if (row == kNumber) {
    output.value = output_number_->value();
  } else {
    output.value = row == kOn;
  }
  if (output.name == shown->name && output.value == shown->value) {
    show_values(output);
    return;
  }
  change<OutputStep>([&](OutputStep& step) { step = output; });
}

}  // namespace handway::gui
