#include "server/render_api.h"

#include "calibration/errors.h"
#include "tests/server/small_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <numbers>
#include <random>
#include <string>

namespace curvewall {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;

constexpr uint64_t kMaxSamplesPerFrame = 1'000'000;

RenderCall decode(std::string_view body) {
    static const Library library = smallLibrary();
    return decodeRenderCall(body, library, kMaxSamplesPerFrame);
}

// The smallest body there is, with the members of `more` on top.
std::string bodyWith(const json& more) {
    json body{{"wall", "small"}, {"scene", "city"}};
    body.update(more);
    return body.dump();
}

TEST(RenderApi, OnlyWallAndSceneAreNeeded) {
    const RenderCall call = decode(bodyWith(json::object()));
    EXPECT_EQ(call.scene, "city");
    EXPECT_FALSE(call.cameraGiven);
    EXPECT_EQ(call.format, ImageFormat::png);
    const RenderRequest& request = call.request;
    EXPECT_EQ(request.wall->displays.size(), 2U);
    EXPECT_EQ(request.display, "");
    EXPECT_FALSE(request.eyeM);
    EXPECT_EQ(request.method, Method::piecewise);
    EXPECT_EQ(request.tolerancePx, kDefaultTolerancePx);
    EXPECT_EQ(request.faceSizePx, 0);
    EXPECT_EQ(request.source, SourceKind::cube);
    EXPECT_EQ(request.filter, SourceFilter::linear);
    EXPECT_EQ(request.facePass, FacePass::separate);
    EXPECT_EQ(request.lookup, SourceLookup::pixel);
    EXPECT_EQ(request.meshStepPx, kDefaultMeshStepPx);
    EXPECT_EQ(request.samples, 1);
    EXPECT_EQ(request.style, Style::textured);
    EXPECT_EQ(request.output, OutputKind::color);
    EXPECT_FALSE(request.linearOutput);
    EXPECT_EQ(request.frames, 1);
}

TEST(RenderApi, EveryFieldIsTaken) {
    const RenderCall call = decode(R"({
        "wall": "small", "display": "right", "scene": "model",
        "camera": {"position": [1, -2.5, 3e3], "yaw_deg": 90, "pitch_deg": -45, "roll_deg": 180},
        "eye": [0.5, -1, 2],
        "method": "image-based", "engine": "tessellation", "tolerance_px": 0.5, "source": "planar",
        "filter": "bicubic", "faces": "layered", "lookup": "mesh", "mesh_step_px": 32, "face_size": 64, "samples": 4, "anisotropy": 8,
        "style": "unlit", "output_kind": "position", "format": "exr"})");
    EXPECT_EQ(call.scene, "/scenes/model.glb");
    EXPECT_TRUE(call.cameraGiven);
    EXPECT_EQ(call.format, ImageFormat::exr);
    const RenderRequest& request = call.request;
    EXPECT_EQ(request.display, "right");
    EXPECT_EQ(request.camera.positionM, glm::dvec3(1, -2.5, 3000));
    EXPECT_DOUBLE_EQ(request.camera.orientation.yawRad, std::numbers::pi / 2);
    EXPECT_DOUBLE_EQ(request.camera.orientation.pitchRad, -std::numbers::pi / 4);
    EXPECT_DOUBLE_EQ(request.camera.orientation.rollRad, std::numbers::pi);
    EXPECT_EQ(request.eyeM, glm::dvec3(0.5, -1, 2));
    EXPECT_EQ(request.method, Method::imageBased);
    EXPECT_EQ(request.tolerancePx, 0.5);
    EXPECT_EQ(request.faceSizePx, 64);
    EXPECT_EQ(request.source, SourceKind::planar);
    EXPECT_EQ(request.filter, SourceFilter::bicubic);
    EXPECT_EQ(request.facePass, FacePass::layered);
    EXPECT_EQ(request.lookup, SourceLookup::mesh);
    EXPECT_EQ(request.meshStepPx, 32);
    EXPECT_EQ(request.engine, Engine::tessellation);
    EXPECT_EQ(request.anisotropy, 8);
    EXPECT_EQ(request.samples, 4);
    EXPECT_EQ(request.style, Style::unlit);
    EXPECT_EQ(request.output, OutputKind::position);
    EXPECT_TRUE(request.linearOutput);
}

TEST(RenderApi, AnglesThatAreNotGivenAreZero) {
    const RenderCall call = decode(bodyWith({{"camera", {{"position", {1, 2, 3}}}}}));
    EXPECT_EQ(call.request.camera, (Camera{{1, 2, 3}, {}}));
}

