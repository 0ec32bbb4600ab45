#pragma once

#include "handway/sampling/postures/recorded_postures.h"
#include "model/jobs/background.h"

#include <QObject>
#include <QString>

#include <filesystem>
#include <memory>

namespace handway::gui {

/// The recorded postures that a hand is compared with: those that its basis names, or those of a
/// file that a person chose, read in the background.
class RecordedHand : public QObject {
  Q_OBJECT

 public:
  enum class State {
    kNone,  ///< The basis names none, and none were chosen; or there is no basis.
    kReading,
    kReady,
    kFailed,
  };

  explicit RecordedHand(QObject* parent = nullptr) : QObject(parent) {}

  /// Of another scene. What was chosen stays for the same hand. @param basis may be null.
  void set_basis(std::shared_ptr<const sampling::PmdBasis> basis);
  /// Compares with a file's postures (sampling::read_postures()) instead of the basis'.
  void choose(const std::filesystem::path& file);

  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] const std::shared_ptr<const sampling::PmdBasis>& basis() const { return basis_; }
  /// Null unless kReady.
  [[nodiscard]] const std::shared_ptr<const sampling::RecordedPostures>& postures() const {
    return postures_;
  }
  /// Why they couldn't be read; a sentence.
  [[nodiscard]] const QString& fault() const { return fault_; }

 signals:
  void changed();

 private:
  void read();

  std::shared_ptr<const sampling::PmdBasis> basis_;
  std::filesystem::path chosen_;
  std::string chosen_for_;  ///< Hand.
  State state_ = State::kNone;
  std::shared_ptr<const sampling::RecordedPostures> postures_;
  QString fault_;
  LatestJob job_;
};

}  // namespace handway::gui
