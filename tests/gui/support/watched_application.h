#pragma once

#include <QApplication>
#include <QString>

namespace handway::test {

/// Period in which the GUI thread was busy.
struct Stall {
  double ms = 0.0;
  QString event;  ///< "Resize at SceneView"
};

/// Measures how long the GUI thread is busy with one event, with all that follows from it before
/// the next, but for painting. Processor time counts and not the clock's, so that other programs
/// matter little.
class WatchedApplication : public QApplication {
 public:
  using QApplication::QApplication;

  /// The longest since forget().
  [[nodiscard]] static const Stall& longest() { return longest_; }
  static void forget() { longest_ = {}; }

  /// Suspends the measurement as long as it lives.
  class LooksAway {
   public:
    LooksAway() { ++depth_; }
    ~LooksAway() { --depth_; }
    LooksAway(const LooksAway&) = delete;
    LooksAway& operator=(const LooksAway&) = delete;
  };

  bool notify(QObject* receiver, QEvent* event) override;

 private:
  bool paint(QObject* receiver, QEvent* event);

  inline static Stall longest_;
  inline static double painting_ms_ = 0.0;  ///< Painting time of the event.
  inline static bool is_painting_ = false;
  inline static int depth_ = 0;
};

/// The longest that a step of a person may keep the window from answering. 50 ms are wanted; a
/// busy machine's shared caches may make three times that of it, and sanitizers as much again.
#ifdef HANDWAY_SANITIZED
inline constexpr double kLongestStallMs = 600.0;
#else
inline constexpr double kLongestStallMs = 150.0;
#endif

/// Fails the test that runs if there was a longer one since forget(), and reports it in any case.
void expect_no_stall(double most_ms = kLongestStallMs);

}  // namespace handway::test
