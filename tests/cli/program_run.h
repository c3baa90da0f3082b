#pragma once
// The program as a shell runs it.

#include <sys/wait.h>

#include <cstdio>
#include <string>

namespace curvewall::test {

struct Outcome {
    int exitCode = -1;
    std::string output;  // stdout and stderr
};

inline Outcome runProgram(const std::string& arguments, const std::string& environment = "") {
    const std::string command = environment + " '" CURVEWALL_EXECUTABLE "' " + arguments + " 2>&1";
    FILE* pipe = popen(command.c_str(), "r");
    Outcome outcome;
    char buffer[4096];
    while (const size_t bytes = fread(buffer, 1, sizeof buffer, pipe)) outcome.output.append(buffer, bytes);
    const int status = pclose(pipe);
    outcome.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
}

}  // namespace curvewall::test
