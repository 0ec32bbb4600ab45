#pragma once

#include "model/document/prepared_problem.h"
#include "model/jobs/background.h"

#include <QObject>
#include <QString>

#include <memory>

namespace handway::gui {

class PathPlayer;

/// Validity of the path on screen in the present scene. An edit revokes it at once; the path is
/// then checked in the edited scene, in the background.
class PathValidity : public QObject {
  Q_OBJECT

 public:
  enum class State {
    kNoPath,
    kValid,
    kOutOfDate,  ///< It was valid before an edit, or in no scene so far; the check goes on.
    kInvalid,
  };

  /// @param player outlives it.
  explicit PathValidity(PathPlayer& player, QObject* parent = nullptr);

  /// The scene as it is from now on; null: it makes no problem.
  void follow(std::shared_ptr<const PreparedProblem> scene);

  [[nodiscard]] State state() const { return state_; }
  /// Returns the reason why the path is not valid, a sentence; empty if it is, or there is none.
  [[nodiscard]] const QString& reason() const { return reason_; }

 signals:
  void changed();

 private:
  void look();
  /// Returns whether the path was valid in some revision of the scene.
  [[nodiscard]] bool was_valid() const;
  void check();
  void set(State state, const QString& reason = {});

  PathPlayer& player_;
  std::shared_ptr<const PreparedProblem> scene_;
  State state_ = State::kNoPath;
  QString reason_;
  LatestJob job_;
};

}  // namespace handway::gui
