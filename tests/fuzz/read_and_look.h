#pragma once
// What every fuzzed input goes through: the reader that its name stands for, and a look through what comes
// out.

#include <string>
#include <string_view>

namespace curvewall::test {

// Reads `bytes` as the content of a file called `name` and follows rays of what was read. Complaints about
// the input are what a reader is for; anything else that is thrown, and every ray that is not finite, ends
// the program.
void readAndLook(const std::string& name, std::string_view bytes);

}  // namespace curvewall::test
