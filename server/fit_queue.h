#pragma once
// Renders whose display is not fitted yet wait here, and not before the thread that draws: a hard display
// takes minutes. Where only the eye has moved, the pieces are refitted instead, and certified at every pixel
// when nothing else waits. Each job that is submitted gets exactly one outcome, here or from the render
// queue.

#include "calibration/pieces/piece_fit.h"
#include "renderer/recently_used.h"
#include "server/render_queue.h"

#include <glm/vec3.hpp>

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

namespace curvewall {

// As fitPieces. Called on several threads at once.
using FitFunction = std::function<FittedPieces(const Display&, double tolerancePx, const std::stop_token&)>;

// As refitPieces. Called on several threads at once.
using RefitFunction = std::function<FittedPieces(const FittedPieces& before, const Display& now,
                                                 double tolerancePx, int every, const std::stop_token&)>;

class FitQueue {
public:
    // Keeps a reference to the queue that fitted jobs go on to. The settings are those of that queue: the
    // deadline counts from the submission here.
    FitQueue(RenderQueue::Settings settings, RenderQueue& renders, FitFunction fit, RefitFunction refit);
    ~FitQueue();  // as stop(), then waits for the fits in hand, which end soon
    FitQueue(const FitQueue&) = delete;
    FitQueue& operator=(const FitQueue&) = delete;

    // The job's wall must have its display. Jobs that need no pieces, or whose pieces are kept, go on at
    // once; those that need the same pieces share one fit.
    void submit(RenderQueue::Job job);

    // Refuses the jobs that are late or abandoned and stops the fits that no job waits for any more. To be
    // called now and then.
    void sweep();

    // Stops all fits, and refuses what waits and what is still to come.
    void stop();

private:
    // What pieces of another eye may be refitted to.
    struct Screen {
        WallPtr wall;
        const Display* display;  // of that wall
        double tolerancePx;
        bool operator==(const Screen&) const = default;
    };

    struct Key {
        Screen screen;
        std::optional<glm::dvec3> eyeM;
        bool operator==(const Key&) const = default;
    };

    struct Fitted {
        WallPtr wall;  // seen from the key's eye
        std::shared_ptr<const FittedPieces> pieces;
    };

    struct Fit {
        Key key;
        std::vector<RenderQueue::Job> jobs{};
        std::shared_ptr<const Fitted> sparse{};  // whose certificate it completes; then it has no jobs
        std::stop_source stop{};
        bool begun = false;
    };

    static Key keyOf(const RenderRequest& request);
    std::shared_ptr<const Fitted> fittedFor(const Fit& fit, const Fitted* before) const;
    void goOn(RenderQueue::Job job, const Fitted& fitted);
    void work();
    std::shared_ptr<Fit> takeNext();

    // With the mutex held.
    size_t jobCount() const;
    std::shared_ptr<Fit> next() const;  // null where none waits
    bool isBeingCompleted(const Screen& screen) const;
    void keep(const Fit& fit, const std::shared_ptr<const Fitted>& fitted);
    std::chrono::seconds retryAfter() const;

    const RenderQueue::Settings settings_;
    RenderQueue& renders_;
    const FitFunction fit_;
    const RefitFunction refit_;

    std::mutex mutex_;  // guards what follows, but not threads_
    std::condition_variable changed_;
    std::vector<std::shared_ptr<Fit>> fits_;         // that a job waits for, in the order in which they came
    std::vector<std::shared_ptr<Fit>> completions_;  // at most one of a screen that has not begun
    RecentlyUsed<Key, const Fitted> fitted_;
    RecentlyUsed<Screen, const Fitted> latest_;  // which refits start from
    bool stopping_ = false;

    std::vector<std::jthread> threads_;  // last, so that they start when all else is there
};

}  // namespace curvewall
