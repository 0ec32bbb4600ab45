#include "handway_test/real_time.h"

#include <gmock/gmock.h>

int main(int argc, char** argv) {
  return handway::test::run_in_real_time(argc, argv, [](int count, char** arguments) {
    ::testing::InitGoogleMock(&count, arguments);
    return RUN_ALL_TESTS();
  });
}
