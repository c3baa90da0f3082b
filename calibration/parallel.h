#pragma once
// Work on all cores.

#include <functional>

namespace curvewall {

// Calls work(begin, end) for disjoint ranges that cover [0, count), from several threads, and waits.
// An exception in any of them is thrown again here.
void parallelRanges(int count, const std::function<void(int begin, int end)>& work);

}  // namespace curvewall
