#include "calibration/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace curvewall {

void parallelRanges(int count, const std::function<void(int, int)>& work, int threads) {
    if (threads <= 0) threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    const int chunk = std::max(1, count / (threads * 8));
    std::atomic<int> next{0};
    std::exception_ptr failure;
    std::mutex failureMutex;  // guards failure
    const auto run = [&] {
        try {
            for (int begin; (begin = next.fetch_add(chunk)) < count;)
                work(begin, std::min(count, begin + chunk));
        } catch (...) {
            const std::scoped_lock lock(failureMutex);
            failure = std::current_exception();
            next = count;
        }
    };
    {
        std::vector<std::jthread> helpers;
        for (int i = 1; i < threads; ++i) helpers.emplace_back(run);
        run();
    }
    if (failure) std::rethrow_exception(failure);
}

}  // namespace curvewall
