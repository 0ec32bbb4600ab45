#pragma once

#include <QElapsedTimer>
#include <QUndoCommand>

#include <functional>
#include <string>
#include <typeinfo>
#include <utility>

namespace handway::gui {

/// An entry of the window's history.
class Edit : public QUndoCommand {
 public:
  /// @param kind edits of one kind that follow each other at once become one; empty: never.
  /// @param is_saved whether the scene's file keeps what is edited.
  Edit(const QString& text, std::string kind, bool is_saved)
      : QUndoCommand(text), kind_(std::move(kind)), is_saved_(is_saved) {
    age_.start();
  }

  [[nodiscard]] bool is_saved() const { return is_saved_; }
  [[nodiscard]] int id() const override { return kind_.empty() ? -1 : 1; }
  bool mergeWith(const QUndoCommand* other) override {
    constexpr qint64 kOneGestureMs = 900;
    const auto* later = dynamic_cast<const Edit*>(other);
    if (!later || typeid(*later) != typeid(*this) || later->kind_ != kind_ ||
        age_.elapsed() > kOneGestureMs) {
      return false;
    }
    is_saved_ = is_saved_ || later->is_saved_;
    take_over(*later);
    age_.restart();
    return true;
  }

 protected:
  /// @param later of the same class and kind.
  virtual void take_over(const Edit& later) = 0;

 private:
  std::string kind_;
  bool is_saved_;
  QElapsedTimer age_;
};

/// Edit from one value to another and back.
template <typename Value>
class ValueEdit final : public Edit {
 public:
  /// @param put puts a value in place.
  ValueEdit(const QString& text, std::string kind, bool is_saved, Value before, Value after,
            std::function<void(const Value&)> put)
      : Edit(text, std::move(kind), is_saved),
        before_(std::move(before)),
        after_(std::move(after)),
        put_(std::move(put)) {}

  void undo() override { put_(before_); }
  void redo() override { put_(after_); }

 private:
  void take_over(const Edit& later) override {
    after_ = static_cast<const ValueEdit&>(later).after_;
  }

  Value before_;
  Value after_;
  std::function<void(const Value&)> put_;
};

}  // namespace handway::gui
