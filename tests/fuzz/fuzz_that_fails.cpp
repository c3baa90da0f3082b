// A target with a finding, to see that scripts/fuzz tells of one.

#include <cstddef>
#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t*, size_t size) {
    if (size > 0) std::abort();
    return 0;
}
