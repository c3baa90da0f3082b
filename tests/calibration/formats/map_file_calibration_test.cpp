#include "calibration/formats/map_file_calibration.h"

#include "calibration/errors.h"
#include "calibration/formats/map_calibration.h"
#include "calibration/formats/map_decisions.h"
#include "calibration/projections/frustum.h"
#include "tests/support/map_writer.h"
#include "tests/support/random_numbers.h"
#include "tests/support/sample_paths.h"
#include "tests/support/temporary_folder.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

namespace curvewall {
namespace {

Wall read(const FileBytes& file, const CalibrationRequest& request,
          const nlohmann::json& assume = nlohmann::json::object()) {
    Decisions decisions(assume);
    Wall wall = readMapFile(file, filesBeside(file.path), request, decisions);
    decisions.refuseUnusedKeys();
    return wall;
}

std::string valueOf(const Display& display, const std::string& key) {
    const auto found = std::ranges::find(display.assumptions, key, &Assumption::key);
    return found == display.assumptions.end() ? "nothing" : found->value;
}

SourcePicture frustumPicture(const Frustum& frustum) {
    return {glm::dvec2(1), std::make_shared<FrustumProjection>(frustum, glm::dvec2(1))};
}

double angleBetween(glm::dvec3 a, glm::dvec3 b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Evans & Sutherland's map of 2024 with the view that its configuration names: a tile of a dome. Which way up
// it is can be seen: nothing of a dome lies far below the horizon, and the tile's bottom lies on it.
TEST(MapSamples, TheAbsoluteMapOf2024IsATileOfADome) {
    const auto path = test::samplesFolder() / "sgct-master" / "surface1.pfm";
    if (!std::filesystem::is_regular_file(path))
        GTEST_SKIP() << "no sgct-master/surface1.pfm in CURVEWALL_SAMPLES (" << test::samplesFolder() << ")";
    const double across = glm::radians(77.821993), upwards = glm::radians(78.435992);
    CalibrationRequest request{.sizePx = glm::ivec2(768, 810)};
    request.source =
        frustumPicture({-across,
                        across,
                        -upwards,
                        upwards,
                        {glm::radians(301.504967), glm::radians(40.615664), glm::radians(-47.675061)}});
    const FileBytes file = readFile(path.string(), "a sample");
    const Display display = read(file, request).displays.at(0);
    EXPECT_EQ(valueOf(display, "map_kind"), "inverse");
    EXPECT_EQ(valueOf(display, "map_values"), "absolute");
    EXPECT_EQ(valueOf(display, "row_order"), "top_first");
    EXPECT_EQ(valueOf(display, "source_v"), "up");
    const auto elevationDeg = [](const Display& d, double x, double y) {
        const glm::dvec3 ray = glm::normalize(*d.projection->unproject({x, y}));
        return glm::degrees(std::asin(ray.y));
    };
    for (double x = 1; x < 768; x += 50) {
        EXPECT_NEAR(elevationDeg(display, x, 809), 0, 15);
        EXPECT_GT(elevationDeg(display, x, 1), 15);
    }
    // The other coherent reading, of the MPCDI documents, turns the tile over: it would light the floor.
    const Display other = read(file, request, {{"source_v", "down"}}).displays.at(0);
    EXPECT_EQ(valueOf(other, "row_order"), "bottom_first");
    EXPECT_LT(elevationDeg(other, 1, 809), -30);
}

TEST(MapSamples, DomeMapsOfTwoEyesAreForward) {
    const auto folder = test::samplesFolder() / "sgct-dome-2020" / "config" / "dome" / "pfm" / "256_128";
    if (!std::filesystem::is_directory(folder))
        GTEST_SKIP() << "no sgct-dome-2020 in CURVEWALL_SAMPLES (" << test::samplesFolder() << ")";
    const double side = glm::radians(45.0);
    CalibrationRequest request{.sizePx = glm::ivec2(2560, 1600)};
    request.source = frustumPicture({-side, side, -side, side, {}});
    for (int channel = 1; channel <= 6; ++channel) {
        const auto path = folder / ("channel" + std::to_string(channel) + "_warp.pfm");
        const FileBytes file = readFile(path.string(), "a sample");
        const Display display = read(file, request).displays.at(0);
        EXPECT_EQ(valueOf(display, "stereo_half"), "left");
        EXPECT_EQ(valueOf(display, "map_kind"), "forward");
        EXPECT_EQ(valueOf(display, "row_order"), "top_first");
        // The first number of the file: where the centre of the picture's first cell, at its top left, lands.
        float first[2];
        std::memcpy(first, file.bytes.data() + file.bytes.size() - 256 * 128 * 12, sizeof first);
        EXPECT_NEAR(first[1], 0.952f, 1e-3);
        const glm::dvec2 inside(1e-3, 1e-3);  // the corner of the mesh itself may round to its outside
        const auto ray =
            display.projection->unproject(glm::dvec2(2560.0 * first[0], 1600.0 * (1 - first[1])) + inside);
        ASSERT_TRUE(ray);
        EXPECT_LT(angleBetween(*ray, {1.0 / 128 - 1, 1 - 1.0 / 128, -1}), 1e-4);
    }
}

TEST(MapFile, ExrMapsBeginWithTheTopRow) {
    const test::TemporaryFolder folder;
    const std::string path = folder.path("map.exr");
    test::writeMap(path, {{2, 2}, 3, false, {0.1f, 0.2f, 0, 0.9f, 0.2f, 0, 0.1f, 0.6f, 0, 0.9f, 0.6f, 0}});
    const double side = glm::radians(45.0);
    CalibrationRequest request{.sizePx = glm::ivec2(100, 100)};
    request.source = frustumPicture({-side, side, -side, side, {}});
    const Display display = read(readFile(path, "a map"), request).displays.at(0);
    EXPECT_EQ(valueOf(display, "row_order"), "top_first");
    EXPECT_EQ(valueOf(display, "source_v"), "down");
    EXPECT_LT(angleBetween(*display.projection->unproject({0, 0}), {0.2 - 1, 1 - 0.4, -1}), 1e-6);
    EXPECT_LT(angleBetween(*display.projection->unproject({100, 100}), {1.8 - 1, 1 - 1.2, -1}), 1e-6);
}

TEST(MapFile, LargeMapsHaveANodeForEveryPixel) {
    NumberMap map{{640, 480}, 3, false, {}};
    for (int y = 0; y < 480; ++y)
        for (int x = 0; x < 640; ++x)
            map.values.insert(map.values.end(),
                              {static_cast<float>(x) / 640, static_cast<float>(y) / 480, 0});
    const Display display = read({"a.pfm", test::pfmBytes(map)}, {}).displays.at(0);
    EXPECT_EQ(display.sizePx, glm::ivec2(640, 480));
    EXPECT_EQ(valueOf(display, "width_px"), "640");
    EXPECT_EQ(valueOf(display, "node_alignment"), "centers");
}

// One picture, bent by the same function in every way that a map can be written.
struct Bend {
    double k;  // of the radius' square
    glm::dvec2 operator()(glm::dvec2 place) const {
        const glm::dvec2 c = place - 0.5;
        return 0.5 + 0.8 * c * (1 + k * glm::dot(c, c));
    }
};

TEST(MapCalibration, EveryWayOfWritingAMapMeansTheSame) {
    test::Random random(17);
    const glm::ivec2 nodes(33, 25), sizePx(320, 240);
    const double side = glm::radians(40.0);
    const SourcePicture source = frustumPicture({-side, side, -side, side, {}});
    const Bend bend{0.3};
    for (const Alignment alignment : {Alignment::centers, Alignment::corners})
        for (const bool bottomRowFirst : {false, true})
            for (const bool yUp : {false, true})
                for (const bool isOffset : {false, true}) {
                    NumberMap map{nodes, 2, false, {}};
                    for (int row = 0; row < nodes.y; ++row)
                        for (int x = 0; x < nodes.x; ++x) {
                            const glm::dvec2 index(x, bottomRowFirst ? nodes.y - 1 - row : row);
                            const glm::dvec2 place = alignment == Alignment::centers
                                                         ? (index + 0.5) / glm::dvec2(nodes)
                                                         : index / glm::dvec2(nodes - 1);
                            glm::dvec2 value = bend(place);
                            if (isOffset) value -= place;
                            if (yUp) value.y = isOffset ? -value.y : 1 - value.y;
                            map.values.insert(map.values.end(),
                                              {static_cast<float>(value.x), static_cast<float>(value.y)});
                        }
                    MapMeaning meaning;
                    meaning.alignment = alignment;
                    meaning.bottomRowFirst = bottomRowFirst;
                    meaning.yUp = yUp;
                    meaning.isOffset = isOffset;
                    const ProjectionPtr inverse = projectionOfMap(map, meaning, sizePx, source, "map");
                    meaning.direction = MapDirection::forward;
                    meaning.cells = quadrilateralsOfGrid(nodes);
                    const ProjectionPtr forward = projectionOfMap(map, meaning, sizePx, source, "map");
                    for (int i = 0; i < 20; ++i) {
                        const glm::dvec2 place = 0.1 + 0.8 * random.pixel({1, 1});
                        const auto shown = inverse->unproject(place * glm::dvec2(sizePx));
                        const auto truth = source.projection->unproject(bend(place));
                        ASSERT_TRUE(shown);
                        // Bilinear cells follow the bend to a few hundred thousandths.
                        EXPECT_LT(angleBetween(*shown, *truth), 1e-3);
                        const auto landed = forward->unproject(bend(place) * glm::dvec2(sizePx));
                        ASSERT_TRUE(landed);
                        EXPECT_LT(angleBetween(*landed, *source.projection->unproject(place)), 1e-3);
                    }
                }
}

TEST(MapSurvey, OffsetsAndPositionsAreToldApart) {
    const auto looks = [](std::vector<float> values) {
        return looksLikeOffsets(
            surveyMap({{2, static_cast<int>(values.size()) / 4}, 2, false, values}, true));
    };
    EXPECT_TRUE(looks({0, 0, 0, 0, 0, 0, 0, 0}));
    EXPECT_TRUE(looks({-0.22f, 0.16f, 0.17f, -0.27f, 0, 0.1f, 0.01f, -0.1f}));
    EXPECT_FALSE(looks({0.24f, 0.99f, 0.61f, 0.65f, 0.29f, 0.5f, 0.64f, 0.19f}));
    EXPECT_FALSE(looks({0, 0, 1, 0, 0, 1, 1, 1}));
    EXPECT_FALSE(looks({-0.02f, -0.02f, 1.02f, 0, 0, 1, 1, 1})) << "a little beyond the picture";
}

}  // namespace
}  // namespace curvewall
