#include "features/preferences/preferences_dialog.h"

#include "features/workbench.h"
#include "handway/planning/core/request_parameters.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/typed_input.h"
#include "widgets/panels/dock_layout.h"
#include "widgets/style/theme.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QMainWindow>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>

#include <algorithm>

namespace handway::gui {
namespace {

constexpr int kFieldWidth = 260;

}  // namespace

PreferencesDialog::PreferencesDialog(Preferences& preferences, const QStringList& planners,
                                     QWidget* parent)
    : QDialog(parent), preferences_(preferences) {
  setObjectName(QStringLiteral("preferences"));
  setWindowTitle(tr("Preferences"));
  setAttribute(Qt::WA_DeleteOnClose);
  auto* content = new QWidget;
  auto* area = new PanelArea(content);
  auto* form = new QFormLayout(content);
  form->setContentsMargins(14, 10, 14, 12);
  form->setHorizontalSpacing(24);
  form->setVerticalSpacing(7);
  form->setFieldGrowthPolicy(QFormLayout::FieldsStayAtSizeHint);
  add_appearance(*form);
  add_view(*form);
  add_planning(*form, planners);
  add_saving(*form);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::RestoreDefaults | QDialogButtonBox::Close);
  QPushButton* restore = buttons->button(QDialogButtonBox::RestoreDefaults);
  restore->setObjectName(QStringLiteral("restore_defaults"));
  restore->setAutoDefault(false);
  connect(restore, &QPushButton::clicked, this, [this] { preferences_.set(Values{}); });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  lay_out(*this, in_column({{area, 1}, buttons}, 16), {20, 12, 20, 16});
  const auto show_all = [this] {
    for (const std::function<void()>& show : show_) {
      show();
    }
  };
  show_all();
  resize(within_window(*this, sizeHint()));
  connect(&preferences_, &Preferences::changed, this, show_all);
}

void PreferencesDialog::add_appearance(QFormLayout& form) {
  form.addRow(heading(tr("Appearance")));
  add_choice<std::optional<Theme>>(
      form, "theme", tr("Theme"),
      {{tr("Follow system"), std::nullopt},
       {tr("Light"), Theme::kLight},
       {tr("Dark"), Theme::kDark}},
      [](Values& values) -> std::optional<Theme>& { return values.theme; });
  add_choice<int>(form, "text_size", tr("Text size (after restart)"),
                  {{tr("100 %"), 100}, {tr("125 %"), 125}, {tr("150 %"), 150}, {tr("200 %"), 200}},
                  [](Values& values) -> int& { return values.text_size; });
  add_choice<LengthUnit>(form, "length_unit", tr("Lengths in fields"),
                         {{tr("Millimetres"), LengthUnit::kMillimetre},
                          {tr("Centimetres"), LengthUnit::kCentimetre},
                          {tr("Metres"), LengthUnit::kMetre},
                          {tr("Inches"), LengthUnit::kInch}},
                         [](Values& values) -> LengthUnit& { return values.units.length; });
  add_choice<AngleUnit>(form, "angle_unit", tr("Angles in fields"),
                        {{tr("Degrees"), AngleUnit::kDegree}, {tr("Radians"), AngleUnit::kRadian}},
                        [](Values& values) -> AngleUnit& { return values.units.angle; });
}

void PreferencesDialog::add_view(QFormLayout& form) {
  form.addRow(heading(tr("3-D view")));
  add_choice<Projection>(form, "projection", tr("Projection"),
                         {{tr("Perspective"), Projection::kPerspective},
                          {tr("Orthographic"), Projection::kOrthographic}},
                         [](Values& values) -> Projection& { return values.projection; });
  add_choice<NavigationStyle>(
      form, "navigation", tr("Mouse"),
      {{tr("RViz: left turns, middle moves"), NavigationStyle::kLeftTurns},
       {tr("Blender: middle turns, Shift+middle moves"), NavigationStyle::kMiddleTurns},
       {tr("CAD: right turns, middle moves"), NavigationStyle::kRightTurns}},
      [](Values& values) -> NavigationStyle& { return values.navigation.style; });
  add_choice<bool>(form, "wheel", tr("Wheel forwards"),
                   {{tr("Zooms in"), false}, {tr("Zooms out"), true}},
                   [](Values& values) -> bool& { return values.navigation.wheel_reversed; });
  add_choice<int>(
      form, "samples", tr("Smooth edges"),
      {{tr("Off"), 0}, {tr("2 samples"), 2}, {tr("4 samples"), 4}, {tr("8 samples"), 8}},
      [](Values& values) -> int& { return values.samples; });
  add_choice<bool>(form, "motion_quality", tr("During motions"),
                   {{tr("Fast pictures"), false}, {tr("Fine pictures"), true}},
                   [](Values& values) -> bool& { return values.always_fine; });
  add_choice<int>(form, "frame_limit", tr("Frames per second"),
                  {{tr("At most 30"), 30}, {tr("At most 60"), 60}, {tr("No limit"), 0}},
                  [](Values& values) -> int& { return values.frame_limit; });
  add_switch(form, "shadows", tr("Shadows"),
             [](Values& values) -> bool& { return values.shadows; });
  add_switch(form, "show_floor", tr("Floor grid"),
             [](Values& values) -> bool& { return values.floor; });
  add_switch(form, "show_cube", tr("Orientation cube"),
             [](Values& values) -> bool& { return values.cube; });
}

