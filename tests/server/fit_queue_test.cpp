#include "server/fit_queue.h"

#include "calibration/errors.h"
#include "tests/server/small_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace curvewall {
namespace {

using std::chrono::seconds;
using Reason = Refusal::Reason;

// Fits that are told apart by their tolerance and renders that say which pieces they got, by a clock that
// only the test moves.
class FitQueueTest : public ::testing::Test {
protected:
    static constexpr double kQuickPx = 1, kSlowPx = 2, kImpossiblePx = 3, kCompletedPx = 4;

    FitQueueTest() {
        settings_.length = 4;
        settings_.deadline = seconds(10);
        settings_.now = [this] { return RenderQueue::Clock::time_point(seconds(nowS_.load())); };
        renders_.emplace(settings_, []() -> RenderFunction {
            return [](const RenderCall& call) {
                RenderedImage image;
                const auto& pieces = call.request.pieces;
                image.bytes = pieces ? "pieces of " + std::to_string(pieces->certificate.maxPx) : "no pieces";
                return image;
            };
        });
        fits_.emplace(
            settings_, *renders_,
            [this](const Display& display, double tolerancePx, const std::stop_token& stop) {
                return fit(display, tolerancePx, stop);
            },
            [this](const FittedPieces& before, const Display&, double, int every,
                   const std::stop_token& stop) { return refit(before, every, stop); });
    }

    // The sparse ones at once; those over every pixel wait for openGate().
    FittedPieces refit(const FittedPieces& before, int every, const std::stop_token& stop) {
        std::unique_lock lock(mutex_);
        FittedPieces pieces = before;
        pieces.certificate.every = every;
        ++refitCount_;
        changed_.notify_all();
        if (every > 1) return pieces;
        ++completing_;
        changed_.wait(lock, stop, [this] { return gateOpen_; });
        if (stop.stop_requested()) throw FitStopped();
        pieces.certificate.maxPx = kCompletedPx;
        ++completedCount_;
        changed_.notify_all();
        return pieces;
    }

    // A slow one lasts until openGate() or until it is stopped.
    FittedPieces fit(const Display&, double tolerancePx, const std::stop_token& stop) {
        if (tolerancePx == kImpossiblePx) throw UsageError("too many pieces");
        std::unique_lock lock(mutex_);
        ++fitCount_;
        changed_.notify_all();
        if (tolerancePx == kSlowPx) {
            changed_.wait(lock, stop, [this] { return gateOpen_; });
            if (stop.stop_requested()) {
                ++stoppedCount_;
                changed_.notify_all();
                throw FitStopped();
            }
        }
        FittedPieces pieces;
        pieces.certificate.maxPx = tolerancePx;
        return pieces;
    }

    std::future<RenderOutcome> submit(double tolerancePx, Method method = Method::piecewise,
                                      std::stop_token abandoned = {}, std::optional<glm::dvec3> eyeM = {}) {
        auto promise = std::make_shared<std::promise<RenderOutcome>>();
        RenderQueue::Job job;
        job.call.request.wall = library_.walls.at("small");
        job.call.request.method = method;
        job.call.request.tolerancePx = tolerancePx;
        job.call.request.eyeM = eyeM;
        job.abandoned = std::move(abandoned);
        job.done = [promise](RenderOutcome outcome) { promise->set_value(std::move(outcome)); };
        std::future<RenderOutcome> outcome = promise->get_future();
        fits_->submit(std::move(job));
        return outcome;
    }

    std::future<RenderOutcome> submitFrom(double eyeXM) {
        return submit(kQuickPx, Method::piecewise, {}, glm::dvec3(eyeXM, 0, 0));
    }

