// The daemon over real sockets, with a renderer that draws nothing.

#include "server/daemon.h"

#include "calibration/errors.h"
#include "tests/server/http_client.h"
#include "tests/server/small_wall.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <future>
#include <memory>
#include <mutex>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace curvewall {
namespace {

using nlohmann::json;
using ::testing::AnyOf;
using ::testing::HasSubstr;

// The camera's x decides what the renderer does.
constexpr double kWaitForGate = -1;
constexpr double kImpossible = -2;
constexpr double kBroken = -3;
constexpr double kLarge = -4;
constexpr double kEndlessFitPx = 77;  // a tolerance
constexpr size_t kLargeBytes = size_t{8} << 20;

std::string renderBody(double x, std::string_view wall = "small") {
    return json{{"wall", wall}, {"scene", "room"}, {"camera", {{"position", {x, 0, 0}}}}}.dump();
}

std::string hardToFit() {
    return json{{"wall", "small"}, {"scene", "room"}, {"tolerance_px", kEndlessFitPx}}.dump();
}

class DaemonTest : public ::testing::Test {
protected:
    DaemonTest() {
        folder_.write("small.json", kSmallWall);
        config_.port = 0;
        config_.wallsFolder = folder_.path();
        config_.scenesFolder = folder_.path("scenes");
    }

    void start() {
        daemon_ = std::make_unique<Daemon>(
            config_,
            [this]() -> RenderFunction { return [this](const RenderCall& call) { return render(call); }; },
            [this](const Display&, double tolerancePx, const std::stop_token& stop) {
                return fit(tolerancePx, stop);
            },
            [](const FittedPieces& before, const auto&...) { return before; });
        port_ = daemon_->port();
        thread_ = std::thread([this] { daemon_->run(); });
    }

    ~DaemonTest() override {
        openGate();
        if (!daemon_) return;
        daemon_->stop();
        if (thread_.joinable()) thread_.join();
    }

    RenderedImage render(const RenderCall& call) {
        const double x = call.request.camera.positionM.x;
        {
            std::unique_lock lock(mutex_);
            rendered_.push_back(x);
            changed_.notify_all();
            if (x == kWaitForGate) changed_.wait(lock, [this] { return gateOpen_; });
        }
        if (x == kImpossible) throw UsageError("samples: the driver has fewer");
        if (x == kBroken) throw InputError("model.glb", "", "a scene", "junk");
        RenderedImage image;
        image.bytes = x == kLarge ? std::string(kLargeBytes, 'x') : "image " + std::to_string(x);
        image.statsJson = "{}";
        return image;
    }

    FittedPieces fit(double tolerancePx, const std::stop_token& stop) {
        if (tolerancePx != kEndlessFitPx) return {};
        std::unique_lock lock(mutex_);
        std::condition_variable_any stopped;
        stopped.wait(lock, stop, [] { return false; });
        throw FitStopped();
    }

    void openGate() {
        std::scoped_lock lock(mutex_);
        gateOpen_ = true;
        changed_.notify_all();
    }

    std::vector<double> renderedSoFar() {
        std::scoped_lock lock(mutex_);
        return rendered_;
    }

    // Until the render thread has begun so many renders.
    void waitForRenders(size_t count) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return rendered_.size() >= count; });
    }

    HttpClient client() const { return HttpClient(port_); }

    test::TemporaryFolder folder_;
    DaemonConfig config_;
    std::mutex mutex_;  // guards the next three
    std::condition_variable changed_;
    bool gateOpen_ = false;
    std::vector<double> rendered_;
    std::unique_ptr<Daemon> daemon_;
    std::thread thread_;
    uint16_t port_ = 0;
};

