#include "server/render_queue.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace curvewall {
namespace {

constexpr size_t kRendersRemembered = 15;

}  // namespace

RenderQueue::RenderQueue(Settings settings, MakeRenderFunction makeRender)
    : settings_(std::move(settings)), makeRender_(std::move(makeRender)), thread_([this] { work(); }) {}

RenderQueue::~RenderQueue() {
    stop();
    thread_.join();
}

void RenderQueue::submit(Job job) {
    if (job.arrived == Clock::time_point{}) job.arrived = settings_.now();
    sweep();
    std::unique_lock lock(mutex_);
    if (!stopping_ && waiting_.size() < settings_.length) {
        waiting_.push_back(std::move(job));
        changed_.notify_one();
        return;
    }
    const Refusal refusal{stopping_ ? Refusal::Reason::stopping : Refusal::Reason::full, retryAfter()};
    lock.unlock();
    job.done(refusal);
}

void RenderQueue::sweep() {
    std::vector<std::pair<Job, Refusal>> refused;
    {
        std::scoped_lock lock(mutex_);
        for (auto waiting = waiting_.begin(); waiting != waiting_.end();) {
            if (const auto reason = reasonToRefuse(*waiting, settings_)) {
                refused.emplace_back(std::move(*waiting), Refusal{*reason, retryAfter()});
                waiting = waiting_.erase(waiting);
            } else {
                ++waiting;
            }
        }
    }
    for (const auto& [job, refusal] : refused) job.done(refusal);
}

void RenderQueue::stop() {
    std::deque<Job> refused;
    {
        std::scoped_lock lock(mutex_);
        stopping_ = true;
        refused.swap(waiting_);
    }
    changed_.notify_one();
    for (const Job& job : refused) job.done(Refusal{Refusal::Reason::stopping, std::chrono::seconds(1)});
}

void RenderQueue::work() {
    RenderFunction render;
    while (const std::optional<Job> next = takeNext()) {
        RenderOutcome outcome = outcomeOf(*next, render);
        {
            std::scoped_lock lock(mutex_);
            rendering_ = false;
        }
        next->done(std::move(outcome));
    }
}

std::optional<RenderQueue::Job> RenderQueue::takeNext() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
    if (waiting_.empty()) return std::nullopt;
    Job next = std::move(waiting_.front());
    waiting_.pop_front();
    rendering_ = true;
    return next;
}

RenderOutcome RenderQueue::outcomeOf(const Job& job, RenderFunction& render) {
    if (const auto reason = reasonToRefuse(job, settings_)) {
        std::scoped_lock lock(mutex_);
        return Refusal{*reason, retryAfter()};
    }
    const Clock::time_point begun = settings_.now();
    try {
        if (!render) render = makeRender_();
        RenderedImage image = render(job.call);
        image.queueTime = begun - job.arrived;
        std::scoped_lock lock(mutex_);
        recentRenders_.push_back(settings_.now() - begun);
        if (recentRenders_.size() > kRendersRemembered) recentRenders_.pop_front();
        return image;
    } catch (...) {
        return std::current_exception();
    }
}

// The time until what is here now is done, at the median pace of the last renders.
std::chrono::seconds RenderQueue::retryAfter() const {
    const std::chrono::seconds atLeast(1);
    if (recentRenders_.empty()) return atLeast;
    std::vector<Clock::duration> sorted(recentRenders_.begin(), recentRenders_.end());
    const auto median = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), median, sorted.end());
    const auto jobs = static_cast<Clock::rep>(waiting_.size() + (rendering_ ? 1 : 0));
    return std::max(atLeast, std::chrono::ceil<std::chrono::seconds>(*median * jobs));
}

std::optional<Refusal::Reason> reasonToRefuse(const RenderQueue::Job& job,
                                              const RenderQueue::Settings& settings) {
    if (job.abandoned.stop_requested()) return Refusal::Reason::abandoned;
    if (settings.now() - job.arrived > settings.deadline) return Refusal::Reason::late;
    return std::nullopt;
}

}  // namespace curvewall