TEST(RenderApi, OutputsThatAreNotColorComeAsExrUnlessAsked) {
    EXPECT_EQ(decode(bodyWith({{"output_kind", "depth"}})).format, ImageFormat::exr);
    EXPECT_EQ(decode(bodyWith({{"format", "jpeg"}})).format, ImageFormat::jpeg);
    EXPECT_TRUE(decode(bodyWith({{"format", "exr"}})).request.linearOutput);
}

struct Mistake {
    json members;
    std::string message;
};

void PrintTo(const Mistake& mistake, std::ostream* stream) { *stream << mistake.members; }

class MalformedField : public ::testing::TestWithParam<Mistake> {};

TEST_P(MalformedField, IsNamed) {
    try {
        decode(bodyWith(GetParam().members));
        FAIL() << "was accepted";
    } catch (const MalformedRequest& error) {
        EXPECT_EQ(error.what(), GetParam().message);
    }
}

INSTANTIATE_TEST_SUITE_P(
    RenderApi, MalformedField,
    ::testing::Values(
        Mistake{{{"wall", 1}}, "wall: expected a string, found 1"},
        Mistake{{{"scene", nullptr}}, "scene: expected a string, found null"},
        Mistake{{{"display", true}}, "display: expected a string, found true"},
        Mistake{{{"camera", "here"}}, R"(camera: expected an object, found "here")"},
        Mistake{{{"camera", json::object()}}, "camera.position: expected a value, found nothing"},
        Mistake{{{"camera", {{"position", {1, 2}}}}},
                "camera.position: expected a list of 3 numbers, found a list of 2"},
        Mistake{{{"camera", {{"position", {1, 2, "3"}}}}},
                R"(camera.position[2]: expected a number, found "3")"},
        Mistake{{{"camera", {{"position", {1, 2, 3}}, {"yaw_deg", "abc"}}}},
                R"(camera.yaw_deg: expected a number, found "abc")"},
        Mistake{{{"camera", {{"position", {1, 2, 3}}, {"pitch_deg", json::array()}}}},
                "camera.pitch_deg: expected a number, found a list"},
        Mistake{{{"camera", {{"position", {1, 2, 3}}, {"roll_deg", nullptr}}}},
                "camera.roll_deg: expected a number, found null"},
        Mistake{
            {{"camera", {{"position", {1, 2, 3}}, {"yaw", 1}}}},
            R"(camera: expected only the keys position, yaw_deg, pitch_deg, roll_deg, found the key "yaw")"},
        Mistake{{{"eye", {1, 2}}}, "eye: expected a list of 3 numbers, found a list of 2"},
        Mistake{{{"eye", {0, "x", 0}}}, R"(eye[1]: expected a number, found "x")"},
        Mistake{{{"method", 3}}, "method: expected a string, found 3"},
        Mistake{{{"engine", json::object()}}, "engine: expected a string, found an object"},
        Mistake{{{"tolerance_px", "0.25"}}, R"(tolerance_px: expected a number, found "0.25")"},
        Mistake{{{"source", 6}}, "source: expected a string, found 6"},
        Mistake{{{"filter", json::array()}}, "filter: expected a string, found a list"},
        Mistake{{{"face_size", 99.5}}, "face_size: expected a whole number, found 99.5"},
        Mistake{{{"samples", "4"}}, R"(samples: expected a whole number, found "4")"},
        Mistake{{{"style", false}}, "style: expected a string, found false"},
        Mistake{{{"output_kind", 0}}, "output_kind: expected a string, found 0"},
        Mistake{{{"format", json::array()}}, "format: expected a string, found a list"},
        Mistake{{{"frames", 2}},
                "expected only the keys wall, scene, display, camera, eye, method, engine, tolerance_px, "
                "tessellation_px, source, filter, faces, lookup, mesh_step_px, face_size, bounds, samples, "
                "anisotropy, style, output_kind, format, found the key \"frames\""}));

class ImpossibleField : public ::testing::TestWithParam<Mistake> {};

TEST_P(ImpossibleField, IsNamed) {
    try {
        decode(bodyWith(GetParam().members));
        FAIL() << "was accepted";
    } catch (const UsageError& error) {
        EXPECT_THAT(error.what(), HasSubstr(GetParam().message));
    }
}

