extern "C" __attribute__((visibility("default"))) int unrelated_function() { return 1; }
