#pragma once

#include <QPoint>

#include <xcb/xcb.h>

namespace handway::test {

/// Keys and clicks as a keyboard and a mouse make them, through the X server. They are everybody's
/// who shares the screen: only for tests that run alone.
class XInput {
 public:
  /// @throws std::runtime_error without an X server that has the XTEST extension.
  XInput();
  ~XInput();
  XInput(const XInput&) = delete;
  XInput& operator=(const XInput&) = delete;

  /// Presses a key and lets it go. @param keysym of X.Org. @throws std::runtime_error if no key of
  /// the keyboard has it.
  void type(xcb_keysym_t keysym);
  /// Presses the left button at a place of the screen, in device pixels, and lets it go.
  void click(const QPoint& place);

 private:
  void send(std::uint8_t type, std::uint8_t detail, const QPoint& place);

  xcb_connection_t* x_;
};

inline constexpr xcb_keysym_t kPauseKey = 0xff13;
inline constexpr xcb_keysym_t kF12Key = 0xffc9;

}  // namespace handway::test
