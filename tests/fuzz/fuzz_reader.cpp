// A libFuzzer target; CURVEWALL_FUZZ_FILE is the name of the file that its inputs are the content of.

#include "tests/fuzz/read_and_look.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    curvewall::test::readAndLook(CURVEWALL_FUZZ_FILE, {reinterpret_cast<const char*>(data), size});
    return 0;
}
