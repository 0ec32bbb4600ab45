#pragma once

#include "app/main_window.h"
#include "small_cell.h"

#include <QApplication>
#include <QTest>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

/// Skips a test of widgets where there is no display.
#define HANDWAY_NEED_DISPLAY()                           \
  if (!QCoreApplication::instance()) {                   \
    GTEST_SKIP() << "no display: run it under xvfb-run"; \
  }

namespace handway::test {

/// A workbench on screen, driven as a person would. No step may keep it from answering.
class WindowTest : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;
  /// The plugins of the window: none.
  [[nodiscard]] virtual std::shared_ptr<planning::PluginManager> plugins() const;

  /// Opens a file and waits until it is shown or refused.
  void open(const std::filesystem::path& file);
  /// Clicks Plan and waits for the end.
  void plan();
  /// The button, slider or label of that name.
  template <typename Widget>
  [[nodiscard]] Widget& part(const char* name) const {
    auto* widget = window_->findChild<Widget*>(QLatin1String(name));
    if (!widget) {
      throw std::runtime_error(std::string("no part called ") + name);
    }
    return *widget;
  }
  /// The window's only panel, tool or display of that type.
  template <typename Tool>
  [[nodiscard]] Tool& tool() const {
    auto* found = window_->findChild<Tool*>();
    if (!found) {
      throw std::runtime_error(std::string("no ") + Tool::staticMetaObject.className());
    }
    return *found;
  }
  void click(const char* button) const;
  /// Shows a dock before the others that share its place.
  void show_dock(const char* name) const;
  /// Saves a picture of the window in the folder $HANDWAY_PICTURES, if there is one.
  void keep_picture(const char* name) const;
  /// Returns the text of the plan panel's result.
  [[nodiscard]] std::string result() const;

  [[nodiscard]] gui::MainWindow& window() const { return *window_; }
  [[nodiscard]] const SmallCell& cell() const { return cell_; }

 private:
  SmallCell cell_;
  std::unique_ptr<gui::MainWindow> window_;
};

}  // namespace handway::test
