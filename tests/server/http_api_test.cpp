#include "server/http_api.h"

#include "tests/server/small_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <future>

namespace curvewall {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::Pair;

class HttpApiTest : public ::testing::Test {
protected:
    Answer answerWith(const std::string& token, const Call& call) {
        const HttpApi api(library_, fits_, {.token = token});
        std::promise<Answer> promise;
        api.answer(call, {}, [&promise](Answer answer) { promise.set_value(std::move(answer)); });
        return promise.get_future().get();
    }
    Answer answer(const Call& call) { return answerWith("", call); }

    Library library_ = smallLibrary();
    RenderQueue queue_{{}, []() -> RenderFunction {
                           return [](const RenderCall& call) {
                               RenderedImage image;
                               image.bytes = call.scene;
                               return image;
                           };
                       }};
    FitQueue fits_{{},
                   queue_,
                   [](const auto&...) { return FittedPieces{}; },
                   [](const FittedPieces& before, const auto&...) { return before; }};
};

TEST_F(HttpApiTest, ListsWallsAndScenes) {
    EXPECT_EQ(json::parse(answer({"GET", "/v1/walls", "", "", ""}).body), (json{{"walls", {"small"}}}));
    EXPECT_EQ(json::parse(answer({"GET", "/v1/scenes?x=1", "", "", ""}).body),
              (json{{"scenes", {"city", "room", "model"}}}));
}

TEST_F(HttpApiTest, RendersWithOrWithoutAContentType) {
    const std::string body = R"({"wall": "small", "scene": "room"})";
    for (const char* type :
         {"", "application/json", "Application/JSON; charset=utf-8", "application/json ;charset=utf-8"}) {
        const Answer image = answer({"POST", "/v1/render", type, "", body});
        EXPECT_EQ(image.status, 200U) << type;
        EXPECT_EQ(image.body, "room");
    }
    for (const char* type : {"text/plain", "application/x-www-form-urlencoded", "application/jsonp", ";"})
        EXPECT_EQ(answer({"POST", "/v1/render", type, "", body}).status,
                  std::string(type) == ";" ? 200U : 415U)
            << type;
}

TEST_F(HttpApiTest, PathsAreExact) {
    for (const char* path :
         {"/", "/v1", "/v1/", "/v1/renders", "/v1/render/", "//v1/render", "/v1/walls/small", "*", "",
          "/V1/walls", "http://host", "http://host/none", "/healthz/../v1/walls"})
        EXPECT_EQ(answer({"GET", path, "", "", ""}).status, 404U) << path;
    EXPECT_EQ(answer({"GET", "http://host:8650/healthz", "", "", ""}).status, 200U);
}

TEST_F(HttpApiTest, WrongMethodsLearnTheRightOnes) {
    for (const char* method : {"GET", "HEAD", "PUT", "DELETE", "OPTIONS", "BREW"}) {
        const Answer refusal = answer({method, "/v1/render", "", "", ""});
        EXPECT_EQ(refusal.status, 405U) << method;
        EXPECT_THAT(refusal.headers, Contains(Pair("Allow", "POST")));
    }
    for (const char* path : {"/v1/walls", "/v1/scenes", "/healthz"}) {
        const Answer refusal = answer({"POST", path, "", "", ""});
        EXPECT_EQ(refusal.status, 405U) << path;
        EXPECT_THAT(refusal.headers, Contains(Pair("Allow", "GET, HEAD")));
        EXPECT_EQ(answer({"HEAD", path, "", "", ""}).status, 200U);
    }
}

TEST_F(HttpApiTest, AskForATokenEverywhereButAtTheProbe) {
    for (const char* given : {"", "Bearer", "Bearer ", "Bearer s3cre", "Bearer s3cret ", "Bearer x3cret",
                              "Bearer s3crex", "Basic s3cret", "s3cret", "Bearers3cret", "Bearer s3cretx"})
        for (const char* path : {"/v1/walls", "/v1/render", "/none"}) {
            const Answer refusal = answerWith("s3cret", {"GET", path, "", given, ""});
            EXPECT_EQ(refusal.status, 401U) << path << ' ' << given;
            EXPECT_THAT(refusal.headers, Contains(Pair("WWW-Authenticate", "Bearer")));
        }
    EXPECT_EQ(answerWith("s3cret", {"GET", "/v1/walls", "", "Bearer s3cret", ""}).status, 200U);
    EXPECT_EQ(answerWith("s3cret", {"GET", "/v1/walls", "", "bearer s3cret", ""}).status, 200U);
    EXPECT_EQ(answerWith("s3cret", {"GET", "/healthz", "", "", ""}).status, 200U);
}

TEST_F(HttpApiTest, TellsMalformedFromImpossible) {
    EXPECT_EQ(answer({"POST", "/v1/render", "", "", "{"}).status, 400U);
    EXPECT_EQ(answer({"POST", "/v1/render", "", "", R"({"wall": "none", "scene": "room"})"}).status, 422U);
}

}  // namespace
}  // namespace curvewall
