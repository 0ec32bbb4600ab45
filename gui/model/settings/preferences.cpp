#include "model/settings/preferences.h"

#include "handway/geometric/math/units.h"
#include "handway/planning/core/request_parameters.h"

#include <QSettings>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace handway::gui {

UnitText unit_text(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::kMillimetre:
      break;
    case LengthUnit::kCentimetre:
      return {QStringLiteral(" cm"), 10.0};
    case LengthUnit::kMetre:
      return {QStringLiteral(" m"), 1000.0};
    case LengthUnit::kInch:
      return {QStringLiteral(" in"), 25.4};
  }
  return {QStringLiteral(" mm"), 1.0};
}

UnitText unit_text(AngleUnit unit) {
  return unit == AngleUnit::kDegree ? UnitText{QStringLiteral("°"), 1.0}
                                    : UnitText{QStringLiteral(" rad"), geometric::degrees(1.0)};
}

namespace {

template <typename Value, std::size_t kCount>
using Words = std::array<std::pair<Value, const char*>, kCount>;

constexpr Words<std::optional<Theme>, 3> kThemes{
    {{std::nullopt, "desktop"}, {Theme::kLight, "light"}, {Theme::kDark, "dark"}}};
constexpr Words<LengthUnit, 4> kLengths{{{LengthUnit::kMillimetre, "mm"},
                                         {LengthUnit::kCentimetre, "cm"},
                                         {LengthUnit::kMetre, "m"},
                                         {LengthUnit::kInch, "in"}}};
constexpr Words<AngleUnit, 2> kAngles{{{AngleUnit::kDegree, "deg"}, {AngleUnit::kRadian, "rad"}}};
constexpr Words<Projection, 2> kProjections{
    {{Projection::kPerspective, "perspective"}, {Projection::kOrthographic, "orthographic"}}};
constexpr Words<NavigationStyle, 3> kStyles{{{NavigationStyle::kLeftTurns, "left"},
                                             {NavigationStyle::kMiddleTurns, "middle"},
                                             {NavigationStyle::kRightTurns, "right"}}};

/// Reads or writes each value under its key.
class Reader {
 public:
  template <typename Value, std::size_t kCount>
  void word(const char* key, Value& value, const Words<Value, kCount>& words) const {
    const QString kept = settings_.value(QLatin1String(key)).toString();
    const auto found =
        std::ranges::find_if(words, [&](const auto& word) { return kept == word.second; });
    value = found == words.end() ? value : found->first;
  }
  void number(const char* key, int& value, int least, int most) const {
    bool understood = false;
    const int kept = settings_.value(QLatin1String(key)).toInt(&understood);
    value = understood && kept >= least && kept <= most ? kept : value;
  }
  void number(const char* key, double& value, double least, double most) const {
    bool understood = false;
    const double kept = settings_.value(QLatin1String(key)).toDouble(&understood);
    value = understood && kept >= least && kept <= most ? kept : value;
  }
  void flag(const char* key, bool& value) const {
    value = settings_.value(QLatin1String(key), value).toBool();
  }
  void text(const char* key, QString& value) const {
    value = settings_.value(QLatin1String(key), value).toString();
  }

 private:
  QSettings settings_;
};

class Writer {
 public:
  template <typename Value, std::size_t kCount>
  void word(const char* key, const Value& value, const Words<Value, kCount>& words) {
    const auto found =
        std::ranges::find_if(words, [&](const auto& word) { return value == word.first; });
    settings_.setValue(QLatin1String(key), QLatin1String(found->second));
  }
  template <typename Value>
  void number(const char* key, const Value& value, Value /*least*/, Value /*most*/) {
    settings_.setValue(QLatin1String(key), value);
  }
  void flag(const char* key, bool value) { settings_.setValue(QLatin1String(key), value); }
  void text(const char* key, const QString& value) {
    settings_.setValue(QLatin1String(key), value);
  }

 private:
  QSettings settings_;
};

double largest_requested(const char* setting) {
  return find_parameter(planning::request_parameters(), setting).upper;
}

template <typename Visitor, typename Values>
void visit(Visitor&& visitor, Values& values) {
  visitor.word("theme", values.theme, kThemes);
  visitor.number("text_size", values.text_size, 100, 200);
  visitor.word("units/length", values.units.length, kLengths);
  visitor.word("units/angle", values.units.angle, kAngles);
  visitor.word("view/projection", values.projection, kProjections);
  visitor.word("view/navigation", values.navigation.style, kStyles);
  visitor.flag("view/wheel_reversed", values.navigation.wheel_reversed);
  visitor.flag("view/floor", values.floor);
  visitor.flag("view/cube", values.cube);
  visitor.number("view/samples", values.samples, 0, 8);
  visitor.flag("view/shadows", values.shadows);
  visitor.flag("view/always_fine", values.always_fine);
  visitor.number("view/frame_limit", values.frame_limit, 0, 1000);
  visitor.text("planning/planner", values.planner);
  visitor.number("planning/threads", values.threads, 0,
                 static_cast<int>(largest_requested("threads")));
  visitor.number("planning/time_limit", values.time_limit, 0.0, largest_requested("time_limit"));
  visitor.flag("saving/autosave", values.autosave);
}

}  // namespace

Preferences::Preferences(QObject* parent) : QObject(parent) { visit(Reader(), values_); }

void Preferences::set(const PreferenceValues& values) {
  if (values != values_) {
    values_ = values;
    visit(Writer(), std::as_const(values_));
    emit changed();
  }
}

}  // namespace handway::gui
