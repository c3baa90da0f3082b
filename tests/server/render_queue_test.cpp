#include "server/render_queue.h"

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
using ::testing::ElementsAre;

// A queue whose renders begin and end when the test says so, by a clock that only the test moves. The scene's
// name tells jobs apart.
class RenderQueueTest : public ::testing::Test {
protected:
    void makeQueue(size_t length) {
        RenderQueue::Settings settings;
        settings.length = length;
        settings.deadline = seconds(10);
        settings.now = [this] { return RenderQueue::Clock::time_point(seconds(nowS_.load())); };
        queue_.emplace(settings, [this]() -> RenderFunction {
            renderThread_ = std::this_thread::get_id();
            return [this](const RenderCall& call) { return render(call); };
        });
    }

    ~RenderQueueTest() override {
        openGate();
        queue_.reset();
    }

    // Blocks for the job named "gate" until openGate().
    RenderedImage render(const RenderCall& call) {
        {
            std::scoped_lock lock(mutex_);
            rendered_.push_back(call.scene);
        }
        EXPECT_EQ(std::this_thread::get_id(), renderThread_);
        if (call.scene == "gate") {
            gateReached_.set_value();
            std::unique_lock lock(mutex_);
            gateOpened_.wait(lock, [this] { return gateOpen_; });
        }
        if (call.scene == "throw") throw std::runtime_error("broken");
        nowS_ += renderS_;
        RenderedImage image;
        image.bytes = call.scene;
        return image;
    }

    std::future<RenderOutcome> submit(const std::string& name, std::stop_token abandoned = {}) {
        auto promise = std::make_shared<std::promise<RenderOutcome>>();
        RenderQueue::Job job;
        job.call.scene = name;
        job.abandoned = std::move(abandoned);
        job.done = [promise](RenderOutcome outcome) { promise->set_value(std::move(outcome)); };
        std::future<RenderOutcome> outcome = promise->get_future();
        queue_->submit(std::move(job));
        return outcome;
    }

    std::future<RenderOutcome> occupy() {
        auto outcome = submit("gate");
        gateReached_.get_future().wait();
        return outcome;
    }

    void openGate() {
        std::scoped_lock lock(mutex_);
        gateOpen_ = true;
        gateOpened_.notify_all();
    }

    static std::string imageOf(std::future<RenderOutcome>& outcome) {
        return std::get<RenderedImage>(outcome.get()).bytes;
    }

    static bool isAnswered(const std::future<RenderOutcome>& outcome) {
        return outcome.wait_for(seconds(0)) == std::future_status::ready;
    }

    std::atomic<int> nowS_ = 1000;
    std::atomic<int> renderS_ = 0;  // how far a render moves the clock
    std::thread::id renderThread_;
    std::mutex mutex_;
    std::condition_variable gateOpened_;
    bool gateOpen_ = false;
    std::promise<void> gateReached_;
    std::vector<std::string> rendered_;
    std::optional<RenderQueue> queue_;
};

TEST_F(RenderQueueTest, RendersInOrderOnOneThreadOfItsOwn) {
    makeQueue(8);
    auto gate = occupy();
    auto a = submit("a");
    auto b = submit("b");
    openGate();
    EXPECT_EQ(imageOf(gate), "gate");
    EXPECT_EQ(imageOf(a), "a");
    EXPECT_EQ(imageOf(b), "b");
    EXPECT_THAT(rendered_, ElementsAre("gate", "a", "b"));
    EXPECT_NE(renderThread_, std::this_thread::get_id());
}

TEST_F(RenderQueueTest, RefusesAtOnceWhenFull) {
    makeQueue(2);
    auto gate = occupy();
    auto a = submit("a");
    auto b = submit("b");
    auto c = submit("c");
    ASSERT_TRUE(isAnswered(c));
    EXPECT_EQ(std::get<Refusal>(c.get()).reason, Reason::full);
    EXPECT_FALSE(isAnswered(a));
    openGate();
    EXPECT_EQ(imageOf(a), "a");
    EXPECT_EQ(imageOf(b), "b");
}

TEST_F(RenderQueueTest, RetryAfterFollowsTheQueueAndThePaceOfTheLastRenders) {
    makeQueue(3);
    for (const int paceS : {2, 100, 3}) {  // the median is 3
        renderS_ = paceS;
        auto done = submit("pace");
        imageOf(done);
    }
    auto gate = occupy();
    std::vector<std::future<RenderOutcome>> waiting;
    for (int i = 0; i < 3; ++i) waiting.push_back(submit("a"));
    EXPECT_EQ(std::get<Refusal>(submit("b").get()).retryAfter, seconds(4 * 3));
    openGate();
}