INSTANTIATE_TEST_SUITE_P(
    RenderApi, ImpossibleField,
    ::testing::Values(
        Mistake{{{"wall", "huge"}}, R"(wall: expected one that GET /v1/walls lists, found "huge")"},
        Mistake{{{"wall", "../small"}}, "wall: expected"},
        Mistake{{{"scene", "model.glb"}}, "scene: expected"},
        Mistake{{{"scene", "city:1001"}}, "scene: expected a city of at most 1000 triangles"},
        Mistake{{{"display", "middle"}}, "left"}, Mistake{{{"display", ""}}, "display: expected"},
        Mistake{{{"camera", {{"position", {1e13, 0, 0}}}}}, "camera.position[0]: expected a number from"},
        Mistake{{{"camera", {{"position", {0, 0, 0}}, {"yaw_deg", 1e7}}}},
                "camera.yaw_deg: expected a number from"},
        Mistake{{{"eye", {0, 0, 1e8}}}, "eye[2]: expected a number from"},
        Mistake{{{"method", "magic"}},
                "method: expected piecewise, image-based, bounded-raycast, vertex-warp, reference or auto, "
                "found \"magic\""},
        Mistake{{{"bounds", "circle"}}, R"(bounds: expected triangle, quad or generic-quad, found "circle")"},
        Mistake{{{"tessellation_px", -1}}, "tessellation_px: expected"},
        Mistake{{{"engine", "steam"}},
                R"(engine: expected compute, geometry, tessellation or loop, found "steam")"},
        Mistake{{{"anisotropy", 17}}, "anisotropy: expected a whole number from 1 to 16, found 17"},
        Mistake{{{"tolerance_px", 0}}, "tolerance_px: expected a number from 0.001 to 100, found 0"},
        Mistake{{{"tolerance_px", 100.1}}, "tolerance_px: expected"},
        Mistake{{{"tolerance_px", -1}}, "tolerance_px: expected"},
        Mistake{{{"source", "sphere"}}, R"(source: expected cube, hemicube or planar, found "sphere")"},
        Mistake{{{"filter", "cubic"}},
                R"(filter: expected nearest, linear, bicubic, mipmap or anisotropic, found "cubic")"},
        Mistake{{{"faces", "six"}}, R"(faces: expected separate or layered, found "six")"},
        Mistake{{{"lookup", "table"}}, R"(lookup: expected pixel or mesh, found "table")"},
        Mistake{{{"mesh_step_px", 3}}, "mesh_step_px: expected"},
        Mistake{{{"face_size", -1}}, "face_size: expected"},
        Mistake{{{"face_size", 15}}, "face_size: expected"},
        Mistake{{{"face_size", 8193}}, "face_size: expected"}, Mistake{{{"samples", 0}}, "samples: expected"},
        Mistake{{{"samples", 4097}}, "samples: expected a whole number from 1 to 4096, found 4097"},
        Mistake{{{"samples", 1e30}}, "samples: expected"},
        Mistake{{{"style", "cubist"}},
                R"(style: expected textured, unlit, wireframe or pen-and-ink, found "cubist")"},
        Mistake{{{"output_kind", "colour"}}, "output_kind: expected color, depth, coverage or position"},
        Mistake{{{"format", "gif"}}, R"(format: expected png, jpeg or exr, found "gif")"},
        Mistake{{{"output_kind", "depth"}, {"format", "png"}}, "format: expected exr for output_kind depth"},
        Mistake{{{"output_kind", "coverage"}, {"format", "jpeg"}}, "format: expected exr"}));

TEST(RenderApi, WallAndSceneMustBeGiven) {
    EXPECT_THROW(decode(R"({"scene": "city"})"), MalformedRequest);
    EXPECT_THROW(decode(R"({"wall": "small"})"), MalformedRequest);
    EXPECT_THROW(decode(""), MalformedRequest);
    EXPECT_THROW(decode("[]"), MalformedRequest);
}

// 100 x 50 pixels; the limit is a million samples.
TEST(RenderApi, OneFrameCostsNoMoreThanAllowed) {
    EXPECT_NO_THROW(decode(bodyWith({{"method", "reference"}, {"samples", 200}})));
    EXPECT_THROW(decode(bodyWith({{"method", "reference"}, {"samples", 201}})), UsageError);
    EXPECT_NO_THROW(decode(bodyWith({{"method", "image-based"}, {"face_size", 408}})));
    EXPECT_THROW(decode(bodyWith({{"method", "image-based"}, {"face_size", 409}})), UsageError);
    json planar{{"method", "image-based"}, {"source", "planar"}, {"face_size", 1000}};
    EXPECT_NO_THROW(decode(bodyWith(planar)));
    planar["samples"] = 2;
    EXPECT_THROW(decode(bodyWith(planar)), UsageError);
    EXPECT_THROW(decode(bodyWith({{"method", "image-based"}, {"face_size", 8192}, {"samples", 4096}})),
                 UsageError);
}

