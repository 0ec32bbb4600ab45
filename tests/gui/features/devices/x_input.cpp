#include "features/devices/x_input.h"

#include <xcb/xtest.h>

#include <cstdlib>
#include <stdexcept>

namespace handway::test {

XInput::XInput() : x_(xcb_connect(nullptr, nullptr)) {
  const xcb_query_extension_reply_t* test =
      xcb_connection_has_error(x_) == 0 ? xcb_get_extension_data(x_, &xcb_test_id) : nullptr;
  if (test == nullptr || test->present == 0) {
    xcb_disconnect(x_);
    throw std::runtime_error("no X server with XTEST");
  }
}

XInput::~XInput() { xcb_disconnect(x_); }

void XInput::type(const std::vector<xcb_keysym_t>& keysyms) {
  for (const xcb_keysym_t key : keysyms) {
    send(XCB_KEY_PRESS, code_of(key), {});
  }
  for (const xcb_keysym_t key : keysyms) {
    send(XCB_KEY_RELEASE, code_of(key), {});
  }
}

std::uint8_t XInput::code_of(xcb_keysym_t keysym) const {
  const xcb_setup_t* setup = xcb_get_setup(x_);
  const int count = setup->max_keycode - setup->min_keycode + 1;
  xcb_get_keyboard_mapping_reply_t* mapping = xcb_get_keyboard_mapping_reply(
      x_, xcb_get_keyboard_mapping(x_, setup->min_keycode, static_cast<std::uint8_t>(count)),
      nullptr);
  const int columns = mapping->keysyms_per_keycode;
  int found = 0;
  while (found < count * columns && xcb_get_keyboard_mapping_keysyms(mapping)[found] != keysym) {
    ++found;
  }
  std::free(mapping);
  if (found == count * columns) {
    throw std::runtime_error("the keyboard has no such key");
  }
  return static_cast<std::uint8_t>(setup->min_keycode + found / columns);
}

void XInput::take_keyboard() {
  const xcb_screen_t& screen = *xcb_setup_roots_iterator(xcb_get_setup(x_)).data;
  const xcb_window_t window = xcb_generate_id(x_);
  xcb_create_window(x_, XCB_COPY_FROM_PARENT, window, screen.root, 0, 0, 1, 1, 0,
                    XCB_WINDOW_CLASS_INPUT_OUTPUT, screen.root_visual, 0, nullptr);
  xcb_map_window(x_, window);
  xcb_set_input_focus(x_, XCB_INPUT_FOCUS_PARENT, window, XCB_CURRENT_TIME);
  std::free(xcb_get_input_focus_reply(x_, xcb_get_input_focus(x_), nullptr));  // it is done
}

void XInput::click(const QPoint& place) {
  constexpr std::uint8_t kLeftButton = 1;
  send(XCB_MOTION_NOTIFY, 0, place);
  send(XCB_BUTTON_PRESS, kLeftButton, {});
  send(XCB_BUTTON_RELEASE, kLeftButton, {});
}

void XInput::send(std::uint8_t type, std::uint8_t detail, const QPoint& place) {
  const xcb_window_t root = xcb_setup_roots_iterator(xcb_get_setup(x_)).data->root;
  xcb_test_fake_input(x_, type, detail, XCB_CURRENT_TIME, root,
                      static_cast<std::int16_t>(place.x()), static_cast<std::int16_t>(place.y()),
                      0);
  xcb_flush(x_);
}

}  // namespace handway::test