TEST_F(RenderQueueTest, RetryAfterIsAtLeastOneSecond) {
    makeQueue(1);
    auto gate = occupy();
    auto a = submit("a");
    EXPECT_EQ(std::get<Refusal>(submit("b").get()).retryAfter, seconds(1));
    openGate();
}

TEST_F(RenderQueueTest, AJobThatWaitedTooLongIsNotRendered) {
    makeQueue(8);
    auto gate = occupy();
    auto late = submit("late");
    nowS_ += 11;
    auto inTime = submit("in time");
    openGate();
    EXPECT_EQ(std::get<Refusal>(late.get()).reason, Reason::late);
    EXPECT_EQ(imageOf(inTime), "in time");
    EXPECT_THAT(rendered_, ElementsAre("gate", "in time"));
}

TEST_F(RenderQueueTest, ALateJobIsRefusedWhileAnotherIsStillRendered) {
    makeQueue(8);
    auto gate = occupy();
    auto a = submit("a");
    nowS_ += 10;
    queue_->sweep();
    EXPECT_FALSE(isAnswered(a));  // the deadline itself is still in time
    nowS_ += 1;
    queue_->sweep();
    ASSERT_TRUE(isAnswered(a));
    EXPECT_EQ(std::get<Refusal>(a.get()).reason, Reason::late);
    EXPECT_FALSE(isAnswered(gate));
    openGate();
}

TEST_F(RenderQueueTest, AnAbandonedJobIsNotRenderedAndFreesItsPlace) {
    makeQueue(1);
    auto gate = occupy();
    std::stop_source client;
    auto a = submit("a", client.get_token());
    client.request_stop();
    auto b = submit("b");
    EXPECT_EQ(std::get<Refusal>(a.get()).reason, Reason::abandoned);
    openGate();
    EXPECT_EQ(imageOf(b), "b");
    EXPECT_THAT(rendered_, ElementsAre("gate", "b"));
}

TEST_F(RenderQueueTest, StoppingFinishesTheRenderInHandAndRefusesTheRest) {
    makeQueue(8);
    auto gate = occupy();
    auto a = submit("a");
    queue_->stop();
    ASSERT_TRUE(isAnswered(a));
    EXPECT_EQ(std::get<Refusal>(a.get()).reason, Reason::stopping);
    EXPECT_EQ(std::get<Refusal>(submit("b").get()).reason, Reason::stopping);
    EXPECT_FALSE(isAnswered(gate));
    openGate();
    EXPECT_EQ(imageOf(gate), "gate");
    queue_.reset();
    EXPECT_THAT(rendered_, ElementsAre("gate"));
}

TEST_F(RenderQueueTest, ARenderThatFailsDoesNotDisturbTheNext) {
    makeQueue(8);
    auto broken = submit("throw");
    auto a = submit("a");
    EXPECT_THROW(std::rethrow_exception(std::get<std::exception_ptr>(broken.get())), std::runtime_error);
    EXPECT_EQ(imageOf(a), "a");
}

TEST_F(RenderQueueTest, TheRenderFunctionIsMadeAndDestroyedOnTheRenderThread) {
    struct Trace {
        std::thread::id made = std::this_thread::get_id();
        std::thread::id* destroyed;
        ~Trace() { *destroyed = std::this_thread::get_id(); }
    };
    std::thread::id made;
    std::thread::id destroyed;
    {
        RenderQueue queue({}, [&]() -> RenderFunction {
            auto trace = std::make_shared<Trace>();
            trace->destroyed = &destroyed;
            made = trace->made;
            return [trace](const RenderCall&) { return RenderedImage{}; };
        });
        std::promise<void> done;
        queue.submit({{}, {}, [&done](const RenderOutcome&) { done.set_value(); }});
        done.get_future().wait();
    }
    EXPECT_NE(made, std::this_thread::get_id());
    EXPECT_EQ(made, destroyed);
}

TEST_F(RenderQueueTest, EveryJobOfManyThreadsGetsOneOutcome) {
    makeQueue(16);
    std::atomic<int> outcomes = 0;
    constexpr int kThreads = 8;
    constexpr int kJobs = 200;
    {
        std::vector<std::jthread> threads;
        for (int t = 0; t < kThreads; ++t)
            threads.emplace_back([&] {
                for (int i = 0; i < kJobs; ++i)
                    queue_->submit({{}, {}, [&outcomes](const RenderOutcome&) { ++outcomes; }});
            });
    }
    queue_.reset();
    EXPECT_EQ(outcomes, kThreads * kJobs);
}

}  // namespace
}  // namespace curvewall
