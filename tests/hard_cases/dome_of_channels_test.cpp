// A real dome of six projectors, in the four formats that its calibration was kept in: together the channels
// show one picture without a seam, which is the one that a ray caster makes of the dome as a whole.

#include "calibration/projections/lens_projection.h"
#include "calibration/projections/radial_lens.h"
#include "calibration/readers/wall_reader.h"
#include "renderer/image_file.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/rendering.h"
#include "tests/support/sample_paths.h"
#include "tests/support/temporary_folder.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace curvewall {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kChannels = 6;
constexpr glm::ivec2 kChannelSizePx(640, 400);
constexpr glm::ivec2 kDomeSizePx(512, 512);
// The lower side of four of the frusta lies 7.7 degrees above the horizon.
constexpr double kLowestRad = 0.14;

constexpr std::array<float, 3> kSky{0.35f, 0.55f, 0.85f};
constexpr float kVisible = 8.0f / 255.0f;

Display domeMaster() {
    const Orientation zenith{0, glm::radians(90.0), 0};
    return {"dome", kDomeSizePx, "radial",
            std::make_shared<LensProjection>(
                circularLens({RadialModel::equidistant}, std::numbers::pi, kDomeSizePx), zenith)};
}

float encoded(float linear) { return std::pow(std::clamp(linear, 0.0f, 1.0f), 1 / 2.2f); }

float difference(glm::vec3 a, glm::vec3 b) {
    float most = 0;
    for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(encoded(a[c]) - encoded(b[c])));
    return most;
}

// Bilinear between pixel centres; nothing off the display and beside a pixel that shows nothing.
std::optional<glm::vec3> colorAt(const Frame& frame, const Projection& projection, glm::dvec2 px) {
    const glm::dvec2 sizePx(frame.sizePx);
    if (!(px.x >= 0 && px.y >= 0 && px.x <= sizePx.x && px.y <= sizePx.y)) return std::nullopt;
    const glm::dvec2 place = glm::clamp(px - 0.5, glm::dvec2(0), sizePx - 1.0);
    const glm::ivec2 cell = glm::min(glm::ivec2(place), frame.sizePx - 2);
    for (const glm::ivec2 corner : {cell, cell + glm::ivec2(1, 0), cell + glm::ivec2(0, 1), cell + 1})
        if (!projection.unproject(glm::dvec2(corner) + 0.5)) return std::nullopt;
    const glm::dvec2 t = place - glm::dvec2(cell);
    const auto texel = [&](int x, int y) {
        const float* c = frame.at(cell.x + x, cell.y + y);
        return glm::dvec3(c[0], c[1], c[2]);
    };
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), t.x), glm::mix(texel(0, 1), texel(1, 1), t.x), t.y);
}

// Nothing but one colour around, so that no edge is between the pixels that are compared.
bool isPlain(const Frame& truth, int x, int y) {
    constexpr int kReach = 2;
    const float* centre = truth.at(x, y);
    for (int dy = -kReach; dy <= kReach; ++dy)
        for (int dx = -kReach; dx <= kReach; ++dx) {
            const glm::ivec2 at = glm::clamp(glm::ivec2(x + dx, y + dy), glm::ivec2(0), truth.sizePx - 1);
            const float* c = truth.at(at.x, at.y);
            if (difference({centre[0], centre[1], centre[2]}, {c[0], c[1], c[2]}) > kVisible) return false;
        }
    return true;
}

struct Composite {
    Frame picture{kDomeSizePx, 3, {}};
    int directions = 0, uncovered = 0, overlaps = 0;
    int seams = 0, wrong = 0;            // two channels differ; the first one differs from the truth
    int plainSeams = 0, plainWrong = 0;  // of those the ones far from edges of the scene

    double share(int count) const { return static_cast<double>(count) / directions; }
};

