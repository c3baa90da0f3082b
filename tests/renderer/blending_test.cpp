// The maps of a display over a picture whose colour is known: every method has to give the formula's value.

#include "renderer/blending.h"

#include "renderer/image_file.h"
#include "renderer/render.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/random_numbers.h"
#include "tests/support/rendering.h"
#include "tests/support/test_projections.h"
#include "tests/support/test_scenes.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace curvewall {
namespace {

constexpr glm::ivec2 kSizePx{48, 36};
constexpr size_t kPixels = size_t{48} * 36;
constexpr Method kMethods[] = {Method::piecewise, Method::imageBased, Method::reference};
const glm::vec3 kColor(0.7f, 0.4f, 0.2f);

std::vector<glm::vec3> randomMap(uint64_t seed, double least, double most) {
    test::Random random(seed);
    std::vector<glm::vec3> map(kPixels);
    for (glm::vec3& value : map)
        value =
            glm::vec3(random.uniform(least, most), random.uniform(least, most), random.uniform(least, most));
    return map;
}

BlendMaps randomMaps() { return {randomMap(1, 0, 1), randomMap(2, 0, 0.3)}; }

double byteOf(double linear) {
    return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

// The formula, written once more and in double.
double expected(const BlendMaps& maps, size_t pixel, int channel, double color) {
    const double a = maps.alpha.empty() ? 1 : maps.alpha[pixel][channel];
    const double b = maps.beta.empty() ? 0 : maps.beta[pixel][channel];
    return color * a * (1 - b) + b;
}

class Blending : public test::GlTest {
protected:
    // From inside a room of one colour every pixel of a display has it, at every sample.
    RenderRequest flatRequest(Method method, BlendMaps maps, Wall wall = test::fullCylinderWall(kSizePx),
                              glm::vec3 color = kColor) {
        Scene room;
        startMaterial(room, plainMaterial(color));
        const Scene box = boxRoom({8, 8, 8});
        room.positions = box.positions;
        room.normals = box.normals;
        room.uvs = box.uvs;
        room.triangles = box.triangles;
        room.ranges.back().triangleCount = static_cast<uint32_t>(box.triangles.size());
        wall.displays[0].blend = std::make_shared<const BlendMaps>(std::move(maps));
        RenderRequest request = test::requestFor(std::move(wall), std::move(room));
        request.method = method;
        request.style = Style::unlit;
        if (method == Method::imageBased) request.faceSizePx = 64;
        return request;
    }

    void expectFormula(RenderRequest request, glm::vec3 color = kColor) {
        const BlendMaps& maps = *request.wall->displays[0].blend;
        request.linearOutput = true;
        const Frame exact = renderer_.render(request).frame;
        request.linearOutput = false;
        const Frame encoded = renderer_.render(request).frame;
        ASSERT_EQ(exact.texels.size(), 3 * kPixels);
        for (size_t i = 0; i < 3 * kPixels; ++i) {
            const int channel = static_cast<int>(i % 3);
            const double light = expected(maps, i / 3, channel, color[channel]);
            ASSERT_NEAR(exact.texels[i], light, 2e-6) << i;
            ASSERT_LE(std::abs(srgbByteFromLinear(encoded.texels[i]) - byteOf(light)), 1) << i;
        }
    }

    Renderer renderer_;
};

TEST_F(Blending, EveryMethodGivesTheFormulasValue) {
    for (const Method method : kMethods) {
        SCOPED_TRACE(static_cast<int>(method));
        expectFormula(flatRequest(method, randomMaps()));
        expectFormula(flatRequest(method, {randomMap(3, 0, 1), {}}));
        expectFormula(flatRequest(method, {{}, randomMap(4, 0, 1)}));
    }
}

TEST_F(Blending, OnePieceAndManySamplesToo) {
    expectFormula(flatRequest(Method::piecewise, randomMaps(), test::planarWall(kSizePx, 80)));
    // Four are the hardware's, 65 are more than any driver has: shifted passes.
    for (const int samples : {4, 65})
        for (const Method method : kMethods) {
            RenderRequest request = flatRequest(method, randomMaps());
            request.samples = samples;
            expectFormula(request);
        }
}

TEST_F(Blending, TheBackgroundAndHolesAreBlendedAsThePictureIs) {
    // Half of the pixels see nothing at all, the others an empty scene.
    std::vector<std::optional<glm::dvec3>> rays(kPixels);
    for (size_t i = 0; i < kPixels; i += 2) rays[i] = glm::dvec3(0, 0, -1);
    const BlendMaps maps = randomMaps();
    for (const Method method : {Method::imageBased, Method::reference}) {
        Wall wall = wallOf(std::make_shared<RayListProjection>(kSizePx.x, rays), kSizePx);
        wall.background = kColor;
        RenderRequest request = flatRequest(method, maps, std::move(wall));
        request.scene = std::make_shared<const Scene>();
        expectFormula(request);
    }
    Wall wall = test::fullCylinderWall(kSizePx);
    wall.background = kColor;
    RenderRequest request = flatRequest(Method::piecewise, maps, std::move(wall));
    request.scene = std::make_shared<const Scene>();
    expectFormula(request);
}

TEST_F(Blending, BetaLiftsBlack) {
    for (const Method method : kMethods)
        expectFormula(
            flatRequest(method, {{}, std::vector<glm::vec3>(kPixels, glm::vec3(0.02f, 0.03f, 0.04f))},
                        test::fullCylinderWall(kSizePx), glm::vec3(0)),
            glm::vec3(0));
}

TEST_F(Blending, StepsFinerThanEightBitsReachFloatOutput) {
    BlendMaps maps;
    for (size_t i = 0; i < kPixels; ++i) maps.alpha.emplace_back((30000 + static_cast<float>(i)) / 65535);
    for (const Method method : kMethods) {
        RenderRequest request = flatRequest(method, maps);
        request.linearOutput = true;
        const Frame frame = renderer_.render(request).frame;
        for (size_t i = 1; i < kPixels; ++i) ASSERT_GT(frame.texels[3 * i], frame.texels[3 * (i - 1)]);
    }
}

TEST_F(Blending, EightBitsBlendTheLightThatWouldHaveBeenShown) {
    // Light above white is cut before the maps: two halves of it must not be brighter than one whole.
    const std::vector<glm::vec3> half(kPixels, glm::vec3(0.5f));
    for (const Method method : kMethods) {
        RenderRequest request =
            flatRequest(method, {half, {}}, test::fullCylinderWall(kSizePx), glm::vec3(1.5f));
        EXPECT_NEAR(renderer_.render(request).frame.texels[0], 0.5, 0.004);  // eight bits
        request.linearOutput = true;
        EXPECT_NEAR(renderer_.render(request).frame.texels[0], 0.75, 1e-6);
    }
}

TEST_F(Blending, TheOtherOutputsAreBeforeTheMaps) {
    for (const Method method : kMethods)
        for (const OutputKind output : {OutputKind::depth, OutputKind::coverage, OutputKind::position}) {
            RenderRequest request = flatRequest(method, randomMaps());
            request.output = output;
            const Frame masked = renderer_.render(request).frame;
            Wall plain = *request.wall;
            plain.displays[0].blend = nullptr;
            request.wall = std::make_shared<const Wall>(plain);
            EXPECT_EQ(masked.texels, renderer_.render(request).frame.texels);
        }
}

TEST_F(Blending, MapsOfOneAndZeroChangeNoByte) {
    BlendMaps neutral{std::vector<glm::vec3>(kPixels, glm::vec3(1)),
                      std::vector<glm::vec3>(kPixels, glm::vec3(0))};
    RenderRequest request = flatRequest(Method::piecewise, std::move(neutral));
    const Frame through = renderer_.render(request).frame;
    Wall plain = *request.wall;
    plain.displays[0].blend = nullptr;
    request.wall = std::make_shared<const Wall>(plain);
    EXPECT_EQ(through.texels, renderer_.render(request).frame.texels);
}

TEST_F(Blending, EachDisplayHasItsOwnMaps) {
    Wall wall = test::fullCylinderWall(kSizePx);
    wall.displays.push_back(wall.displays[0]);
    wall.displays[1].name = "second";
    RenderRequest request = flatRequest(Method::piecewise, randomMaps(), wall);
    request.linearOutput = true;
    request.display = "second";
    EXPECT_NEAR(renderer_.render(request).frame.texels[0], kColor.r, 1e-6);
    request.display = "front";
    EXPECT_NEAR(renderer_.render(request).frame.texels[0],
                expected(*request.wall->displays[0].blend, 0, 0, kColor.r), 1e-6);
}

TEST_F(Blending, AnotherEyeKeepsTheMapsAndMovesThePicture) {
    for (const Method method : kMethods) {
        const BlendMaps maps = randomMaps();
        RenderRequest request = flatRequest(method, maps);
        request.eyeM = glm::dvec3(0.5, 0.2, -0.4);
        expectFormula(request);

        // The picture is that of a wall whose own eye is there.
        request = test::requestFor(test::fullCylinderWall(kSizePx), boxRoom({8, 5, 8}));
        request.method = method;
        request.eyeM = glm::dvec3(0.5, 0.2, -0.4);
        const Frame moved = renderer_.render(request).frame;
        request.eyeM.reset();
        EXPECT_NE(moved.texels, renderer_.render(request).frame.texels);
        request.wall = std::make_shared<const Wall>(test::fullCylinderWall(kSizePx, {0.5, 0.2, -0.4}));
        EXPECT_EQ(moved.texels, renderer_.render(request).frame.texels);
    }
}

}  // namespace
}  // namespace curvewall
