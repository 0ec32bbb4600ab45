#pragma once

#include "features/glove/glove_panel.h"
#include "features/glove/sensor_bars.h"
#include "handway/device/emulators/glove_emulator.h"
#include "window_test.h"

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>

#include <array>
#include <atomic>
#include <memory>

namespace handway::test {

/// A workbench with a hand of two joints on the small cell's arm, driven by the index (left) and
/// the middle finger's inner sensor (right); and an emulated glove whose sensors all read what the
/// test sets.
class GloveDock : public WindowTest {
 protected:
  /// Opens the cell and wires its two fingers.
  void SetUp() override;

  /// Types the address into the field and clicks Connect.
  void connect_to(const QString& device) const;
  /// Connects to an emulated glove and waits until it streams.
  void connect_to_emulator();
  [[nodiscard]] bool waits_for(device::StreamState state) const;
  /// Sets the counts that the emulated sensors read from now on.
  void set_counts(std::uint16_t counts) { *counts_ = counts; }
  void unplug() { emulator_.reset(); }

  [[nodiscard]] gui::GlovePanel& panel() const { return tool<gui::GlovePanel>(); }
  [[nodiscard]] double joint(const char* name) const;
  [[nodiscard]] const std::shared_ptr<std::atomic<std::uint16_t>>& counts() const {
    return counts_;
  }
  [[nodiscard]] const device::GloveEmulator& emulator() const { return *emulator_; }

 private:
  std::shared_ptr<std::atomic<std::uint16_t>> counts_ =
      std::make_shared<std::atomic<std::uint16_t>>(std::uint16_t{100});
  std::unique_ptr<device::GloveEmulator> emulator_;
};

/// left = angle of IndexMPJ, right = -angle of MiddleMPJ.
[[nodiscard]] device::HandMapping pincers_mapping();

}  // namespace handway::test
