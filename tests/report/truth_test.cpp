#include "report/truth.h"

#include "report/content_key.h"
#include "tests/support/rendering.h"
#include "tests/support/small_walls.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>

namespace curvewall {
namespace {

RenderRequest roomOnADome() {
    return test::requestFor(test::smallShippedWall("dome-master", 32), boxRoom({8, 5, 8}),
                            {{0.5, 0.3, 1}, {}});
}

bool areSameBits(const Frame& a, const Frame& b) {
    return a.sizePx == b.sizePx && a.channels == b.channels && a.texels.size() == b.texels.size() &&
           std::memcmp(a.texels.data(), b.texels.data(), a.texels.size() * sizeof(float)) == 0;
}

TEST(ContentKey, IsThatOfTheContent) { EXPECT_EQ(keyOfView(roomOnADome()), keyOfView(roomOnADome())); }

TEST(ContentKey, ChangesWithWhateverChangesThePicture) {
    const RenderRequest base = roomOnADome();
    const std::string key = keyOfView(base);

    RenderRequest other = base;
    other.camera.positionM.x += 1e-9;
    EXPECT_NE(keyOfView(other), key);
    other = base;
    other.camera.orientation.rollRad = 0.1;
    EXPECT_NE(keyOfView(other), key);
    other = base;
    other.style = Style::unlit;
    EXPECT_NE(keyOfView(other), key);

    Scene scene = *base.scene;
    scene.materials[3].baseColor.g += 0.01f;
    other = base;
    other.scene = std::make_shared<const Scene>(scene);
    EXPECT_NE(keyOfView(other), key);

    Wall wall = *base.wall;
    wall.background.r = 0.5f;
    other = base;
    other.wall = std::make_shared<const Wall>(wall);
    EXPECT_NE(keyOfView(other), key);

    other = base;
    other.wall = std::make_shared<const Wall>(test::smallShippedWall("dome-off-centre", 32));
    EXPECT_NE(keyOfView(other), key);
}

TEST(ContentKey, DoesNotAskForTheMethod) {
    RenderRequest warped = roomOnADome();
    warped.method = Method::vertexWarp;
    EXPECT_EQ(keyOfView(warped), keyOfView(roomOnADome()));
}

TEST(Truth, HasLessNoiseTheMoreRaysThereAre) {
    const KnownTruth few = traceTruth(roomOnADome(), {4, 1, 200});
    const KnownTruth many = traceTruth(roomOnADome(), {4, 16, 200});
    EXPECT_EQ(few.facts.supersamples, 8);
    EXPECT_EQ(many.facts.supersamples, 128);
    // Sixteen times as many independent passes have a sixteenth of the power: 12 dB.
    EXPECT_NEAR(many.facts.noiseDb - few.facts.noiseDb, 12, 3);
}

// Against a truth of many more rays, which is taken as exact.
TEST(Truth, StatesItsOwnNoise) {
    const KnownTruth stated = traceTruth(roomOnADome(), {16, 1, 200});
    const Frame exact = traceTruth(roomOnADome(), {64, 16, 200}).pictures.supersampled;
    EXPECT_NEAR(compareColor(stated.pictures.supersampled, exact).psnrDb, stated.facts.noiseDb, 2.5);
}

TEST(Truth, StopsWhereItIsQuiet) { EXPECT_EQ(traceTruth(roomOnADome(), {4, 16, 10}).facts.supersamples, 8); }

TEST(Truth, IsReadAgainBitByBit) {
    const test::TemporaryFolder folder;
    const RenderRequest request = roomOnADome();
    const std::string key = keyOfView(request);
    const Supersampling supersampling{4, 1, 200};
    EXPECT_FALSE(isTruthKept(key, supersampling, folder.path()));
    const KnownTruth traced = keptTruth(request, key, supersampling, folder.path());
    EXPECT_TRUE(isTruthKept(key, supersampling, folder.path()));
    EXPECT_FALSE(isTruthKept(key, {8, 1, 200}, folder.path()));
    const auto written =
        std::filesystem::last_write_time(std::filesystem::directory_iterator(folder.path())->path());
    const KnownTruth read = keptTruth(request, key, supersampling, folder.path());
    EXPECT_EQ(std::filesystem::last_write_time(std::filesystem::directory_iterator(folder.path())->path()),
              written);
    for (const auto picture : {&Truth::color, &Truth::position, &Truth::coverage, &Truth::supersampled})
        EXPECT_TRUE(areSameBits(read.pictures.*picture, traced.pictures.*picture));
    EXPECT_EQ(read.facts.noiseDb, traced.facts.noiseDb);
    EXPECT_EQ(read.facts.supersamples, traced.facts.supersamples);
}

TEST(Truth, IsTracedAgainWhereItWasCutOff) {
    const test::TemporaryFolder folder;
    const RenderRequest request = roomOnADome();
    const std::string key = keyOfView(request);
    keptTruth(request, key, {4, 1, 200}, folder.path());
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        if (entry.path().extension() == ".json") std::filesystem::resize_file(entry.path(), 5);
    EXPECT_EQ(keptTruth(request, key, {4, 1, 200}, folder.path()).facts.supersamples, 8);
}

TEST(Truth, IsTracedAgainWhereAPictureIsLostOrCut) {
    const RenderRequest request = roomOnADome();
    const std::string key = keyOfView(request);
    for (const bool isLost : {true, false}) {
        const test::TemporaryFolder folder;
        const Frame wanted = keptTruth(request, key, {4, 1, 200}, folder.path()).pictures.supersampled;
        std::string picture;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
            if (entry.path().string().ends_with("-supersampled.exr")) picture = entry.path().string();
        if (isLost)
            std::filesystem::remove(picture);
        else
            std::filesystem::resize_file(picture, 100);
        EXPECT_TRUE(
            areSameBits(keptTruth(request, key, {4, 1, 200}, folder.path()).pictures.supersampled, wanted));
    }
}

}  // namespace
}  // namespace curvewall