    void waitUntil(const std::atomic<int>& counter, int count) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return counter >= count; });
    }

    void openGate() {
        std::scoped_lock lock(mutex_);
        gateOpen_ = true;
        changed_.notify_all();
    }

    static std::string imageOf(std::future<RenderOutcome> outcome) {
        return std::get<RenderedImage>(outcome.get()).bytes;
    }
    static Refusal refusalOf(std::future<RenderOutcome> outcome) { return std::get<Refusal>(outcome.get()); }
    static bool isAnswered(const std::future<RenderOutcome>& outcome) {
        return outcome.wait_for(seconds(0)) == std::future_status::ready;
    }

    Library library_ = smallLibrary();
    std::atomic<int> nowS_ = 1000;
    std::mutex mutex_;  // guards the rest but the queues
    std::condition_variable_any changed_;
    bool gateOpen_ = false;
    std::atomic<int> fitCount_ = 0, stoppedCount_ = 0;
    std::atomic<int> refitCount_ = 0, completing_ = 0, completedCount_ = 0;
    RenderQueue::Settings settings_;
    std::optional<RenderQueue> renders_;
    std::optional<FitQueue> fits_;
};

TEST_F(FitQueueTest, RendersGoOnWithTheirPieces) {
    EXPECT_EQ(imageOf(submit(kQuickPx)), "pieces of " + std::to_string(kQuickPx));
    EXPECT_EQ(imageOf(submit(kQuickPx, Method::imageBased)), "no pieces");
    EXPECT_EQ(imageOf(submit(kQuickPx, Method::reference)), "no pieces");
}

TEST_F(FitQueueTest, RendersDoNotWaitForTheFitsOfOthers) {
    auto slow = submit(kSlowPx);
    waitUntil(fitCount_, 1);
    EXPECT_NO_THROW(imageOf(submit(kQuickPx)));
    EXPECT_NO_THROW(imageOf(submit(kSlowPx, Method::reference)));
    EXPECT_FALSE(isAnswered(slow));
}

TEST_F(FitQueueTest, TheSamePiecesAreFittedOnce) {
    auto first = submit(kSlowPx);
    auto second = submit(kSlowPx);
    waitUntil(fitCount_, 1);
    auto third = submit(kSlowPx);
    openGate();
    for (auto* outcome : {&first, &second, &third}) EXPECT_NO_THROW(imageOf(std::move(*outcome)));
    EXPECT_NO_THROW(imageOf(submit(kSlowPx)));
    EXPECT_EQ(fitCount_, 1);
    EXPECT_NO_THROW(imageOf(submit(kQuickPx)));
    EXPECT_EQ(fitCount_, 2);
}

TEST_F(FitQueueTest, AFitThatFailsSaysWhyToAllThatWait) {
    for (int i = 0; i < 2; ++i)
        EXPECT_THROW(std::rethrow_exception(std::get<std::exception_ptr>(submit(kImpossiblePx).get())),
                     UsageError);
}

TEST_F(FitQueueTest, AFitIsStoppedWhenTheLastThatWantsItIsLate) {
    auto first = submit(kSlowPx);
    waitUntil(fitCount_, 1);
    nowS_ += 6;
    auto second = submit(kSlowPx);
    nowS_ += 6;
    fits_->sweep();
    const Refusal refusal = refusalOf(std::move(first));
    EXPECT_EQ(refusal.reason, Reason::fitting);
    EXPECT_EQ(refusal.retryAfter, seconds(10));
    EXPECT_FALSE(isAnswered(second));
    EXPECT_EQ(stoppedCount_, 0);
    nowS_ += 6;
    fits_->sweep();
    EXPECT_EQ(refusalOf(std::move(second)).reason, Reason::fitting);
    waitUntil(stoppedCount_, 1);
    openGate();
    EXPECT_NO_THROW(imageOf(submit(kSlowPx)));  // begins anew
}

TEST_F(FitQueueTest, AFitThatNobodyWaitsForIsStopped) {
    std::stop_source client;
    auto outcome = submit(kSlowPx, Method::piecewise, client.get_token());
    waitUntil(fitCount_, 1);
    client.request_stop();
    fits_->sweep();
    EXPECT_EQ(refusalOf(std::move(outcome)).reason, Reason::abandoned);
    waitUntil(stoppedCount_, 1);
}

TEST_F(FitQueueTest, TooManyThatWaitAreRefused) {
    std::vector<std::future<RenderOutcome>> waiting;
    for (int i = 0; i < 4; ++i) waiting.push_back(submit(kSlowPx));
    EXPECT_EQ(refusalOf(submit(kSlowPx)).reason, Reason::full);
    EXPECT_NO_THROW(imageOf(submit(kSlowPx, Method::reference)));
    openGate();
    for (auto& outcome : waiting) EXPECT_NO_THROW(imageOf(std::move(outcome)));
}

