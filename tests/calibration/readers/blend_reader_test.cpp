#include "calibration/readers/blend_reader.h"

#include "calibration/errors.h"
#include "calibration/files/map_file.h"
#include "calibration/readers/wall_reader.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

namespace curvewall {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

// A 3 x 2 display.
class BlendReader : public ::testing::Test {
protected:
    void writePng(const std::string& name, int channels, const std::vector<float>& values,
                  glm::ivec2 sizePx = {3, 2}) {
        writePng16(folder_.path(name), {sizePx, channels, true, values});
    }
    // One channel, little-endian, the bottom row first, as the format has it.
    void writePfm(const std::string& name, std::vector<float> topRowFirst) {
        std::vector<float> rows(topRowFirst.begin() + 3, topRowFirst.end());
        rows.insert(rows.end(), topRowFirst.begin(), topRowFirst.begin() + 3);
        std::string bytes(rows.size() * sizeof(float), '\0');
        std::memcpy(bytes.data(), rows.data(), bytes.size());
        folder_.write(name, "Pf\n3 2\n-1.0\n" + bytes);
    }
    BlendMaps read(const json& blend) {
        const json wall{
            {"wall", "w"},
            {"displays",
             {{{"name", "d"},
               {"size", {3, 2}},
               {"projection", {{"type", "cylinder"}, {"radius", 2}, {"arc_deg", 90}, {"height", 1}}},
               {"blend", blend}}}}};
        const BlendMapsPtr maps = readWall(folder_.write("wall.json", wall.dump())).displays[0].blend;
        return maps ? *maps : BlendMaps{};
    }
    std::string complaintAbout(const json& blend) {
        try {
            read(blend);
        } catch (const InputError& error) {
            return error.what();
        }
        return "nothing";
    }

