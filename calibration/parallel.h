#pragma once
// Work on all cores.

#include <functional>

namespace curvewall {

// Calls work(begin, end) for disjoint ranges that cover [0, count), from `threads` threads (0: one a core),
// and waits.
// An exception in any of them is thrown again here.
void parallelRanges(int count, const std::function<void(int begin, int end)>& work, int threads = 0);

}  // namespace curvewall
