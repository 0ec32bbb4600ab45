#include "model/devices/stop_key_listener.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>
#include <xcb/xcb.h>
#include <xcb/xinput.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <set>
#include <thread>
#include <utility>

namespace handway::gui {
namespace {

// Keysyms of X.Org.
constexpr xcb_keysym_t kPause = 0xff13;
constexpr xcb_keysym_t kBreak = 0xff6b;
constexpr xcb_keysym_t kF12 = 0xffc9;
constexpr xcb_keysym_t kSpace = 0x0020;
constexpr xcb_keysym_t kControlLeft = 0xffe3;
constexpr xcb_keysym_t kControlRight = 0xffe4;

struct Free {
  void operator()(void* reply) const { std::free(reply); }
};
template <typename Reply>
using Owned = std::unique_ptr<Reply, Free>;

struct Disconnect {
  void operator()(xcb_connection_t* connection) const { xcb_disconnect(connection); }
};
using Connection = std::unique_ptr<xcb_connection_t, Disconnect>;

// Returns whether raw events reach all clients, also while another client has grabbed the keyboard,
// as since version 2.1.
bool has_raw_events(xcb_connection_t* x) {
  const xcb_query_extension_reply_t* extension = xcb_get_extension_data(x, &xcb_input_id);
  if (extension == nullptr || extension->present == 0) {
    return false;
  }
  const Owned<xcb_input_xi_query_version_reply_t> version(
      xcb_input_xi_query_version_reply(x, xcb_input_xi_query_version(x, 2, 2), nullptr));
  constexpr std::pair<std::uint16_t, std::uint16_t> kLeast(2, 1);
  return version && std::pair(version->major_version, version->minor_version) >= kLeast;
}

void select_raw_keys(xcb_connection_t* x) {
  struct {
    xcb_input_event_mask_t head;
    std::uint32_t mask;
  } const wanted{{XCB_INPUT_DEVICE_ALL_MASTER, 1},
                 XCB_INPUT_XI_EVENT_MASK_RAW_KEY_PRESS | XCB_INPUT_XI_EVENT_MASK_RAW_KEY_RELEASE};
  const xcb_window_t root = xcb_setup_roots_iterator(xcb_get_setup(x)).data->root;
  xcb_input_xi_select_events(x, root, 1, &wanted.head);
  xcb_flush(x);
}

// The keysyms of each key of the keyboard, in all its columns.
std::multimap<xcb_keycode_t, xcb_keysym_t> read_keyboard(xcb_connection_t* x) {
  const xcb_setup_t* setup = xcb_get_setup(x);
  const int count = setup->max_keycode - setup->min_keycode + 1;
  const Owned<xcb_get_keyboard_mapping_reply_t> mapping(xcb_get_keyboard_mapping_reply(
      x, xcb_get_keyboard_mapping(x, setup->min_keycode, static_cast<std::uint8_t>(count)),
      nullptr));
  std::multimap<xcb_keycode_t, xcb_keysym_t> keyboard;
  if (mapping) {
    const xcb_keysym_t* symbols = xcb_get_keyboard_mapping_keysyms(mapping.get());
    for (int i = 0; i < count * mapping->keysyms_per_keycode; ++i) {
      keyboard.emplace(setup->min_keycode + i / mapping->keysyms_per_keycode, symbols[i]);
    }
  }
  return keyboard;
}

// A program's windows have the number of its connection in common.
bool has_keyboard(xcb_connection_t* x, xcb_window_t window) {
  const std::uint32_t connection = ~xcb_get_setup(x)->resource_id_mask;
  const Owned<xcb_get_input_focus_reply_t> focus(
      xcb_get_input_focus_reply(x, xcb_get_input_focus(x), nullptr));
  return focus && (focus->focus & connection) == (window & connection);
}

}  // namespace

class StopKeyListener::Thread {
 public:
  Thread(Connection x, xcb_window_t window, std::function<void()> stop)
      : x_(std::move(x)),
        window_(window),
        stop_(std::move(stop)),
        opcode_(xcb_get_extension_data(x_.get(), &xcb_input_id)->major_opcode),
        keyboard_(read_keyboard(x_.get())),
        end_(::eventfd(0, EFD_CLOEXEC)),
        thread_([this] { listen(); }) {}
  ~Thread() {
    ::eventfd_write(end_, 1);
    thread_.join();
    ::close(end_);
  }
  Thread(const Thread&) = delete;
  Thread& operator=(const Thread&) = delete;

 private:
  void listen() {
    std::array<pollfd, 2> sources{
        {{xcb_get_file_descriptor(x_.get()), POLLIN, 0}, {end_, POLLIN, 0}}};
    while (sources[1].revents == 0) {
      while (const Owned<xcb_generic_event_t> event{xcb_poll_for_event(x_.get())}) {
        take(*event);
      }
      if (xcb_connection_has_error(x_.get()) != 0) {
        stop_();
        return;
      }
      ::poll(sources.data(), sources.size(), -1);
    }
  }

  void take(const xcb_generic_event_t& event) {
    constexpr unsigned kSentByProgram = 0x80;
    const unsigned type = event.response_type & ~kSentByProgram;
    if (type == XCB_MAPPING_NOTIFY) {
      keyboard_ = read_keyboard(x_.get());
    } else if (type == XCB_GE_GENERIC) {
      const auto& generic = reinterpret_cast<const xcb_ge_generic_event_t&>(event);
      if (generic.extension != opcode_) {
        return;
      }
      const auto& key = reinterpret_cast<const xcb_input_raw_key_press_event_t&>(event);
      const auto code = static_cast<xcb_keycode_t>(key.detail);
      if (generic.event_type == XCB_INPUT_RAW_KEY_PRESS) {
        take_press(code);
      } else if (generic.event_type == XCB_INPUT_RAW_KEY_RELEASE) {
        controls_.erase(code);
      }
    }
  }

  // Tracks from their own events which Control keys are down: when the other key is processed, they
  // may be up again.
  void take_press(xcb_keycode_t code) {
    if (has(code, kControlLeft) || has(code, kControlRight)) {
      controls_.insert(code);
    } else if (is_stop_key(code)) {
      stop_();
    }
  }

  [[nodiscard]] bool has(xcb_keycode_t code, xcb_keysym_t keysym) const {
    const auto [begin, end] = keyboard_.equal_range(code);
    return std::any_of(begin, end, [keysym](const auto& key) { return key.second == keysym; });
  }

  [[nodiscard]] bool is_stop_key(xcb_keycode_t code) const {
    return has(code, kPause) || has(code, kBreak) ||
           ((has(code, kF12) || (has(code, kSpace) && !controls_.empty())) &&
            has_keyboard(x_.get(), window_));
  }

  Connection x_;
  xcb_window_t window_;
  std::function<void()> stop_;
  std::uint8_t opcode_;
  std::multimap<xcb_keycode_t, xcb_keysym_t> keyboard_;
  std::set<xcb_keycode_t> controls_;  ///< Control keys that are down.
  int end_;
  std::thread thread_;
};

StopKeyListener::StopKeyListener(std::uint32_t window, std::function<void()> stop) {
  Connection x(xcb_connect(nullptr, nullptr));
  if (xcb_connection_has_error(x.get()) == 0 && has_raw_events(x.get())) {
    select_raw_keys(x.get());
    thread_ = std::make_unique<Thread>(std::move(x), window, std::move(stop));
  }
}

StopKeyListener::~StopKeyListener() = default;

}  // namespace handway::gui