    test::TemporaryFolder folder_;
    const std::vector<float> ramp_{0, 0.2f, 0.4f, 0.6f, 0.8f, 1};  // whole steps of 8 and of 16 bits
};

TEST_F(BlendReader, OneChannelServesAllThreeAndIsLinearByDefault) {
    writePng("a.png", 1, ramp_);
    const BlendMaps maps = read({{"alpha", "a.png"}});
    ASSERT_EQ(maps.alpha.size(), 6u);
    EXPECT_TRUE(maps.beta.empty());
    for (size_t i = 0; i < 6; ++i) EXPECT_EQ(maps.alpha[i], glm::vec3(ramp_[i]));
}

TEST_F(BlendReader, SixteenBitsAreKept) {
    writePng("a.png", 1, {1.0f / 65535, 2.0f / 65535, 12345.0f / 65535, 0.5f, 65534.0f / 65535, 1});
    const BlendMaps maps = read({{"alpha", "a.png"}});
    EXPECT_FLOAT_EQ(maps.alpha[0].r, 1.0f / 65535);
    EXPECT_FLOAT_EQ(maps.alpha[2].r, 12345.0f / 65535);
    EXPECT_FLOAT_EQ(maps.alpha[4].r, 65534.0f / 65535);
}

TEST_F(BlendReader, GammaTurnsWhatIsStoredIntoLightChannelByChannel) {
    std::vector<float> colors;
    for (const float v : ramp_) colors.insert(colors.end(), {v, 1 - v, v});
    writePng("a.png", 3, colors);
    writePng("b.png", 1, ramp_);
    const BlendMaps same = read({{"alpha", "a.png"}, {"beta", "b.png"}, {"gamma", 2.2}});
    const BlendMaps each = read({{"alpha", "a.png"}, {"beta", "b.png"}, {"gamma", {1, 2, 0.5}}});
    for (size_t i = 0; i < 6; ++i) {
        const double v = ramp_[i];
        EXPECT_NEAR(same.alpha[i].r, std::pow(v, 2.2), 1e-5);
        EXPECT_NEAR(same.alpha[i].g, std::pow(1 - v, 2.2), 1e-5);
        EXPECT_NEAR(same.beta[i].b, std::pow(v, 2.2), 1e-5);
        EXPECT_NEAR(each.alpha[i].r, v, 1e-5);
        EXPECT_NEAR(each.alpha[i].g, std::pow(1 - v, 2), 1e-5);
        EXPECT_NEAR(each.alpha[i].b, std::sqrt(v), 1e-5);
        EXPECT_NEAR(each.beta[i].b, std::sqrt(v), 1e-5);
    }
}

TEST_F(BlendReader, FloatFilesAreReadTopRowFirst) {
    writePfm("a.pfm", ramp_);
    const BlendMaps maps = read({{"beta", "a.pfm"}});
    for (size_t i = 0; i < 6; ++i) EXPECT_EQ(maps.beta[i], glm::vec3(ramp_[i]));
}

TEST_F(BlendReader, PathsAreRelativeToTheWallFile) {
    folder_.write("masks/here", "");
    writePng("masks/a.png", 1, ramp_);
    EXPECT_EQ(read({{"alpha", "masks/a.png"}}).alpha.size(), 6u);
    EXPECT_EQ(read({{"alpha", folder_.path("masks/a.png")}}).alpha.size(), 6u);
}

TEST_F(BlendReader, AnOpaqueAlphaChannelIsIgnoredAndAnyOtherIsRefused) {
    std::vector<float> opaque, holed;
    for (const float v : ramp_) {
        opaque.insert(opaque.end(), {v, v, v, 1});
        holed.insert(holed.end(), {v, v, v, v});
    }
    writePng("opaque.png", 4, opaque);
    writePng("holed.png", 4, holed);
    EXPECT_EQ(read({{"alpha", "opaque.png"}}).alpha[3], glm::vec3(0.6f));
    EXPECT_THAT(complaintAbout({{"alpha", "holed.png"}}), HasSubstr("opaque everywhere, found an alpha of"));
}

TEST_F(BlendReader, NothingGivenIsNoMap) {
    EXPECT_TRUE(read(json::object()).empty());
    EXPECT_TRUE(read({{"gamma", 2}}).empty());
}

TEST_F(BlendReader, ErrorsNameTheFileAndWhatIsWrongWithIt) {
    writePng("small.png", 1, {0, 0, 0, 1}, {2, 2});
    writePng("a.png", 1, ramp_);
    writePfm("nan.pfm", {0, 0, 0, 0, kNaN, 0});
    writePfm("bright.pfm", {0, 0, 0, 0, 0, 1.5f});
    writePfm("negative.pfm", {-0.25f, 0, 0, 0, 0, 0});
    folder_.write("junk.png", "no picture");
    struct Case {
        json blend;
        std::string says;
    };
    for (const Case& c : std::vector<Case>{
             {{{"alpha", "small.png"}}, "small.png: expected 3 x 2 pixels, as the display has, found 2 x 2"},
             {{{"beta", "nan.pfm"}}, "nan.pfm: expected values from 0 to 1, found nan at pixel (1, 1)"},
             {{{"alpha", "bright.pfm"}}, "bright.pfm: expected values from 0 to 1, found 1.5"},
             {{{"alpha", "negative.pfm"}}, "negative.pfm: expected values from 0 to 1, found -0.25"},
             {{{"alpha", "none.png"}},
              "displays[0].blend.alpha: expected the name of a file that is there, found \"none.png\""},
             {{{"beta", ""}}, "displays[0].blend.beta: expected the name of a file that is there"},
             {{{"alpha", "junk.png"}}, "junk.png: expected a readable image"},
             {{{"alpha", 1}}, "displays[0].blend.alpha: expected a string"},
             {{{"alpha", "a.png"}, {"gamma", 0}},
              "displays[0].blend.gamma: expected a number from 0.1 to 10"},
             {{{"alpha", "a.png"}, {"gamma", "2.2"}}, "displays[0].blend.gamma: expected a number"},
             {{{"gamma", {1, 2}}}, "displays[0].blend.gamma: expected a list of 3 numbers"},
             {{{"gamma", {1, 2, 11}}}, "displays[0].blend.gamma[2]: expected a number from 0.1 to 10"},
             {{{"delta", "a.png"}}, "displays[0].blend: expected only the keys alpha, beta, gamma"},
             {"a.png", "displays[0].blend: expected an object"},
         })
        EXPECT_THAT(complaintAbout(c.blend), HasSubstr(c.says));
}

}  // namespace
}  // namespace curvewall