void PreferencesDialog::add_planning(QFormLayout& form, const QStringList& planners) {
  form.addRow(heading(tr("Planning")));
  std::vector<Choice<QString>> choices;
  for (const QString& planner : planners) {
    choices.push_back({planner, planner == planners.front() ? QString() : planner});
  }
  add_choice<QString>(form, "usual_planner", tr("Planner of new scenes"), choices,
                      [](Values& values) -> QString& { return values.planner; });
  auto* threads = new QSpinBox;
  const auto most = [](const char* key) {
    return find_parameter(planning::request_parameters(), key).upper;
  };
  threads->setRange(0, static_cast<int>(most("threads")));
  threads->setSpecialValueText(tr("One per processor"));
  connect(threads, qOverload<int>(&QSpinBox::valueChanged), this,
          [this](int value) { preferences_.set(&Values::threads, value); });
  show_.emplace_back([this, threads] { show_value(*threads, preferences_.values().threads); });
  add_number(form, "usual_threads", tr("Threads"), threads);
  auto* limit = new QDoubleSpinBox;
  limit->setRange(0.0, most("time_limit"));
  limit->setDecimals(1);
  limit->setSuffix(tr(" s"));
  limit->setSpecialValueText(tr("None"));
  connect(limit, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          [this](double value) { preferences_.set(&Values::time_limit, value); });
  show_.emplace_back([this, limit] { show_value(*limit, preferences_.values().time_limit); });
  add_number(form, "usual_time_limit", tr("Time limit"), limit);
}

void PreferencesDialog::add_saving(QFormLayout& form) {
  form.addRow(heading(tr("Saving")));
  add_switch(form, "autosave", tr("Keep unsaved changes for recovery"),
             [](Values& values) -> bool& { return values.autosave; });
}

template <typename Value>
void PreferencesDialog::add_choice(QFormLayout& form, const char* name, const QString& label,
                                   const std::vector<Choice<Value>>& choices,
                                   const std::function<Value&(Values&)>& get) {
  auto* box = new QComboBox;
  box->setObjectName(QLatin1String(name));
  box->setFixedWidth(scaled(kFieldWidth));
  for (const Choice<Value>& choice : choices) {
    box->addItem(choice.text);
  }
  connect(box, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [this, choices, get](int index) {
            Values values = preferences_.values();
            get(values) = choices.at(static_cast<std::size_t>(index)).value;
            preferences_.set(values);
          });
  show_.emplace_back([this, box, choices, get] {
    Values values = preferences_.values();
    const auto now = std::ranges::find(choices, get(values), &Choice<Value>::value);
    const QSignalBlocker quiet(box);
    box->setCurrentIndex(now == choices.end() ? -1 : static_cast<int>(now - choices.begin()));
  });
  form.addRow(label, box);
}

void PreferencesDialog::add_switch(QFormLayout& form, const char* name, const QString& label,
                                   const std::function<bool&(Values&)>& get) {
  auto* box = new QCheckBox(label);
  box->setObjectName(QLatin1String(name));
  connect(box, &QCheckBox::toggled, this, [this, get](bool on) {
    Values values = preferences_.values();
    get(values) = on;
    preferences_.set(values);
  });
  show_.emplace_back([this, box, get] {
    Values values = preferences_.values();
    const QSignalBlocker quiet(box);
    box->setChecked(get(values));
  });
  form.addRow(QString(), box);
}

void PreferencesDialog::add_number(QFormLayout& form, const char* name, const QString& label,
                                   QWidget* field) {
  field->setObjectName(QLatin1String(name));
  field->setFixedWidth(scaled(kFieldWidth));
  form.addRow(label, field);
}

namespace {

// The one that is open already, if there is one.
void show_preferences(Workbench& workbench) {
  if (auto* open = workbench.window.findChild<PreferencesDialog*>()) {
    open->activateWindow();
    return;
  }
  QStringList planners;
  for (const std::string& name : workbench.plugins->planners().names()) {
    planners << QString::fromStdString(name);
  }
  (new PreferencesDialog(workbench.preferences, planners, &workbench.window))->show();
}

}  // namespace

void add_preferences(Workbench& workbench) {
  QAction* action = workbench.make_action(
      QStringLiteral("preferences"), QObject::tr("Pre&ferences…"),
      QKeySequence(QStringLiteral("Ctrl+,")), QObject::tr("How the workbench looks and behaves"));
  workbench.add_to_menu(MainMenu::kFile, {2, 0}, action);
  QObject::connect(action, &QAction::triggered, &workbench,
                   [&workbench] { show_preferences(workbench); });
}

}  // namespace handway::gui