// Each direction of the dome from the first channel that shows it, the others held against that.
Composite compose(const Display& dome, const Wall& channels, const std::vector<Frame>& frames,
                  const Frame& truth) {
    Composite result;
    for (int y = 0; y < kDomeSizePx.y; ++y)
        for (int x = 0; x < kDomeSizePx.x; ++x) {
            const auto ray = dome.projection->unproject({x + 0.5, y + 0.5});
            std::optional<glm::vec3> shown;
            if (ray && std::asin(glm::normalize(*ray).y) > kLowestRad) {
                ++result.directions;
                bool seam = false, overlaps = false;
                for (size_t c = 0; c < frames.size(); ++c) {
                    const Projection& projection = *channels.displays[c].projection;
                    for (const glm::dvec2 px : projection.project(*ray)) {
                        const auto color = colorAt(frames[c], projection, px);
                        if (!color) continue;
                        if (shown) {
                            overlaps = true;
                            seam = seam || difference(*shown, *color) > kVisible;
                        } else {
                            shown = color;
                        }
                    }
                }
                result.uncovered += !shown;
                result.overlaps += overlaps;
                const float* t = truth.at(x, y);
                const bool wrong = shown && difference(*shown, {t[0], t[1], t[2]}) > kVisible;
                const bool plain = isPlain(truth, x, y);
                result.seams += seam;
                result.plainSeams += seam && plain;
                result.wrong += wrong;
                result.plainWrong += wrong && plain;
            }
            const glm::vec3 color = shown.value_or(glm::vec3(0));
            result.picture.texels.insert(result.picture.texels.end(), {color.r, color.g, color.b});
        }
    return result;
}

class DomeOfChannels : public test::GlTest {
protected:
    void SetUp() override {
        test::GlTest::SetUp();
        if (!fs::is_directory(kSimcad))
            GTEST_SKIP() << kSimcad << " is not here; set CURVEWALL_SAMPLES to the samples folder";
    }

    Wall channelsOf(const std::string& ending) const {
        json displays = json::array();
        for (int i = 1; i <= kChannels; ++i) {
            const std::string name = "channel" + std::to_string(i);
            displays.push_back({{"name", name},
                                {"size", {kChannelSizePx.x, kChannelSizePx.y}},
                                {"calibration", {{"file", (kSimcad / (name + ending)).string()}}}});
        }
        return readWall(folder_.write(
            "wall.json", json{{"wall", "dome"}, {"background", kSky}, {"displays", displays}}.dump()));
    }

    static Composite composeScene(const std::string& sceneName, const Wall& channels) {
        const Display dome = domeMaster();
        RenderRequest request =
            test::requestFor({"dome", {}, {kSky[0], kSky[1], kSky[2]}, {dome}}, loadScene(sceneName));
        request.camera = request.scene->defaultCamera;
        request.samples = 4;
        request.method = Method::reference;
        const Frame truth = Renderer().render(request).frame;
        request.method = Method::piecewise;
        request.wall = std::make_shared<const Wall>(channels);
        Renderer renderer;
        std::vector<Frame> frames;
        for (const Display& display : channels.displays) {
            request.display = display.name;
            frames.push_back(renderer.render(request).frame);
        }
        return compose(dome, channels, frames, truth);
    }

    // To be looked at, where $CURVEWALL_PICTURES names a folder.
    static void keep(const Frame& picture, const std::string& name) {
        if (const char* folder = std::getenv("CURVEWALL_PICTURES"))
            writeFrame((fs::path(folder) / name).string(), picture);
    }

    inline static const fs::path kSimcad = test::samplesFolder() / "sgct-history/config/dome/simcad";
    test::TemporaryFolder folder_;
};

TEST_F(DomeOfChannels, TheRoomIsSeamless) {
    const Composite dome = composeScene("room", channelsOf("_warp_mesh.csv"));
    keep(dome.picture, "room.png");
    EXPECT_EQ(dome.uncovered, 0);
    EXPECT_GT(dome.share(dome.overlaps), 0.5);
    EXPECT_EQ(dome.plainSeams, 0);
    EXPECT_EQ(dome.plainWrong, 0);
    EXPECT_LT(dome.share(dome.seams), 0.006);
    EXPECT_LT(dome.share(dome.wrong), 0.006);
}

// Its windows are a few pixels large, and are filtered twice where channels are compared.
TEST_F(DomeOfChannels, TheCityIsSeamless) {
    const Composite dome = composeScene("city", channelsOf("_warp.simcad"));
    keep(dome.picture, "city.png");
    EXPECT_EQ(dome.uncovered, 0);
    EXPECT_LT(dome.share(dome.seams), 0.015);
    EXPECT_LT(dome.share(dome.wrong), 0.045);
}

}  // namespace
}  // namespace curvewall
