#pragma once

#include "model/planning/query_doctor.h"

#include <QObject>

namespace handway::gui {

class Document;
class DoctorCard;
class Posing;
class SceneEditor;
class SceneView;

/// Looks after start and goal of the document: what can't be planned with is explained in the
/// view, with a free posture nearby to take instead.
class QueryCheck : public QObject {
  Q_OBJECT

 public:
  /// All outlive it. The card floats over the view.
  QueryCheck(Document& document, SceneEditor& editor, Posing& posing, SceneView& view,
             QObject* parent = nullptr);

  [[nodiscard]] bool is_busy() const { return doctor_.is_busy(); }
  [[nodiscard]] const DoctorCard& card() const { return *card_; }

 private:
  void examine();
  void take(const std::vector<EndDiagnosis>& ends);

  Document& document_;
  SceneView& view_;
  QueryDoctor doctor_;
  DoctorCard* card_;
};

}  // namespace handway::gui
