#include "calibration/formats/mpcdi_file.h"

#include "calibration/errors.h"
#include "calibration/files/pfm_file.h"
#include "calibration/files/zip_archive.h"
#include "calibration/formats/blend_files.h"
#include "calibration/formats/texel_budget.h"
#include "tests/support/map_writer.h"
#include "tests/support/sample_paths.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <random>
#include <string>

namespace curvewall {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Files = std::map<std::string, std::string>;

FindFile findIn(const Files& files) {
    return [files](const std::string& name) -> std::optional<FileBytes> {
        const auto found = files.find(name);
        if (found == files.end()) return std::nullopt;
        return FileBytes{found->first, found->second};
    };
}

Wall read(const FileBytes& file, const FindFile& find = findIn({}),
          const nlohmann::json& assume = nlohmann::json::object()) {
    Decisions decisions(assume);
    Wall wall = readMpcdi(file, find, {}, decisions);
    decisions.refuseUnusedKeys();
    return wall;
}

std::string valueOf(const Display& display, const std::string& key) {
    const auto found = std::ranges::find(display.assumptions, key, &Assumption::key);
    return found == display.assumptions.end() ? "nothing" : found->value;
}

FileBytes sample(const char* name) { return readFile((test::samplesFolder() / name).string(), "a sample"); }

bool hasSample(const char* name) { return fs::is_regular_file(test::samplesFolder() / name); }

#define NEED_SAMPLE(NAME) \
    if (!hasSample(NAME)) GTEST_SKIP() << "no " NAME " in CURVEWALL_SAMPLES (" << test::samplesFolder() << ")"

// The frustum of both samples of 2017, by the formula of the format's documents.
glm::dvec3 frustumRay(double u, double v) {
    const double across = std::tan(glm::radians(33.2315521)), upwards = std::tan(glm::radians(34.6443944));
    const glm::dvec3 inView((2 * u - 1) * across, (1 - 2 * v) * upwards, -1);
    const double yaw = glm::radians(326.675157), pitch = glm::radians(27.327616),
                 roll = glm::radians(-14.611227);
    const auto about = [](glm::dvec3 v3, int a, int b, double angle) {
        glm::dvec3 turned = v3;
        turned[a] = std::cos(angle) * v3[a] - std::sin(angle) * v3[b];
        turned[b] = std::sin(angle) * v3[a] + std::cos(angle) * v3[b];
        return turned;
    };
    // Clockwise about the view, then up, then to the right.
    return about(about(about(inView, 0, 1, -roll), 1, 2, pitch), 0, 2, yaw);
}

double angleBetween(glm::dvec3 a, glm::dvec3 b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

TEST(MpcdiSamples, NoOffsetsLeaveTheFrustum) {
    NEED_SAMPLE("sgct-history/zero_distortion_mesh.mpcdi");
    const Wall wall = read(sample("sgct-history/zero_distortion_mesh.mpcdi"));
    ASSERT_EQ(wall.displays.size(), 1u);
    const Display& display = wall.displays[0];
    EXPECT_EQ(display.name, "surface1_region");
    EXPECT_EQ(display.sizePx, glm::ivec2(512, 540));
    EXPECT_EQ(valueOf(display, "map_values"), "offset");
    EXPECT_FALSE(display.blend) << "its alphaMap is empty";
    for (double v = 0.01; v < 1; v += 0.07)
        for (double u = 0.01; u < 1; u += 0.07) {
            const auto ray = display.projection->unproject({512 * u, 540 * v});
            ASSERT_TRUE(ray);
            EXPECT_LT(angleBetween(*ray, frustumRay(u, v)), 1e-7);
        }
}

TEST(MpcdiSamples, OffsetsMoveTheNodesOfTheFrustum) {
    NEED_SAMPLE("sgct-history/correction_mesh.mpcdi");
    const FileBytes file = sample("sgct-history/correction_mesh.mpcdi");
    const FileBytes pfm = *ZipArchive(file).files()("surface1.pfm");
    const Display display = read(file).displays.at(0);
    EXPECT_EQ(valueOf(display, "map_values"), "offset");
    EXPECT_EQ(valueOf(display, "map_direction"), "forward");
    EXPECT_EQ(valueOf(display, "row_order"), "top_first");
    EXPECT_EQ(valueOf(display, "node_alignment"), "corners");

    const std::string_view numbers = std::string_view(pfm.bytes).substr(pfm.bytes.size() - 32 * 32 * 12);
    const auto node = [&](int column, int row) {
        glm::vec3 value;
        std::memcpy(&value, numbers.data() + (row * 32 + column) * 12, 12);
        return value;
    };
    EXPECT_NEAR(node(0, 0).x, -0.10462f, 1e-5);
    EXPECT_NEAR(node(31, 31).y, 0.00665f, 1e-5);
    int onScreen = 0;
    for (int row = 1; row < 31; ++row)
        for (int column = 1; column < 31; ++column) {
            const glm::vec3 offset = node(column, row);
            const double x = column / 31.0 + offset.x, yUp = 1 - row / 31.0 + offset.y;
            const glm::dvec2 px(512 * x, 540 * (1 - yUp));
            if (px.x < 0 || px.y < 0 || px.x > 512 || px.y > 540) continue;
            ++onScreen;
            // The mesh does not fold, so that a position shows one place.
            const auto ray = display.projection->unproject(px);
            ASSERT_TRUE(ray);
            EXPECT_LT(angleBetween(*ray, frustumRay(column / 31.0, row / 31.0)), 1e-6)
                << column << " " << row;
        }
    EXPECT_GT(onScreen, 500);
}

TEST(MpcdiSamples, TheManifestOfSixProjectorsHasSixDisplays) {
    NEED_SAMPLE("mpcdi-momentfactory/Cube-mapping.mpcdi.xml");
    const Wall wall = read(sample("mpcdi-momentfactory/Cube-mapping.mpcdi.xml"));
    const std::map<std::string, glm::dvec3> ahead{{"Rear", {0, 0, -1}}, {"Front", {0, 0, 1}},
                                                  {"Left", {-1, 0, 0}}, {"Right", {1, 0, 0}},
                                                  {"Top", {0, -1, 0}},  {"Bottom", {0, 1, 0}}};
    ASSERT_EQ(wall.displays.size(), ahead.size());
    for (const Display& display : wall.displays) {
        EXPECT_EQ(display.sizePx, glm::ivec2(1920, 1080));
        EXPECT_LT(angleBetween(*display.projection->unproject({960, 540}), ahead.at(display.name)), 1e-6);
        EXPECT_THAT(display.warnings, Contains(HasSubstr("is left out")));
    }
}

std::string manifest(const std::string& files) {
    return "<MPCDI profile='3d' version='2.0'><display><buffer id='b'><region id='r' xResolution='4' "
           "yResolution='2'><frustum><rightAngle>30</rightAngle><leftAngle>-30</leftAngle><upAngle>20</"
           "upAngle>"
           "<downAngle>-20</downAngle></frustum></region></buffer></display><files><fileset region='r'>" +
           files + "</fileset></files></MPCDI>";
}

NumberMap greys(glm::ivec2 sizePx, std::vector<float> values) {
    return {sizePx, 1, false, std::move(values)};
}

TEST(MpcdiBlend, AlphaAndBetaBecomeLinearByTheirGamma) {
    const std::string alpha = "<alphaMap><path>a.pfm</path><gammaEmbedded>2.0</gammaEmbedded></alphaMap>";
    const std::string beta = "<betaMap><path>b.pfm</path></betaMap>";
    const Files files{{"a.pfm", test::pfmBytes(greys({4, 2}, {0, 0.5f, 1, 0.25f, 1, 1, 1, 1}))},
                      {"b.pfm", test::pfmBytes({{4, 2}, 3, false, std::vector<float>(24, 0.1f)})}};
    const Display display = read({"w.mpcdi.xml", manifest(alpha + beta)}, findIn(files)).displays.at(0);
    ASSERT_TRUE(display.blend);
    EXPECT_EQ(display.blend->alpha.at(1), glm::vec3(0.25f));
    EXPECT_EQ(display.blend->alpha.at(3), glm::vec3(0.0625f));
    EXPECT_EQ(display.blend->alpha.at(4), glm::vec3(1));
    EXPECT_EQ(valueOf(display, "alpha_gamma"), "nothing") << "the file states it";
    EXPECT_EQ(valueOf(display, "beta_gamma"), "2");
    EXPECT_NEAR(display.blend->beta.at(0).x, 0.01f, 1e-7);

    const Display given = read({"w.mpcdi.xml", manifest("<alphaMap><path>a.pfm</path></alphaMap>")},
                               findIn(files), {{"alpha_gamma", 1}})
                              .displays.at(0);
    EXPECT_EQ(given.blend->alpha.at(1), glm::vec3(0.5f));
    EXPECT_TRUE(given.blend->beta.empty());
}

TEST(MpcdiBlend, SmallerMapsAreResampledBilinearlyWithAWarning) {
    const Files files{{"a.pfm", test::pfmBytes(greys({2, 1}, {0, 1}))}};
    const Display display =
        read({"w.mpcdi.xml",
              manifest("<alphaMap><path>a.pfm</path><gammaEmbedded>1</gammaEmbedded></alphaMap>")},
             findIn(files))
            .displays.at(0);
    // Texel centres lie at a quarter and three quarters of the width.
    EXPECT_EQ(display.blend->alpha.at(0), glm::vec3(0));
    EXPECT_EQ(display.blend->alpha.at(1), glm::vec3(0.25f));
    EXPECT_EQ(display.blend->alpha.at(2), glm::vec3(0.75f));
    EXPECT_EQ(display.blend->alpha.at(3), glm::vec3(1));
    EXPECT_THAT(display.warnings, Contains(HasSubstr("resampled")));
}

TEST(MpcdiBlend, NumbersThatAreNoMaskAreRefused) {
    for (const float bad : {-0.1f, 1.1f, std::numeric_limits<float>::quiet_NaN()}) {
        const Files files{{"a.pfm", test::pfmBytes(greys({2, 1}, {0.5f, bad}))}};
        EXPECT_THROW(
            read({"w.mpcdi.xml", manifest("<alphaMap><path>a.pfm</path></alphaMap>")}, findIn(files)),
            InputError);
    }
}

TEST(MpcdiFile, OtherSizesAreAskedForWithTheSameView) {
    Decisions decisions;
    const Wall wall =
        readMpcdi({"w.mpcdi.xml", manifest("")}, findIn({}), {.sizePx = glm::ivec2(100, 50)}, decisions);
    EXPECT_EQ(wall.displays[0].sizePx, glm::ivec2(100, 50));
    EXPECT_LT(angleBetween(*wall.displays[0].projection->unproject({100, 25}),
                           {std::tan(glm::radians(30.0)), 0, -1}),
              1e-12);
    EXPECT_THAT(wall.displays[0].warnings, IsEmpty());
}

TEST(MpcdiFile, EveryRegionHasANameOfItsOwn) {
    std::string regions;
    for (const char* id : {"a/b", "a_b", "", "", "x"})
        regions += fmt::format(
            "<region id='{}' xResolution='4' yResolution='2'><frustum><rightAngle>30</rightAngle>"
            "<leftAngle>-30</leftAngle><upAngle>20</upAngle><downAngle>-20</downAngle></frustum>"
            "</region>",
            id);
    const Wall wall = read({"w.mpcdi.xml", "<MPCDI profile='3d'><display><buffer id='b'>" + regions +
                                               "</buffer></display></MPCDI>"});
    std::set<std::string> names;
    for (const Display& display : wall.displays) names.insert(display.name);
    EXPECT_EQ(names.size(), 5u);
    EXPECT_TRUE(names.contains("a_b") && names.contains("x"));
}

TEST(MpcdiFile, ManyRegionsTakeNoQuadraticTime) {
    std::string regions, sets;
    for (int i = 0; i < 1000; ++i) {
        regions += fmt::format(
            "<region id='{}' xResolution='4' yResolution='2'><frustum><rightAngle>30</rightAngle>"
            "<leftAngle>-30</leftAngle><upAngle>20</upAngle><downAngle>-20</downAngle></frustum>"
            "</region>",
            i);
        sets += fmt::format("<fileset region='{}'/>", i);
    }
    EXPECT_EQ(read({"w.mpcdi.xml", "<MPCDI profile='3d'><display><buffer>" + regions +
                                       "</buffer></display><files>" + sets + "</files></MPCDI>"})
                  .displays.size(),
              1000u);
    std::string tooMany;
    for (int i = 0; i < 1025; ++i) tooMany += "<region/>";
    EXPECT_THROW(read({"w.mpcdi.xml",
                       "<MPCDI profile='3d'><display><buffer>" + tooMany + "</buffer></display></MPCDI>"}),
                 InputError);
}

TEST(MpcdiFile, BlendsForMoreThanAnyWallAreRefusedBeforeTheyAreMade) {
    std::string regions, sets;
    for (const char* id : {"a", "b"}) {
        regions += fmt::format("<region id='{}' xResolution='16384' yResolution='16384'/>", id);
        sets += fmt::format("<fileset region='{}'><alphaMap><path>a.pfm</path></alphaMap></fileset>", id);
    }
    try {
        read({"w.mpcdi.xml", "<MPCDI profile='2d'><display><buffer>" + regions +
                                 "</buffer></display><files>" + sets + "</files></MPCDI>"},
             findIn({{"a.pfm", test::pfmBytes(greys({1, 1}, {1}))}}));
        FAIL() << "six gigabytes of blends were made";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("nodes and pixels together"));
    }
}

TEST(MpcdiFile, BlendsAreChargedByTheResolutionOfTheBufferToo) {
    std::string regions, sets;
    for (const char* id : {"a", "b"}) {
        regions += fmt::format("<region id='{}'/>", id);
        sets += fmt::format("<fileset region='{}'><betaMap><path>a.pfm</path></betaMap></fileset>", id);
    }
    EXPECT_THROW(
        read({"w.mpcdi.xml", "<MPCDI profile='2d'><display><buffer xResolution='16384' yResolution='16384'>" +
                                 regions + "</buffer></display><files>" + sets + "</files></MPCDI>"},
             findIn({{"a.pfm", test::pfmBytes(greys({1, 1}, {1}))}})),
        InputError);
}

TEST(MpcdiFile, PicturesThatAreNotOfTheDisplaysSizeAreChargedBeforeTheyAreRead) {
    TexelBudget budget("w.mpcdi", 0);
    budget.take({16384, 16383}, "all but one row");
    Decisions decisions;
    const auto picture = [](glm::ivec2 sizePx) {
        const auto texels = static_cast<size_t>(sizePx.x) * static_cast<size_t>(sizePx.y);
        return FileBytes{"a.pfm", test::pfmBytes(greys(sizePx, std::vector<float>(texels, 0.5f)))};
    };
    const auto readOn = [&](const FileBytes& file, glm::ivec2 sizePx) {
        return readBlendPicture(file, sizePx, 1, "region", decisions, &budget).size();
    };
    EXPECT_EQ(readOn(picture({256, 256}), {256, 256}), 65536u) << "the caller's to charge";
    EXPECT_EQ(readOn(picture({64, 256}), {2, 2}), 4u) << "what is left";
    EXPECT_THROW(readOn(picture({4, 4}), {2, 2}), InputError);
}

TEST(MpcdiFile, RegionsGetTheWarningsOfTheirOwnAndOfTheWholeDocument) {
    const Wall wall =
        read({"w.mpcdi.xml",
              "<MPCDI profile='3d'><display><buffer><region id='a' xResolution='4' yResolution='2'>"
              "<frustum><rightAngle>30</rightAngle><leftAngle>-30</leftAngle><upAngle>20</upAngle>"
              "<downAngle>-20</downAngle></frustum></region></buffer><buffer><region id='b' x='0.5' "
              "xResolution='4' yResolution='2'><frustum><rightAngle>30</rightAngle><leftAngle>-30"
              "</leftAngle><upAngle>20</upAngle><downAngle>-20</downAngle></frustum></region></buffer>"
              "</display></MPCDI>"});
    ASSERT_EQ(wall.displays.size(), 2u);
    EXPECT_THAT(wall.displays[0].warnings, ElementsAre(HasSubstr("has one buffer")));
    EXPECT_THAT(wall.displays[1].warnings,
                ElementsAre(HasSubstr("has one buffer"), HasSubstr("buffer[1]/region: lies outside")));
}

TEST(MpcdiFile, FileSetsOfOneIdAreReadOnceForAllItsRegions) {
    std::string regions, sets;
    for (int i = 0; i < 1000; ++i)
        regions +=
            "<region id='a' xResolution='4' yResolution='2'><frustum><rightAngle>30</rightAngle>"
            "<leftAngle>-30</leftAngle><upAngle>20</upAngle><downAngle>-20</downAngle></frustum>"
            "</region>";
    for (int i = 0; i < 100000; ++i) sets += "<fileset region='a'/>";
    sets +=
        "<fileset region='a'><decodeLUT><path>x</path></decodeLUT></fileset>"
        "<fileset region='a'><alphaMap><path>a.pfm</path><gammaEmbedded>1</gammaEmbedded></alphaMap>"
        "</fileset><fileset region='a'><alphaMap><path>none.pfm</path></alphaMap></fileset>";
    const Wall wall = read({"w.mpcdi.xml", "<MPCDI profile='3d'><display><buffer>" + regions +
                                               "</buffer></display><files>" + sets + "</files></MPCDI>"},
                           findIn({{"a.pfm", test::pfmBytes(greys({4, 2}, std::vector<float>(8, 0.5f)))}}));
    ASSERT_EQ(wall.displays.size(), 1000u);
    for (const Display& display : wall.displays) {
        ASSERT_TRUE(display.blend) << "the first alphaMap counts";
        EXPECT_THAT(display.warnings, ElementsAre(HasSubstr("decodeLUT is not used")));
    }
}

TEST(MpcdiFile, DamagedFilesAreRefusedOrRead) {
    NEED_SAMPLE("sgct-history/correction_mesh.mpcdi");
    const FileBytes archive = sample("sgct-history/correction_mesh.mpcdi");
    const FileBytes xml = *ZipArchive(archive).files()("mpcdi1_.xml");
    std::mt19937 random(13);
    for (int round = 0; round < 600; ++round) {
        FileBytes damaged = round % 2 == 0 ? archive : xml;
        if (round % 3 == 0) damaged.bytes.resize(random() % damaged.bytes.size());
        for (int i = 0; i < 3 && !damaged.bytes.empty(); ++i)
            damaged.bytes[random() % damaged.bytes.size()] = static_cast<char>(random());
        try {
            for (const Display& display : read(damaged).displays)
                if (const auto ray = display.projection->unproject(0.3 * glm::dvec2(display.sizePx))) {
                    EXPECT_TRUE(std::isfinite(ray->x + ray->y + ray->z));
                }
        } catch (const InputError&) {
        }
    }
}

}  // namespace
}  // namespace curvewall
