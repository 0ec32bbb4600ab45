#pragma once

#include "model/settings/preferences.h"

#include <QDialog>
#include <QStringList>

#include <functional>
#include <string>
#include <vector>

class QFormLayout;

namespace handway::gui {

class Workbench;

/// Shows all preferences. Each works as soon as it is changed.
class PreferencesDialog : public QDialog {
  Q_OBJECT

 public:
  /// @param preferences outlive the dialog. @param planners by name; the first is the usual one.
  PreferencesDialog(Preferences& preferences, const QStringList& planners,
                    QWidget* parent = nullptr);

 private:
  template <typename Value>
  struct Choice {
    QString text;
    Value value;
  };
  using Values = PreferenceValues;

  void add_appearance(QFormLayout& form);
  void add_view(QFormLayout& form);
  void add_planning(QFormLayout& form, const QStringList& planners);
  void add_saving(QFormLayout& form);
  /// A box for one of several values. @param get the value within all of them.
  template <typename Value>
  void add_choice(QFormLayout& form, const char* name, const QString& label,
                  const std::vector<Choice<Value>>& choices,
                  const std::function<Value&(Values&)>& get);
  void add_switch(QFormLayout& form, const char* name, const QString& label,
                  const std::function<bool&(Values&)>& get);
  void add_number(QFormLayout& form, const char* name, const QString& label, QWidget* field);

  Preferences& preferences_;
  std::vector<std::function<void()>> show_;  ///< Each shows one value as it is now.
};

/// Adds the command that shows the dialog.
void add_preferences(Workbench& workbench);

}  // namespace handway::gui