// Whatever the bytes: decoded, malformed or impossible, and nothing else.
void expectNoSurprise(const std::string& body) {
    try {
        decode(body);
    } catch (const MalformedRequest& error) {
        EXPECT_NO_THROW(problem(400, error.what()));
    } catch (const UsageError& error) {
        EXPECT_NO_THROW(problem(422, error.what()));
    }
}

TEST(RenderApi, RandomBytesAreRefused) {
    std::mt19937 random(1);
    for (int i = 0; i < 2000; ++i) {
        std::string body(random() % 200, ' ');
        for (char& c : body) c = static_cast<char>(random());
        expectNoSurprise(body);
    }
}

TEST(RenderApi, DamagedRequestsAreDecodedOrRefused) {
    const std::string good = bodyWith({{"camera", {{"position", {1, 2, 3}}, {"yaw_deg", 30}}},
                                       {"method", "piecewise"},
                                       {"tolerance_px", 0.25},
                                       {"samples", 4},
                                       {"format", "png"}});
    constexpr std::string_view kAlphabet = "{}[]\",:0123456789eE+-. \\untrfalse\xff\xc3";
    std::mt19937 random(2);
    for (int i = 0; i < 20'000; ++i) {
        std::string body = good;
        for (unsigned edits = 1 + random() % 4; edits > 0; --edits) {
            const size_t at = random() % body.size();
            const char c = kAlphabet[random() % kAlphabet.size()];
            switch (random() % 3) {
                case 0:
                    body[at] = c;
                    break;
                case 1:
                    body.insert(at, 1, c);
                    break;
                default:
                    body.erase(at, 1 + random() % 5);
                    break;
            }
            if (body.empty()) body = "{";
        }
        expectNoSurprise(body);
    }
}

TEST(RenderApi, AnImageCarriesItsTimesAndStats) {
    RenderedImage image;
    image.bytes = std::string("\0\xff", 2);
    image.format = ImageFormat::jpeg;
    image.statsJson = R"({"pieces":3})";
    image.queueTime = Milliseconds(1.5);
    image.renderTime = Milliseconds(20);
    image.encodeTime = Milliseconds(0.25);
    const Answer answer = answerTo(image);
    EXPECT_EQ(answer.status, 200U);
    EXPECT_EQ(answer.contentType, "image/jpeg");
    EXPECT_EQ(answer.body, image.bytes);
    EXPECT_THAT(
        answer.headers,
        UnorderedElementsAre(Pair("Server-Timing", "queue;dur=1.500, render;dur=20.000, encode;dur=0.250"),
                             Pair("Curvewall-Stats", R"({"pieces":3})")));
}

TEST(RenderApi, ARefusalSaysWhenToTryAgain) {
    const Answer answer = answerTo(Refusal{Refusal::Reason::full, std::chrono::seconds(7)});
    EXPECT_EQ(answer.status, 503U);
    EXPECT_THAT(answer.headers, UnorderedElementsAre(Pair("Retry-After", "7")));
}

TEST(RenderApi, WhatTheRendererThrowsBecomesAProblem) {
    EXPECT_EQ(answerTo(std::make_exception_ptr(UsageError("too many samples"))).status, 422U);
    EXPECT_EQ(answerTo(std::make_exception_ptr(InputError("a.glb", "", "a scene", "junk"))).status, 500U);
    EXPECT_EQ(answerTo(std::make_exception_ptr(std::bad_alloc())).status, 500U);
    EXPECT_EQ(answerTo(std::make_exception_ptr(1)).status, 500U);
}

TEST(Problem, IsProblemJson) {
    const Answer answer = problem(422, "samples: expected \"less\"");
    EXPECT_EQ(answer.status, 422U);
    EXPECT_EQ(answer.contentType, "application/problem+json");
    EXPECT_EQ(json::parse(answer.body), (json{{"type", "about:blank"},
                                              {"title", "Unprocessable Content"},
                                              {"status", 422},
                                              {"detail", "samples: expected \"less\""}}));
}

TEST(Problem, TakesBytesThatAreNotText) { EXPECT_TRUE(json::accept(problem(400, "\xff\xfe\x01\n").body)); }

}  // namespace
}  // namespace curvewall
