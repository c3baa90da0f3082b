// The program itself: `curvewall serve` with a real renderer, many clients, good and bad ones.

#include "server/frame_maker.h"
#include "server/library.h"
#include "server/render_api.h"
#include "tests/server/http_client.h"
#include "tests/server/small_wall.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include <csignal>
#include <fcntl.h>
#include <map>
#include <memory>
#include <mutex>
#include <random>
#include <spawn.h>
#include <stdexcept>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

extern char** environ;

namespace curvewall {
namespace {

using nlohmann::json;
using ::testing::AnyOf;
using ::testing::HasSubstr;

// Minutes of fitting.
constexpr std::string_view kHardWall = R"({
    "wall": "hard", "eye": [0, 0, 0],
    "displays": [ { "name": "front", "size": [4000, 4000],
                    "projection": { "type": "radial", "model": "orthographic", "fov_deg": 180 } } ] })";
constexpr double kHardPx = 0.05;

// `curvewall serve CONFIG --port PORT`, killed at the end if it still runs.
class ServeProcess {
public:
    ServeProcess(const std::string& config, const std::string& port) {
        int pipeEnds[2];
        if (pipe2(pipeEnds, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
        output_ = pipeEnds[0];
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, pipeEnds[1], STDOUT_FILENO);
        std::string executable = CURVEWALL_EXECUTABLE, command = "serve", configPath = config,
                    option = "--port", portText = port;
        char* arguments[] = {executable.data(), command.data(),  configPath.data(),
                             option.data(),     portText.data(), nullptr};
        const int error = posix_spawn(&process_, executable.c_str(), &actions, nullptr, arguments, environ);
        posix_spawn_file_actions_destroy(&actions);
        close(pipeEnds[1]);
        if (error != 0) throw std::runtime_error("cannot start " + executable);
    }
    ~ServeProcess() {
        if (process_ > 0) {
            kill(process_, SIGKILL);
            waitpid(process_, nullptr, 0);
        }
        close(output_);
    }
    ServeProcess(const ServeProcess&) = delete;
    ServeProcess& operator=(const ServeProcess&) = delete;

    // Until the end of the line or of the output.
    std::string readLine() const {
        std::string line;
        char c = 0;
        while (read(output_, &c, 1) == 1 && c != '\n') line += c;
        return line;
    }

    void terminate() const { kill(process_, SIGTERM); }

    int waitForExitCode() {
        int status = 0;
        waitpid(std::exchange(process_, 0), &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

private:
    pid_t process_ = 0;
    int output_ = -1;
};

class DaemonE2eTest : public ::testing::Test {
protected:
    DaemonE2eTest() {
        folder_.write("small.json", kSmallWall);
        folder_.write("hard.json", kHardWall);
        config_ = folder_.write("daemon.json", R"({"queue": {"length": 64, "deadline_s": 600}})");
        process_ = std::make_unique<ServeProcess>(config_, "0");
        const std::string line = process_->readLine();
        const std::string prefix = "listening on http://127.0.0.1:";
        if (!line.starts_with(prefix)) throw std::runtime_error("the first line is \"" + line + "\"");
        port_ = static_cast<uint16_t>(std::stoi(line.substr(prefix.size())));
    }

    test::TemporaryFolder folder_;
    std::string config_;
    std::unique_ptr<ServeProcess> process_;
    uint16_t port_ = 0;
};

std::string renderBody(unsigned variant) {
    return json{{"wall", "small"},
                {"scene", variant % 2 == 0 ? "room" : "city:2000"},
                {"camera", {{"position", {0, 0.5, 0}}, {"yaw_deg", 45.0 * (variant % 8)}}},
                {"method", variant % 4 < 2 ? "piecewise" : "reference"},
                {"format", variant % 8 < 6 ? "png" : "exr"}}
        .dump();
}

TEST_F(DaemonE2eTest, AnswersGoodAndBadClientsAndExitsCleanly) {
    constexpr int kClients = 16;
    constexpr int kRequestsTotal = 208;
    std::mutex mutex;
    std::map<std::string, std::string> imageOfRequest;  // guarded by mutex
    const auto expectSameImageAsBefore = [&](const std::string& request, const std::string& image) {
        std::scoped_lock lock(mutex);
        const auto [entry, isNew] = imageOfRequest.emplace(request, image);
        EXPECT_TRUE(isNew || entry->second == image) << request;
    };
    const auto runClient = [&](unsigned seed) {
        std::mt19937 random(seed);
        for (int i = 0; i < kRequestsTotal / kClients; ++i) {
            HttpClient client(port_);
            switch (random() % 8) {
                case 0:
                    EXPECT_EQ(client.render("{\"wall\": ").result_int(), 400U);
                    break;
                case 1:
                    EXPECT_EQ(client.render(R"({"wall": "none", "scene": "room"})").result_int(), 422U);
                    break;
                case 2:
                    client.trySend(HttpClient::request("POST", "/v1/render", std::string(2'000'000, ' ')));
                    EXPECT_EQ(client.read().result_int(), 413U);
                    break;
                case 3: {
                    const std::string request = HttpClient::request("POST", "/v1/render", renderBody(0));
                    client.trySend(request.substr(0, random() % (request.size() + 1)));
                    break;
                }
                default: {
                    const std::string body = renderBody(static_cast<unsigned>(random() % 8));
                    const auto response = client.render(body);
                    EXPECT_EQ(response.result_int(), 200U) << body << response.body();
                    expectSameImageAsBefore(body, response.body());
                }
            }
        }
    };
    {
        std::vector<std::jthread> clients;
        for (unsigned seed = 0; seed < kClients; ++seed) clients.emplace_back(runClient, seed);
    }
    EXPECT_EQ(imageOfRequest.size(), 8U);
    EXPECT_EQ(HttpClient(port_).call("GET", "/healthz").result_int(), 200U);
    process_->terminate();
    EXPECT_EQ(process_->waitForExitCode(), 0);
}

TEST_F(DaemonE2eTest, DifferentCamerasGiveDifferentPictures) {
    HttpClient client(port_);
    const auto ahead = client.render(renderBody(0));
    const auto aside = client.render(renderBody(4));
    EXPECT_TRUE(ahead.body().starts_with("\x89PNG"));
    EXPECT_TRUE(ahead.body() != aside.body());  // without printing images
    const json stats = json::parse(header(ahead, "Curvewall-Stats"));
    EXPECT_EQ(stats["method"], "piecewise");
    EXPECT_THAT(header(ahead, "Server-Timing"), HasSubstr("queue;dur="));
}

TEST_F(DaemonE2eTest, TheEyeMovesThePictureAndHasToSeeTheWall) {
    HttpClient client(port_);
    const auto bodyFrom = [](const json& eye) {
        return json{{"wall", "small"}, {"scene", "room"}, {"eye", eye}}.dump();
    };
    const auto own = client.render(R"({"wall": "small", "scene": "room"})");
    const auto same = client.render(bodyFrom({0, 0, 0}));
    const auto moved = client.render(bodyFrom({0.5, 0.2, -0.4}));
    EXPECT_EQ(moved.result_int(), 200U);
    EXPECT_TRUE(own.body() == same.body());  // without printing images
    EXPECT_TRUE(own.body() != moved.body());
    const auto blind = client.render(bodyFrom({0, 0, 2}));  // on the wall itself
    EXPECT_EQ(blind.result_int(), 422U);
    EXPECT_THAT(blind.body(), HasSubstr("the eye is not inside the cylinder"));
}

TEST_F(DaemonE2eTest, TheSignalWaitsForTheFrameInHand) {
    HttpClient client(port_);
    client.send(HttpClient::request("POST", "/v1/render", R"({"wall": "small", "scene": "city:2000",
        "method": "reference", "samples": 64})"));
    // The request above is taken up before the last of these is answered.
    for (int i = 0; i < 10; ++i) HttpClient(port_).call("GET", "/healthz");
    process_->terminate();
    EXPECT_EQ(process_->waitForExitCode(), 0);
    // In hand or still waiting: either way there is an answer.
    EXPECT_THAT(client.read().result_int(), AnyOf(200U, 503U));
}

TEST_F(DaemonE2eTest, ThePicturesAreThoseOfARenderThatFits) {
    const Library library = openLibrary(folder_.path(), folder_.path("scenes"), 1000);
    const RenderFunction render = makeFrameMaker(1);
    HttpClient client(port_);
    // Each at a tolerance of its own: at the same one the second eye's pieces would be refitted.
    for (const auto& [eye, tolerancePx] : {std::pair{json{0, 0, 0}, 0.25}, {json{0.5, 0.2, -0.4}, 0.3}}) {
        const json request{{"wall", "small"}, {"scene", "room"}, {"eye", eye}, {"tolerance_px", tolerancePx}};
        const std::string body = request.dump();
        const std::string expected = render(decodeRenderCall(body, library, 1 << 20)).bytes;
        for (int i = 0; i < 2; ++i)
            EXPECT_TRUE(client.render(body).body() == expected) << eye;  // without printing images
    }
}

TEST_F(DaemonE2eTest, AnEyeThatMovesGetsASparseCertificateAtOnceAndAFullOneLater) {
    HttpClient client(port_);
    const auto statsFrom = [&](double eyeXM) {
        const json request{{"wall", "small"}, {"scene", "room"}, {"eye", {eyeXM, 0, 0}}};
        return json::parse(header(client.render(request.dump()), "Curvewall-Stats"));
    };
    EXPECT_EQ(statsFrom(0)["certificate"]["every"], 1);
    const json atOnce = statsFrom(0.001);
    EXPECT_EQ(atOnce["certificate"]["every"], 8);
    EXPECT_GE(atOnce["certificate"].value("full_age_ms", -1.0), 0);
    EXPECT_LE(atOnce["geometric_error_px"]["max"], 0.25);
    while (statsFrom(0.001)["certificate"]["every"] != 1) std::this_thread::yield();
}

TEST_F(DaemonE2eTest, TheSignalEndsAFitAndOthersDoNotWaitForIt) {
    HttpClient hard(port_);
    hard.send(HttpClient::request(
        "POST", "/v1/render", json{{"wall", "hard"}, {"scene", "room"}, {"tolerance_px", kHardPx}}.dump()));
    EXPECT_EQ(HttpClient(port_).render(renderBody(0)).result_int(), 200U);
    process_->terminate();
    EXPECT_EQ(process_->waitForExitCode(), 0);
    EXPECT_EQ(hard.read().result_int(), 503U);
}

TEST_F(DaemonE2eTest, ATakenPortEndsTheSecondDaemon) {
    ServeProcess second(config_, std::to_string(port_));
    EXPECT_EQ(second.readLine(), "");
    EXPECT_EQ(second.waitForExitCode(), 1);
}

}  // namespace
}  // namespace curvewall
