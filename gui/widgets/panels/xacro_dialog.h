#pragma once

#include "handway/geometric/formats/xacro_file.h"

#include <QDialog>
#include <QString>

#include <filesystem>
#include <functional>
#include <utility>
#include <vector>

class QLineEdit;
class QWidget;

namespace handway::gui {

/// Asks for the arguments of a xacro file, with its defaults filled in.
class XacroDialog : public QDialog {
  Q_OBJECT

 public:
  /// @param contents has arguments.
  XacroDialog(const std::filesystem::path& file, const geometric::XacroFile& contents,
              QWidget* parent = nullptr);

  /// Returns the arguments whose values differ from the defaults.
  [[nodiscard]] geometric::XacroArguments arguments() const;

 private:
  [[nodiscard]] QString words(const geometric::XacroFile& contents) const;

  std::filesystem::path file_;
  std::vector<std::pair<geometric::XacroArgument, QLineEdit*>> fields_;
};

/// Asks for the arguments of a robot file in xacro, and passes them to `use`; not called if the
/// user cancels. Files that take no arguments, or can't be read, are passed on at once.
void with_xacro_arguments(QWidget* parent, const std::filesystem::path& file,
                          const std::function<void(const geometric::XacroArguments&)>& use);

}  // namespace handway::gui
