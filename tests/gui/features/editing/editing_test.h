#pragma once

#include "features/editing/scene_editing.h"
#include "view3d/scene_view.h"
#include "view3d/view_gizmo.h"
#include "widgets/forms/quantity_field.h"
#include "window_test.h"

#include <QtTest>

#include <stdexcept>
#include <string>

namespace handway::test {

/// A window with the post between start and goal, to be edited.
class EditingTest : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (!IsSkipped()) {
      open(cell().post());
    }
  }

  [[nodiscard]] gui::SceneEditor& editor() const { return window().editor(); }
  [[nodiscard]] gui::EditActions& actions() const { return tool<gui::EditActions>(); }
  [[nodiscard]] const geometric::Scene& scene() const { return *window().document().scene(); }
  [[nodiscard]] const geometric::SceneObject& object(const char* name) const {
    const geometric::SceneObject* found = geometric::find_object(scene(), name);
    if (!found) {
      throw std::runtime_error(std::string("no object called ") + name);
    }
    return *found;
  }
  [[nodiscard]] const geometric::ObjectDisplay& display(const char* name) const {
    return scene().display.of(name);
  }
  /// Returns the position of a point of the world in the view.
  [[nodiscard]] QPoint seen(const Eigen::Vector3d& p_W) const {
    const gui::SceneView& view = window().view();
    return gui::place_of(view.camera(), view.size(), p_W).toPoint();
  }
  void select(const char* name) const {
    editor().select({gui::SceneItem::Kind::kObject, "", name});
  }
  /// Types into the QuantityField of this name, followed by Return.
  void type(const char* field, const char* text) const {
    auto& box = part<gui::QuantityField>(field);
    box.selectAll();
    QTest::keyClicks(&box, text);
    QTest::keyClick(&box, Qt::Key_Return);
  }
};

}  // namespace handway::test
