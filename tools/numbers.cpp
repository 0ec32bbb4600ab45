#include "numbers.h"

namespace handway::tools {}  // namespace handway::tools
