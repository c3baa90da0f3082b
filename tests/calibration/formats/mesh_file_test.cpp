#include "calibration/formats/mesh_file.h"

#include "calibration/blending/blend.h"
#include "calibration/errors.h"
#include "calibration/formats/calibration_file.h"
#include "calibration/projections/warp_mesh.h"
#include "tests/support/random_numbers.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace curvewall {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::Field;
using testing::IsEmpty;

const fs::path kConformance = fs::path(CURVEWALL_SOURCE_DIR) / "tests" / "data" / "conformance";

FileBytes conforming(const std::string& name) { return readFile((kConformance / name).string(), "a file"); }

// One good file of every format.
const std::vector<std::string> kGoodFiles{"sgc/strip_turns.sgc",
                                          "sgc/version_2_triangles.sgc",
                                          "simcad/offsets_in_pixels.simcad",
                                          "domeprojection/named_mesh.csv",
                                          "domeprojection/named_frustum.csv",
                                          "bourke/polar.data",
                                          "obj/negative_indices.obj",
                                          "openmesh/rotation.ol",
                                          "skyskan/angle_tweaks.skyskan"};

// Reads the file, or as the frustum of a mesh, to a ray. What a stranger's bytes may lead to is an
// InputError.
void readThroughly(const FileBytes& file) {
    FileBytes mesh = file;
    FindFile find = [](const std::string&) { return std::nullopt; };
    if (file.name() == "named_frustum.csv") {
        mesh = conforming("domeprojection/named_mesh.csv");
        find = [&](const std::string&) { return file; };
    }
    try {
        Decisions decisions;
        const Wall wall = readCalibration(mesh, find, {.sizePx = glm::ivec2(16, 8)}, decisions);
        for (int x = 0; x < 16; ++x)
            if (const auto ray = wall.displays.front().projection->unproject({x + 0.5, 4.5})) {
                ASSERT_TRUE(std::isfinite(glm::dot(*ray, *ray)));
            }
    } catch (const InputError&) {
    }
}

TEST(MeshFile, IsKnownByItsContentWhereItHasASignature) {
    for (FileBytes file : {conforming("sgc/version_1.sgc"), conforming("simcad/no_warp.simcad"),
                           conforming("domeprojection/plain.csv"), conforming("openmesh/plain.ol"),
                           conforming("skyskan/plain.skyskan"), conforming("bourke/bottom_row_first.data")}) {
        file.path = "anything.bin";
        EXPECT_TRUE(isMeshFile(file)) << file.bytes.substr(0, 20);
    }
}

TEST(MeshFile, TextsOfOtherKindsAreNone) {
    for (const char* bytes : {"", "\n", "SG", "2", "2\n", "2\n3", "hello\nworld\n", "<MPCDI/>",
                              "PF\n2 2\n-1.0\n", "x;y;z;heading\n0;0;0;0\n", "1\n2 x\n"})
        EXPECT_FALSE(isMeshFile({"a.txt", bytes})) << bytes;
}

TEST(MeshFile, TruncatedAnywhereIsAnErrorOrALesserMesh) {
    for (const std::string& name : kGoodFiles) {
        const FileBytes whole = conforming(name);
        for (size_t length = 0; length < whole.bytes.size(); ++length)
            readThroughly({whole.path, whole.bytes.substr(0, length)});
    }
}

TEST(MeshFile, AnyByteMayBeAnyOther) {
    test::Random random(11);
    const auto below = [&](size_t count) {
        return static_cast<size_t>(random.uniform(0, static_cast<double>(count)));
    };
    for (const std::string& name : kGoodFiles) {
        const FileBytes whole = conforming(name);
        for (int i = 0; i < 2000; ++i) {
            FileBytes damaged = whole;
            for (size_t changes = below(4) + 1; changes > 0; --changes)
                damaged.bytes[below(damaged.bytes.size())] =
                    below(2) == 0 ? static_cast<char>(below(256)) : "0123456789-.;/ \n"[below(16)];
            readThroughly(damaged);
        }
    }
}

TEST(MeshFile, WithoutAFolderNothingIsLookedForOrDecidedAboutAFrustum) {
    Decisions decisions;
    const MeshCalibration mesh = readMesh(conforming("domeprojection/named_mesh.csv"), {}, decisions);
    EXPECT_FALSE(mesh.frustum);
    EXPECT_THAT(decisions.taken(), testing::Not(Contains(Field(&Assumption::key, "frustum_file"))));
}

TEST(MeshFile, ASourceIsNotUsedWhereTheFileTellsItsOwn) {
    const FileBytes file = conforming("sgc/version_1.sgc");
    Decisions decisions;
    const SourcePicture other{
        {8, 8}, std::make_shared<FrustumProjection>(Frustum{-0.1, 0.1, -0.1, 0.1, {}}, glm::dvec2(8))};
    const Display display =
        readCalibration(file, {}, {.sizePx = glm::ivec2(8), .source = other}, decisions).displays.front();
    EXPECT_THAT(display.warnings, Contains(testing::HasSubstr("source")));
    const glm::dvec3 ray = display.projection->unproject({8, 4}).value();
    EXPECT_NEAR(ray.x / -ray.z, 1, 1e-6);
}

TEST(MeshFile, IntensitiesDarkenThePictureInLinearLight) {
    Decisions decisions;
    const Wall wall = readCalibration(conforming("openmesh/gamma.ol"), {}, {}, decisions);
    const BlendMapsPtr blend = wall.displays.front().blend;
    ASSERT_NE(blend, nullptr);
    ASSERT_FALSE(blend->alpha.empty());
    EXPECT_NEAR(blend->alpha.front().x, std::pow(0.5, 1.8), 1e-6);
}

TEST(MeshFile, OneEverywhereIsNoMask) {
    Decisions decisions;
    const Wall wall = readCalibration(conforming("openmesh/plain.ol"), {}, {}, decisions);
    EXPECT_EQ(wall.displays.front().blend, nullptr);
}

TEST(MeshFile, WhatAFileStatesIsNoAssumption) {
    Decisions decisions;
    readMesh(conforming("sgc/version_2_triangles.sgc"), {}, decisions);
    EXPECT_THAT(decisions.taken(), IsEmpty());
}

}  // namespace
}  // namespace curvewall