TEST_F(FitQueueTest, TheDeadlineCountsFromTheArrival) {
    auto slow = submit(kSlowPx);
    waitUntil(fitCount_, 1);
    nowS_ += 11;  // and nobody sweeps before the fit ends
    openGate();
    EXPECT_EQ(refusalOf(std::move(slow)).reason, Reason::late);
}

TEST_F(FitQueueTest, StoppingStopsFitsAndRefusesAll) {
    auto slow = submit(kSlowPx);
    waitUntil(fitCount_, 1);
    fits_->stop();
    EXPECT_EQ(refusalOf(std::move(slow)).reason, Reason::stopping);
    EXPECT_EQ(refusalOf(submit(kQuickPx)).reason, Reason::stopping);
    fits_.reset();
    EXPECT_EQ(stoppedCount_, 1);
}

TEST_F(FitQueueTest, AnEyeThatMovesIsFollowedByRefits) {
    EXPECT_NO_THROW(imageOf(submitFrom(0)));
    EXPECT_EQ(fitCount_, 1);
    EXPECT_EQ(refitCount_, 0);
    EXPECT_EQ(imageOf(submitFrom(0.01)), "pieces of " + std::to_string(kQuickPx));
    EXPECT_EQ(imageOf(submitFrom(0.01)), "pieces of " + std::to_string(kQuickPx));
    EXPECT_EQ(fitCount_, 1);
    waitUntil(completing_, 1);
    EXPECT_EQ(refitCount_, 2);  // the sparse one and the one that completes it
}

TEST_F(FitQueueTest, WhatCompletesACertificateTakesItsPlace) {
    EXPECT_NO_THROW(imageOf(submitFrom(0)));
    EXPECT_NO_THROW(imageOf(submitFrom(0.01)));
    openGate();
    waitUntil(completedCount_, 1);
    const std::string completed = "pieces of " + std::to_string(kCompletedPx);
    while (imageOf(submitFrom(0.01)) != completed) std::this_thread::yield();  // it is kept a moment later
    EXPECT_EQ(imageOf(submitFrom(0.02)), completed);                           // and refits start from it
}

TEST_F(FitQueueTest, OnlyTheLatestEyesCertificateIsCompleted) {
    EXPECT_NO_THROW(imageOf(submitFrom(0)));
    EXPECT_NO_THROW(imageOf(submitFrom(0.01)));
    waitUntil(completing_, 1);
    for (const double xM : {0.02, 0.03, 0.04}) EXPECT_NO_THROW(imageOf(submitFrom(xM)));
    EXPECT_EQ(completing_, 1);  // one of a display at a time
    openGate();
    waitUntil(completedCount_, 2);
    EXPECT_NO_THROW(imageOf(submit(kSlowPx)));  // the queue still works
    fits_.reset();
    EXPECT_EQ(completedCount_, 2);
}

TEST_F(FitQueueTest, StoppingStopsWhatCompletesCertificates) {
    EXPECT_NO_THROW(imageOf(submitFrom(0)));
    EXPECT_NO_THROW(imageOf(submitFrom(0.01)));
    waitUntil(completing_, 1);
    fits_.reset();
    EXPECT_EQ(completedCount_, 0);
}

TEST_F(FitQueueTest, EveryJobOfManyThreadsGetsOneOutcome) {
    std::atomic<int> outcomes = 0;
    constexpr int kThreads = 8;
    constexpr int kJobs = 200;
    {
        std::vector<std::jthread> threads;
        for (int t = 0; t < kThreads; ++t)
            threads.emplace_back([&, t] {
                for (int i = 0; i < kJobs; ++i) {
                    RenderQueue::Job job;
                    job.call.request.wall = library_.walls.at("small");
                    job.call.request.tolerancePx = 10 + (i * kThreads + t) % 50;
                    job.done = [&outcomes](const RenderOutcome&) { ++outcomes; };
                    fits_->submit(std::move(job));
                    if (i % 8 == 0) fits_->sweep();
                }
            });
    }
    fits_.reset();
    renders_.reset();
    EXPECT_EQ(outcomes, kThreads * kJobs);
}

}  // namespace
}  // namespace curvewall
