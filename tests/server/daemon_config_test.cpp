#include "server/daemon_config.h"

#include "calibration/errors.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace curvewall {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class DaemonConfigTest : public ::testing::Test {
protected:
    DaemonConfig read(std::string_view text) const {
        return readDaemonConfig(folder_.write("daemon.json", text));
    }
    std::string complaint(std::string_view text) const {
        try {
            read(text);
        } catch (const InputError& error) {
            return error.what();
        }
        return "no complaint";
    }

    test::TemporaryFolder folder_;
};

TEST_F(DaemonConfigTest, NoKeyIsNeeded) {
    DaemonConfig expected;
    expected.wallsFolder = folder_.path();
    expected.scenesFolder = folder_.path("scenes");
    EXPECT_EQ(read("{}"), expected);
}

TEST_F(DaemonConfigTest, EveryKeyIsTaken) {
    folder_.write("token.txt", "s3cret\n");
    const DaemonConfig config = read(R"({
        "bind": "0.0.0.0", "port": 0, "walls": "w", "scenes": "/abs/s",
        "queue": {"length": 3, "deadline_s": 0.5}, "max_body_bytes": 4, "max_connections": 5,
        "max_city_triangles": 6, "max_loaded_scenes": 7, "max_samples_per_frame": 8,
        "token_file": "token.txt"})");
    DaemonConfig expected;
    expected.bindAddress = "0.0.0.0";
    expected.port = 0;
    expected.wallsFolder = folder_.path("w");
    expected.scenesFolder = "/abs/s";
    expected.queueLength = 3;
    expected.queueDeadline = std::chrono::duration<double>(0.5);
    expected.maxBodyBytes = 4;
    expected.maxConnections = 5;
    expected.maxCityTriangles = 6;
    expected.maxLoadedScenes = 7;
    expected.maxSamplesPerFrame = 8;
    expected.token = "s3cret";
    EXPECT_EQ(config, expected);
}

TEST_F(DaemonConfigTest, OnlyLoopbackGoesWithoutAToken) {
    for (const char* loopback : {"127.0.0.1", "127.1.2.3", "::1"})
        EXPECT_NO_THROW(read(R"({"bind": ")" + std::string(loopback) + "\"}")) << loopback;
    for (const char* open : {"0.0.0.0", "::", "192.168.1.2", "::ffff:127.0.0.1"})
        EXPECT_THAT(complaint(R"({"bind": ")" + std::string(open) + "\"}"), HasSubstr("token")) << open;
    EXPECT_EQ(read(R"({"bind": "0.0.0.0", "token": "abc"})").token, "abc");
}

struct Mistake {
    std::string text;
    std::string message;
};

// GoogleTest would print the bytes, addresses among them, into the names that ctest shows.
void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.text; }

class BadDaemonConfig : public DaemonConfigTest, public ::testing::WithParamInterface<Mistake> {};

TEST_P(BadDaemonConfig, IsExplained) {
    EXPECT_THAT(complaint(GetParam().text), AllOf(HasSubstr("daemon.json: "), HasSubstr(GetParam().message)));
}

INSTANTIATE_TEST_SUITE_P(
    DaemonConfig, BadDaemonConfig,
    ::testing::Values(
        Mistake{"{", "expected JSON"}, Mistake{"[]", "expected an object, found a list"},
        Mistake{R"({"prot": 1})", R"(found the key "prot")"},
        Mistake{R"({"queue": {"size": 1}})", "queue: expected only the keys length, deadline_s"},
        Mistake{R"({"port": 70000})", "port: expected a whole number from 0 to 65535, found 70000"},
        Mistake{R"({"port": "8650"})", R"(port: expected a whole number, found "8650")"},
        Mistake{R"({"queue": {"length": 0}})", "queue.length: expected"},
        Mistake{R"({"queue": {"deadline_s": -1}})", "queue.deadline_s: expected"},
        Mistake{R"({"bind": "localhost"})", R"(bind: expected an IP address, found "localhost")"},
        Mistake{R"({"token": ""})", "token: expected a token"},
        Mistake{R"({"token": "a b"})", "token: expected a token"},
        Mistake{R"({"token": "a", "token_file": "b"})", "token_file: expected nothing beside token"}));

TEST_F(DaemonConfigTest, FilesThatAreNotThereAreNamed) {
    EXPECT_THAT(complaint(R"({"token_file": "none.txt"})"), HasSubstr("none.txt: expected"));
    EXPECT_THROW(readDaemonConfig(folder_.path("none.json")), InputError);
    EXPECT_THROW(readDaemonConfig(folder_.path()), InputError);
}

}  // namespace
}  // namespace curvewall
