#pragma once
// gnuplot as a child process.

#include <string>
#include <string_view>

namespace curvewall {

// What gnuplot writes to its standard output when it is given `script`, whatever the user's own settings of
// gnuplot. Throws std::runtime_error where there is no gnuplot or it rejects the script.
std::string gnuplotOutput(const std::string& script);

// Text that gnuplot takes literally, whatever is in it; control characters become spaces.
std::string gnuplotQuoted(std::string_view text);

}  // namespace curvewall