TEST_F(DaemonTest, AnswersEachCall) {
    start();
    HttpClient client(port_);
    EXPECT_EQ(client.call("GET", "/healthz").result_int(), 200U);
    EXPECT_EQ(json::parse(client.call("GET", "/v1/walls").body()), (json{{"walls", {"small"}}}));
    EXPECT_EQ(json::parse(client.call("GET", "/v1/scenes").body()), (json{{"scenes", {"city", "room"}}}));
    const auto image = client.render(renderBody(5));
    EXPECT_EQ(image.result_int(), 200U);
    EXPECT_EQ(image.body(), "image 5.000000");
    EXPECT_EQ(header(image, "Content-Type"), "image/png");
    EXPECT_EQ(header(image, "Curvewall-Stats"), "{}");
    EXPECT_THAT(header(image, "Server-Timing"), HasSubstr("render;dur="));
}

TEST_F(DaemonTest, ErrorsAreProblemsAndKeepTheConnection) {
    start();
    HttpClient client(port_);
    const auto expectProblem = [](const HttpClient::Response& response, unsigned status) {
        EXPECT_EQ(response.result_int(), status);
        EXPECT_EQ(header(response, "Content-Type"), "application/problem+json");
        EXPECT_EQ(json::parse(response.body())["status"], status);
        EXPECT_TRUE(response.keep_alive());
    };
    expectProblem(client.call("GET", "/none"), 404);
    expectProblem(client.call("PUT", "/v1/render", "{}"), 405);
    expectProblem(client.call("POST", "/v1/render", "{}", "Content-Type: text/plain\r\n"), 415);
    expectProblem(client.render("{"), 400);
    expectProblem(client.call("POST", "/v1/render"), 400);
    expectProblem(client.render(renderBody(1, "none")), 422);
    expectProblem(client.render(renderBody(kImpossible)), 422);
    expectProblem(client.render(renderBody(kBroken)), 500);
    EXPECT_EQ(client.render(renderBody(1)).result_int(), 200U);
}

TEST_F(DaemonTest, HeadHasTheLengthAndNoBody) {
    start();
    HttpClient client(port_);
    const std::string length = header(client.call("GET", "/v1/walls"), "Content-Length");
    const auto head = client.call("HEAD", "/v1/walls");
    EXPECT_EQ(header(head, "Content-Length"), length);
    EXPECT_EQ(client.call("HEAD", "/none").result_int(), 404U);
    EXPECT_EQ(client.call("GET", "/healthz").body(), "ok\n");
}

TEST_F(DaemonTest, PipelinedRequestsAreAnsweredInOrder) {
    start();
    HttpClient client(port_);
    std::string all;
    constexpr int kRequests = 300;
    for (int i = 0; i < kRequests; ++i)
        all += i % 3 == 0 ? HttpClient::request("GET", "/healthz")
                          : HttpClient::request("POST", "/v1/render", renderBody(i));
    std::thread sender([&] { client.send(all); });
    for (int i = 0; i < kRequests; ++i)
        EXPECT_EQ(client.read().body(), i % 3 == 0 ? "ok\n" : "image " + std::to_string(double(i)));
    sender.join();
}

TEST_F(DaemonTest, ARequestMayArriveByteByByte) {
    start();
    HttpClient client(port_);
    for (const char byte : HttpClient::request("POST", "/v1/render", renderBody(7))) client.send({&byte, 1});
    EXPECT_EQ(client.read().body(), "image 7.000000");
}

TEST_F(DaemonTest, ABodyMayComeInChunks) {
    start();
    HttpClient client(port_);
    client.send("POST /v1/render HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n");
    const std::string body = renderBody(3);
    client.send("1;ext=1\r\n" + body.substr(0, 1) + "\r\n");
    std::ostringstream size;
    size << std::hex << body.size() - 1;
    client.send(size.str() + "\r\n" + body.substr(1) + "\r\n0\r\nTrailer: x\r\n\r\n");
    EXPECT_EQ(client.read().body(), "image 3.000000");
}

