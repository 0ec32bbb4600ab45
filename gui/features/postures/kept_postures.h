#pragma once

#include <QObject>

class QAction;

namespace handway::gui {

class Document;
class PostureBar;
class SceneEditor;

/// Keeps postures by name in the scene, and forgets them again, each in an edit that can be undone.
class KeptPostures : public QObject {
  Q_OBJECT

 public:
  /// All outlive it. @param keep asks for it, in menus.
  KeptPostures(const Document& document, SceneEditor& editor, PostureBar& bar, QAction& keep,
               QObject* parent = nullptr);

 private:
  /// Asks for a name.
  void keep_this();

  const Document& document_;
  SceneEditor& editor_;
  PostureBar& bar_;
};

}  // namespace handway::gui
