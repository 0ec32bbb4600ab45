#include "glove_dock.h"

#include "handway/device/glove/glove_layout.h"
#include "patience.h"

#include <QSignalSpy>

namespace handway::test {
device::HandMapping pincers_mapping() {
  device::HandMapping mapping;
  mapping.hand = "pincers";
  mapping.joints.resize(2);
  mapping.joints[0].joint = "left";
  mapping.joints[0].sensor = device::find_sensor("IndexMPJ").value();
  mapping.joints[1].joint = "right";
  mapping.joints[1].sensor = device::find_sensor("MiddleMPJ").value();
  mapping.joints[1].gain = -1.0;
  return mapping;
}

void GloveDock::SetUp() {
  WindowTest::SetUp();
  if (!IsSkipped()) {
    open(cell().post());
    panel().session().set_mapping(pincers_mapping());
    panel().come_to_front();
  }
}

void GloveDock::connect_to(const QString& device) const {
  part<QComboBox>("glove_device").lineEdit()->setText(device);
  click("glove_connect");
}

void GloveDock::connect_to_emulator() {
  emulator_ = std::make_unique<device::GloveEmulator>(
      device::GloveEmulatorSettings{}, [counts = counts_](double) {
        std::array<std::uint16_t, device::kGloveSensors> all{};
        all.fill(*counts);
        return all;
      });
  connect_to(QString::fromStdString(emulator_->address()));
  ASSERT_TRUE(waits_for(device::StreamState::kStreaming));
}

bool GloveDock::waits_for(device::StreamState state) const {
  return QTest::qWaitFor([&] { return panel().session().link().state() == state; }, kPatienceMs);
}

double GloveDock::joint(const char* name) const {
  const auto variable = window().document().robot()->model->find_variable(name);
  return window().document().configuration()[variable.value()];
}

}  // namespace handway::test