TEST_F(DaemonTest, ABodyOverTheLimitIsRefused) {
    config_.maxBodyBytes = 1000;
    start();
    {
        HttpClient client(port_);  // although it goes on sending, it gets to see why
        client.trySend(HttpClient::request("POST", "/v1/render", std::string(5'000'000, ' ')));
        const auto response = client.read();
        EXPECT_EQ(response.result_int(), 413U);
        EXPECT_FALSE(response.keep_alive());
    }
    HttpClient chunked(port_);
    chunked.trySend("POST /v1/render HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n3e9\r\n" +
                    std::string(1001, ' ') + "\r\n");
    EXPECT_EQ(chunked.read().result_int(), 413U);
    EXPECT_TRUE(chunked.isClosedByServer());
    std::string justFits = renderBody(1);
    justFits.resize(1000, ' ');
    EXPECT_EQ(client().render(justFits).result_int(), 200U);
}

TEST_F(DaemonTest, AClientThatExpects100ContinueIsToldBeforeItSends) {
    config_.maxBodyBytes = 1000;
    start();
    const std::string body = renderBody(2);
    const auto head = [](const std::string& path, size_t length) {
        return "POST " + path +
               " HTTP/1.1\r\nHost: x\r\nExpect: 100-continue\r\nContent-Length: " + std::to_string(length) +
               "\r\n\r\n";
    };
    HttpClient accepted(port_);
    accepted.send(head("/v1/render", body.size()));
    EXPECT_EQ(accepted.read(true).result_int(), 100U);
    accepted.send(body);
    EXPECT_EQ(accepted.read().body(), "image 2.000000");

    HttpClient partly(port_);  // some of the body comes with the header
    partly.send(head("/v1/render", body.size()) + body.substr(0, 5));
    EXPECT_EQ(partly.read(true).result_int(), 100U);
    partly.send(body.substr(5));
    EXPECT_EQ(partly.read().body(), "image 2.000000");

    HttpClient tooLarge(port_);
    tooLarge.send(head("/v1/render", 1001));
    EXPECT_EQ(tooLarge.read().result_int(), 413U);
    HttpClient nowhere(port_);
    nowhere.send(head("/none", 10));
    EXPECT_EQ(nowhere.read().result_int(), 404U);
    EXPECT_TRUE(nowhere.isClosedByServer());
}

TEST_F(DaemonTest, ConnectionsLastAsTheClientAsks) {
    start();
    HttpClient closing(port_);
    EXPECT_FALSE(closing.call("GET", "/healthz", "", "Connection: close\r\n").keep_alive());
    EXPECT_TRUE(closing.isClosedByServer());
    HttpClient old(port_);
    old.send("GET /healthz HTTP/1.0\r\n\r\n");
    EXPECT_EQ(old.read().body(), "ok\n");
    EXPECT_TRUE(old.isClosedByServer());
    HttpClient oldButKept(port_);
    oldButKept.send("GET /healthz HTTP/1.0\r\nConnection: keep-alive\r\n\r\n");
    EXPECT_TRUE(oldButKept.read().keep_alive());
    oldButKept.send("GET /healthz HTTP/1.0\r\n\r\n");
    EXPECT_EQ(oldButKept.read().result_int(), 200U);
}

