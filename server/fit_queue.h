#pragma once
// Renders whose display is not fitted yet wait here, and not before the thread that draws: a hard display
// takes minutes. Each job that is submitted gets exactly one outcome, here or from the render queue.

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

class FitQueue {
public:
    // Keeps a reference to the queue that fitted jobs go on to. The settings are those of that queue: the
    // deadline counts from the submission here.
    FitQueue(RenderQueue::Settings settings, RenderQueue& renders, FitFunction fit);
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
    struct Key {
        WallPtr wall;
        const Display* display;  // of that wall
        std::optional<glm::dvec3> eyeM;
        double tolerancePx;
        bool operator==(const Key&) const = default;
    };

    struct Fitted {
        WallPtr wall;  // seen from the key's eye
        std::shared_ptr<const FittedPieces> pieces;
    };

    struct Fit {
        Key key;
        std::vector<RenderQueue::Job> jobs{};
        std::stop_source stop{};
        bool begun = false;
    };

    static Key keyOf(const RenderRequest& request);
    std::shared_ptr<const Fitted> fittedFor(const Fit& fit) const;
    void goOn(RenderQueue::Job job, const Fitted& fitted);
    void work();
    std::shared_ptr<Fit> takeNext();
    size_t jobCount() const;            // with the mutex held
    std::shared_ptr<Fit> next() const;  // with the mutex held; null where none waits
    std::chrono::seconds retryAfter() const;

    const RenderQueue::Settings settings_;
    RenderQueue& renders_;
    const FitFunction fit_;

    std::mutex mutex_;  // guards what follows, but not threads_
    std::condition_variable changed_;
    std::vector<std::shared_ptr<Fit>> fits_;  // that a job waits for, in the order in which they came
    RecentlyUsed<Key, const Fitted> fitted_;
    bool stopping_ = false;

    std::vector<std::jthread> threads_;  // last, so that they start when all else is there
};

}  // namespace curvewall
