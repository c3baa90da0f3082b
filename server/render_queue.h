#pragma once
// Renders wait here for the one thread that draws. Each job that is submitted gets exactly one outcome.

#include "server/render_call.h"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <variant>

namespace curvewall {

struct Refusal {
    enum class Reason {
        full,       // too many jobs wait already
        late,       // the deadline passed before the job began
        fitting,    // the deadline passed before the display was fitted
        abandoned,  // nobody waits for the answer any more
        stopping,   // the daemon is going away
    };
    Reason reason;
    std::chrono::seconds retryAfter;  // when it is worth asking again; at least one
};

using RenderOutcome = std::variant<RenderedImage, Refusal, std::exception_ptr>;

class RenderQueue {
public:
    using Clock = std::chrono::steady_clock;

    struct Settings {
        size_t length = 32;                          // jobs that wait, the one in hand not counted
        std::chrono::duration<double> deadline{30};  // from arrival to the beginning of the render
        std::function<Clock::time_point()> now = Clock::now;
    };

    struct Job {
        RenderCall call;
        std::stop_token abandoned;
        std::function<void(RenderOutcome)> done;  // on any thread; must not throw
        Clock::time_point arrived{};              // without one: when it is submitted
    };

    RenderQueue(Settings settings, MakeRenderFunction makeRender);
    ~RenderQueue();  // as stop(), then waits for the render in hand
    RenderQueue(const RenderQueue&) = delete;
    RenderQueue& operator=(const RenderQueue&) = delete;

    void submit(Job job);

    // Refuses the waiting jobs that are late or abandoned. To be called now and then, because the render
    // thread looks at a job only when it has finished the one before.
    void sweep();

    // Refuses what waits and what is still to come; the render in hand is finished.
    void stop();

private:
    void work();
    std::optional<Job> takeNext();
    RenderOutcome outcomeOf(const Job& job, RenderFunction& render);
    std::chrono::seconds retryAfter() const;  // with the mutex held

    const Settings settings_;
    const MakeRenderFunction makeRender_;

    mutable std::mutex mutex_;  // guards what follows, but not thread_
    std::condition_variable changed_;
    std::deque<Job> waiting_;
    bool rendering_ = false;
    bool stopping_ = false;
    std::deque<Clock::duration> recentRenders_;

    std::thread thread_;  // last, so that it starts when all else is there
};

// Abandoned or late, where it is one of them.
std::optional<Refusal::Reason> reasonToRefuse(const RenderQueue::Job& job,
                                              const RenderQueue::Settings& settings);

}  // namespace curvewall
