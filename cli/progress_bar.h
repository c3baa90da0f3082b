#pragma once
// How far a long command is, on stderr.

#include <chrono>
#include <cstddef>
#include <string>

namespace curvewall {

// On a terminal one line that is written over again; elsewhere a line now and then, for logs.
class ProgressBar {
public:
    ProgressBar();
    ~ProgressBar();  // ends the line
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    // `leftMs` is how much longer it may take.
    void show(size_t done, size_t all, double leftMs, const std::string& doing);

private:
    bool isTerminal_;
    bool hasShown_ = false;
    std::chrono::steady_clock::time_point shownAt_{};
};

// "[#####.....] 12/40, 3 min left: tracing", with that many marks between the brackets.
std::string progressLine(size_t done, size_t all, double leftMs, const std::string& doing, int marks);

}  // namespace curvewall
