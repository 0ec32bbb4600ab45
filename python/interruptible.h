#pragma once

#include <functional>
#include <stop_token>

namespace handway::python {

/// Runs `work` in a thread of its own without the interpreter's lock, so that other Python
/// threads go on, and looks for signals meanwhile: Ctrl-C stops the work and raises
/// KeyboardInterrupt. Exceptions of `work` are passed on.
/// @pre the caller holds the lock.
void run_interruptible(const std::function<void(std::stop_token)>& work);

}  // namespace handway::python
