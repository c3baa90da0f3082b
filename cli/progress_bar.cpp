#include "cli/progress_bar.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdio>
#include <unistd.h>

namespace curvewall {
namespace {

constexpr int kMarks = 20;
constexpr std::chrono::seconds kBetweenLines{10};

std::string durationText(double ms) {
    const long seconds = std::lround(ms / 1000);
    if (seconds < 90) return fmt::format("{} s", seconds);
    if (seconds < 90L * 60) return fmt::format("{} min", (seconds + 30) / 60);
    return fmt::format("{} h {} min", seconds / 3600, seconds % 3600 / 60);
}

}  // namespace

std::string progressLine(size_t done, size_t all, double leftMs, const std::string& doing, int marks) {
    const auto filled = all == 0 ? size_t{0} : done * static_cast<size_t>(marks) / all;
    return fmt::format("[{}{}] {}/{}, {} left: {}", std::string(filled, '#'),
                       std::string(static_cast<size_t>(marks) - filled, '.'), done, all, durationText(leftMs),
                       doing);
}

ProgressBar::ProgressBar() : isTerminal_(isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() {
    if (isTerminal_ && hasShown_) fmt::print(stderr, "\n");
}

void ProgressBar::show(size_t done, size_t all, double leftMs, const std::string& doing) {
    const auto now = std::chrono::steady_clock::now();
    if (!isTerminal_ && hasShown_ && now - shownAt_ < kBetweenLines) return;
    hasShown_ = true;
    shownAt_ = now;
    const std::string line = progressLine(done, all, leftMs, doing, kMarks);
    // Clears what a longer line has left.
    fmt::print(stderr, "{}{}{}", isTerminal_ ? "\r\x1b[K" : "", line, isTerminal_ ? "" : "\n");
    std::fflush(stderr);
}

}  // namespace curvewall
