#pragma once

#include <QPoint>

#include <xcb/xcb.h>

#include <cstdint>
#include <vector>

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

  /// Presses keys, one after the other, and lets them go. @param keysyms of X.Org.
  /// @throws std::runtime_error if the keyboard has no such key.
  void type(const std::vector<xcb_keysym_t>& keysyms);
  /// Gives the keyboard to a window that is another program's for the X server.
  void take_keyboard();
  /// Presses the left button at a place of the screen, in device pixels, and lets it go.
  void click(const QPoint& place);

 private:
  [[nodiscard]] std::uint8_t code_of(xcb_keysym_t keysym) const;
  void send(std::uint8_t type, std::uint8_t detail, const QPoint& place);

  xcb_connection_t* x_;
};

inline constexpr xcb_keysym_t kPauseKey = 0xff13;
inline constexpr xcb_keysym_t kF12Key = 0xffc9;
inline constexpr xcb_keysym_t kControlKey = 0xffe3;
inline constexpr xcb_keysym_t kSpaceKey = 0x0020;

}  // namespace handway::test
