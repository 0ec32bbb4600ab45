#pragma once

#include <QWidget>

#include <array>

namespace handway::gui {

class SceneView;

/// Two views side by side that always look from the same place.
class LockedViews : public QWidget {
  Q_OBJECT

 public:
  explicit LockedViews(QWidget* parent = nullptr);

  [[nodiscard]] SceneView& view(std::size_t index) const { return *views_.at(index); }

 protected:
  void changeEvent(QEvent* event) override;

 private:
  /// The other view has to look as this one does.
  void follow(std::size_t index);

  std::array<SceneView*, 2> views_;
};

}  // namespace handway::gui