TEST_F(DaemonTest, WhatIsNotHttpIsRefusedAndClosed) {
    start();
    struct Mistake {
        std::string bytes;
        unsigned status;
    };
    const std::vector<Mistake> mistakes{
        {"hello\r\n\r\n", 400},
        {"GET /healthz HTTP/1.1\r\n\r\n", 400},  // no Host
        {"GET /healthz HTTP/2.0\r\nHost: x\r\n\r\n", 505},
        {"GET /healthz HTTP/1.1\r\nHost: x\r\nBad Header\r\n\r\n", 400},
        {"POST /v1/render HTTP/1.1\r\nHost: x\r\nContent-Length: -1\r\n\r\n", 400},
        {"POST /v1/render HTTP/1.1\r\nHost: x\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\n{}", 400},
        {"POST /v1/render HTTP/1.1\r\nHost: x\r\nContent-Length: 2\r\nTransfer-Encoding: chunked\r\n\r\n{}",
         400},
        {"POST /v1/render HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\nxyz\r\n", 400},
        {"GET /healthz HTTP/1.1\r\nHost: x\r\nLong: " + std::string(20'000, 'x') + "\r\n\r\n", 431},
        {"GET /" + std::string(20'000, 'x') + " HTTP/1.1\r\nHost: x\r\n\r\n", 431},
        {std::string("\x16\x03\x01\x02\x00\x01\x00", 7), 400},  // a TLS client
    };
    for (const Mistake& mistake : mistakes) {
        HttpClient client(port_);
        client.trySend(mistake.bytes);
        const auto response = client.read();
        EXPECT_EQ(response.result_int(), mistake.status) << mistake.bytes.substr(0, 100);
        EXPECT_EQ(header(response, "Content-Type"), "application/problem+json");
    }
}

TEST_F(DaemonTest, EndlessChunkExtensionsAndTrailersAreRefused) {
    start();
    for (const std::string start : {"1;", "0\r\nTrailer: "}) {
        HttpClient client(port_);
        client.send("POST /v1/render HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n" + start);
        client.trySend(std::string(200'000, 'x'));
        EXPECT_THAT(client.read().result_int(), AnyOf(400U, 431U));
    }
}

TEST_F(DaemonTest, TokensAreAskedFor) {
    config_.token = "s3cret";
    start();
    HttpClient client(port_);
    const auto refused = client.render(renderBody(1));
    EXPECT_EQ(refused.result_int(), 401U);
    EXPECT_EQ(header(refused, "WWW-Authenticate"), "Bearer");
    EXPECT_EQ(client.call("GET", "/healthz").result_int(), 200U);
    EXPECT_EQ(
        client.call("POST", "/v1/render", renderBody(1), "Authorization: Bearer s3cret\r\n").result_int(),
        200U);
}

TEST_F(DaemonTest, SlowClientsDoNotStallOthers) {
    start();
    std::deque<HttpClient> slow;
    for (int i = 0; i < 50; ++i) {
        slow.emplace_back(port_);
        if (i % 2 == 0) slow.back().send("POST /v1/render HTTP/1.1\r\nContent-Length: 100\r\nHo");
    }
    auto lazyReader = client();  // asks for more than the socket's buffers hold and does not read
    for (int i = 0; i < 4; ++i)
        lazyReader.send(HttpClient::request("POST", "/v1/render", renderBody(kLarge)));
    for (int i = 0; i < 50; ++i) EXPECT_EQ(client().render(renderBody(i)).result_int(), 200U);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(lazyReader.read().body().size(), kLargeBytes);
}

TEST_F(DaemonTest, AFullQueueRefusesWithRetryAfter) {
    config_.queueLength = 2;
    start();
    auto busy = client();
    busy.send(HttpClient::request("POST", "/v1/render", renderBody(kWaitForGate)));
    waitForRenders(1);
    // Of three more, two find a place; which of them depends on the network.
    std::promise<void> refused;
    std::atomic<int> refusals = 0;
    std::atomic<int> images = 0;
    std::vector<std::thread> clients;
    for (int i = 0; i < 3; ++i)
        clients.emplace_back([&] {
            const auto response = client().render(renderBody(1));
            if (response.result_int() == 200) {
                ++images;
            } else if (response.result_int() == 503 && header(response, "Retry-After") == "1") {
                ++refusals;
                refused.set_value();
            }
        });
    refused.get_future().wait();
    openGate();
    for (std::thread& thread : clients) thread.join();
    EXPECT_EQ(busy.read().result_int(), 200U);
    EXPECT_EQ(refusals, 1);
    EXPECT_EQ(images, 2);
}

TEST_F(DaemonTest, ALateRequestIsRefusedBeforeTheOneInHandIsDone) {
    config_.queueDeadline = std::chrono::seconds(1);
    start();
    auto busy = client();
    busy.send(HttpClient::request("POST", "/v1/render", renderBody(kWaitForGate)));
    waitForRenders(1);
    EXPECT_EQ(client().render(renderBody(1)).result_int(), 503U);
    openGate();
    EXPECT_EQ(busy.read().result_int(), 200U);
}

TEST_F(DaemonTest, ADisplayThatIsHardToFitDoesNotStallOthers) {
    config_.queueDeadline = std::chrono::seconds(2);
    start();
    auto hard = client();
    hard.send(HttpClient::request("POST", "/v1/render", hardToFit()));
    EXPECT_EQ(client().render(renderBody(1)).result_int(), 200U);
    const auto refusal = hard.read();
    EXPECT_EQ(refusal.result_int(), 503U);
    EXPECT_EQ(header(refusal, "Retry-After"), "2");
    EXPECT_THAT(refusal.body(), HasSubstr("longer than the deadline"));
    EXPECT_EQ(renderedSoFar(), std::vector<double>{1});
}

TEST_F(DaemonTest, StoppingDoesNotWaitForFits) {
    config_.queueDeadline = std::chrono::hours(1);
    start();
    auto hard = client();
    hard.send(HttpClient::request("POST", "/v1/render", hardToFit()));
    EXPECT_EQ(client().render(renderBody(1)).result_int(), 200U);
    daemon_->stop();
    thread_.join();
}

TEST_F(DaemonTest, ARequestOfAClientThatHungUpIsNotRendered) {
    config_.queueDeadline = std::chrono::hours(1);
    start();
    auto busy = client();
    busy.send(HttpClient::request("POST", "/v1/render", renderBody(kWaitForGate)));
    waitForRenders(1);
    auto leaving = client();
    leaving.send(HttpClient::request("POST", "/v1/render", renderBody(13)));
    leaving.finishSending();
    // It only stopped sending, so it still learns why.
    EXPECT_THAT(leaving.read().body(), HasSubstr("closed the connection before the render began"));
    openGate();
    EXPECT_EQ(busy.read().result_int(), 200U);
    EXPECT_EQ(client().render(renderBody(14)).result_int(), 200U);
    EXPECT_EQ(renderedSoFar(), (std::vector<double>{kWaitForGate, 14}));
}

TEST_F(DaemonTest, ClientsThatHangUpAnywhereDoNoHarm) {
    start();
    const std::string request = HttpClient::request("POST", "/v1/render", renderBody(1));
    for (size_t length = 0; length <= request.size(); ++length) client().send(request.substr(0, length));
    for (int i = 0; i < 8; ++i) client().send(HttpClient::request("POST", "/v1/render", renderBody(kLarge)));
    EXPECT_EQ(client().call("GET", "/healthz").result_int(), 200U);
}

TEST_F(DaemonTest, ConnectionsAboveTheLimitAreToldSo) {
    config_.maxConnections = 3;
    start();
    std::deque<HttpClient> clients;
    for (int i = 0; i < 3; ++i) {
        clients.emplace_back(port_);
        EXPECT_EQ(clients.back().call("GET", "/healthz").result_int(), 200U);
    }
    auto fourth = client();
    const auto refusal = fourth.read();
    EXPECT_EQ(refusal.result_int(), 503U);
    EXPECT_EQ(header(refusal, "Retry-After"), "1");
    EXPECT_TRUE(fourth.isClosedByServer());
    EXPECT_EQ(clients[0].call("GET", "/healthz").result_int(), 200U);
}

TEST_F(DaemonTest, ManyClientsEachGetTheirOwnImages) {
    config_.queueLength = 16;
    start();
    constexpr int kClients = 16;
    constexpr int kRequests = 100;
    std::atomic<int> right = 0;
    {
        std::vector<std::jthread> threads;
        for (int t = 0; t < kClients; ++t)
            threads.emplace_back([this, t, &right] {
                HttpClient client(port_);
                for (int i = 0; i < kRequests; ++i) {
                    const double x = t * 1000 + i;
                    const auto response = client.render(renderBody(x));
                    if (response.result_int() == 200 && response.body() == "image " + std::to_string(x))
                        ++right;
                }
            });
    }
    EXPECT_EQ(right, kClients * kRequests);
}

TEST_F(DaemonTest, RandomBytesDoNoHarm) {
    start();
    std::mt19937 random(3);
    const std::string good =
        HttpClient::request("POST", "/v1/render", renderBody(1), "Expect: 100-continue\r\n") +
        "POST /v1/render HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n"
        "5\r\n{\"wal\r\n0\r\n\r\n";
    for (int i = 0; i < 1000; ++i) {
        std::string bytes = good;
        if (i % 4 == 0) {
            bytes.assign(random() % 300, ' ');
            for (char& c : bytes) c = static_cast<char>(random());
        } else {
            for (auto edits = 1 + random() % 6; edits > 0; --edits) {
                const size_t at = random() % bytes.size();
                if (random() % 2 == 0)
                    bytes[at] = static_cast<char>(random());
                else
                    bytes.erase(at, 1 + random() % 10);
                if (bytes.empty()) bytes = "G";
            }
        }
        HttpClient client(port_);
        const size_t half = random() % (bytes.size() + 1);
        client.trySend(bytes.substr(0, half));
        client.trySend(bytes.substr(half));
    }
    EXPECT_EQ(client().render(renderBody(1)).body(), "image 1.000000");
}

TEST_F(DaemonTest, StoppingDeliversTheFrameInHand) {
    start();
    {
        auto idle = client();
        EXPECT_EQ(idle.call("GET", "/healthz").result_int(), 200U);
        auto inHand = client();
        inHand.send(HttpClient::request("POST", "/v1/render", renderBody(kWaitForGate)));
        waitForRenders(1);
        daemon_->stop();
        EXPECT_TRUE(idle.isClosedByServer());
        EXPECT_THROW(HttpClient{port_}, boost::system::system_error);
        openGate();
        const auto image = inHand.read();
        EXPECT_EQ(image.result_int(), 200U);
        EXPECT_EQ(image.body(), "image -1.000000");
        EXPECT_FALSE(image.keep_alive());
        EXPECT_TRUE(inHand.isClosedByServer());
    }
    thread_.join();  // run() has returned
}

TEST_F(DaemonTest, StoppingRefusesWhatIsQueued) {
    config_.queueLength = 1;
    start();
    auto inHand = client();
    inHand.send(HttpClient::request("POST", "/v1/render", renderBody(kWaitForGate)));
    waitForRenders(1);
    // When one of two is told that the queue is full, the other is in it.
    std::promise<void> full;
    std::promise<void> stopping;
    const auto ask = [&] {
        const std::string answer = client().render(renderBody(1)).body();
        if (answer.find("too many renders") != std::string::npos) full.set_value();
        if (answer.find("is stopping") != std::string::npos) stopping.set_value();
    };
    std::thread one(ask);
    std::thread other(ask);
    full.get_future().wait();
    daemon_->stop();
    stopping.get_future().wait();
    openGate();
    EXPECT_EQ(inHand.read().result_int(), 200U);
    one.join();
    other.join();
}

TEST_F(DaemonTest, ATakenPortIsAnError) {
    start();
    DaemonConfig second = config_;
    second.port = port_;
    try {
        Daemon daemon(second, [] { return RenderFunction(); }, {}, {});
        FAIL() << "listens twice";
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(error.what(), "127.0.0.1:" + std::to_string(port_) + ": address already in use");
    }
}

TEST_F(DaemonTest, TheUrlNamesThePort) {
    start();
    EXPECT_EQ(daemon_->url(), "http://127.0.0.1:" + std::to_string(port_));
}

}  // namespace
}  // namespace curvewall
