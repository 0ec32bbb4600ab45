#include "model/document/recorded_hand.h"

#include <exception>
#include <utility>

namespace handway::gui {

void RecordedHand::set_basis(std::shared_ptr<const sampling::PmdBasis> basis) {
  if (basis != basis_) {
    basis_ = std::move(basis);
    read();
  }
}

void RecordedHand::choose(const std::filesystem::path& file) {
  if (basis_) {
    chosen_ = file;
    chosen_for_ = basis_->hand;
    read();
  }
}

void RecordedHand::read() {
  job_.cancel();
  postures_.reset();
  fault_.clear();
  const bool has_choice = basis_ && !chosen_.empty() && chosen_for_ == basis_->hand;
  const std::filesystem::path file =
      has_choice ? chosen_ : (basis_ ? basis_->postures : std::filesystem::path());
  state_ = file.empty() ? State::kNone : State::kReading;
  if (state_ == State::kReading) {
    job_.run([this, file, basis = basis_](const std::stop_token&) -> LatestJob::Answer {
      try {
        return [this, read = sampling::load_recorded_postures(*basis, file)] {
          postures_ = read;
          state_ = State::kReady;
          emit changed();
        };
      } catch (const std::exception& error) {
        return [this, message = QString::fromUtf8(error.what())] {
          fault_ = message;
          state_ = State::kFailed;
          emit changed();
        };
      }
    });
  }
  emit changed();
}

}  // namespace handway::gui
