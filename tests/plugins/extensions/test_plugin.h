#pragma once

#include "handway/planning/extensions/plugin.h"

/// Defines the entry point that hands over `object`, a Plugin with static life.
#define HANDWAY_TEST_PLUGIN(object)                                                  \
  extern "C" __attribute__((visibility("default"))) const handway::planning::Plugin* \
  handway_plugin() {                                                                 \
    return &(object);                                                                \
  }                                                                                  \
  static_assert(true)
