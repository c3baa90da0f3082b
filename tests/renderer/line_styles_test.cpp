// Wireframe and pen-and-ink: lines whose widths are pixels of the display.

#include "renderer/line_styles.h"

#include "renderer/gpu_edges.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/line_width.h"
#include "tests/support/rendering.h"
#include "tests/support/shipped_walls.h"
#include "tests/support/test_scenes.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace curvewall {
namespace {

constexpr std::array kLineStyles{Style::wireframe, Style::penAndInk};

class LineStyles : public test::GlTest {
protected:
    Frame frameOf(const RenderRequest& request) { return renderer_.render(request).frame; }

    Renderer renderer_;
};

Material unlitMaterial(glm::vec3 color) {
    Material material = plainMaterial(color);
    material.unlit = true;
    return material;
}

// A closed box whose walls are grids of squares, of one colour without light.
Scene gridRoom(glm::vec3 leastM, glm::vec3 mostM, int squares, glm::vec3 color) {
    Scene scene;
    startMaterial(scene, unlitMaterial(color));
    for (int axis = 0; axis < 3; ++axis)
        for (const bool most : {false, true})
            for (int i = 0; i < squares; ++i)
                for (int k = 0; k < squares; ++k) {
                    const auto corner = [&](int u, int v) {
                        glm::vec3 share(most ? 1 : 0);
                        share[(axis + 1) % 3] = static_cast<float>(i + u) / static_cast<float>(squares);
                        share[(axis + 2) % 3] = static_cast<float>(k + v) / static_cast<float>(squares);
                        return glm::mix(leastM, mostM, share);
                    };
                    addQuad(scene, {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)});
                }
    return scene;
}

struct WidthsSeen {
    double least, mean, most;
};

WidthsSeen widthsSeen(const RenderRequest& request, const Frame& frame) {
    test::Random random(1);
    const std::vector<double> widths =
        test::LineWidths(*request.scene, request.wall->displays[0]).measure(frame, 500, random);
    const auto [least, most] = std::ranges::minmax(widths);
    double sum = 0;
    for (const double width : widths) sum += width;
    return {least, sum / static_cast<double>(widths.size()), most};
}

class LineWidthOnWall : public LineStyles, public testing::WithParamInterface<const char*> {};

// The eye is at the scene's origin and off the room's centre; from there lines are straight, curved, near and
// far.
TEST_P(LineWidthOnWall, IsTheSameAllOverTheDisplayWhereResamplingSpreadsIt) {
    Wall wall = test::shippedWall(GetParam());
    wall.background = glm::vec3(0);
    RenderRequest request = test::requestFor(wall, gridRoom({-3, -2.5, -4}, {5, 4, 3.5}, 7, glm::vec3(0)));
    request.style = Style::wireframe;
    request.linearOutput = true;
    for (const int samples : {1, 4}) {
        request.samples = samples;
        const WidthsSeen piecewise = widthsSeen(request, frameOf(request));
        EXPECT_GT(piecewise.least, line_styles::kWireWidthPx - 0.25);
        EXPECT_LT(piecewise.most, line_styles::kWireWidthPx + 0.25);
        EXPECT_NEAR(piecewise.mean, line_styles::kWireWidthPx, 0.02);
        if (samples == 1) {
            RecordProperty("piecewise_least", std::to_string(piecewise.least));
            RecordProperty("piecewise_mean", std::to_string(piecewise.mean));
            RecordProperty("piecewise_most", std::to_string(piecewise.most));
        }
    }
    request.samples = 1;
    request.method = Method::imageBased;
    const WidthsSeen imageBased = widthsSeen(request, frameOf(request));
    EXPECT_GT(imageBased.most - imageBased.least, 0.5);
    RecordProperty("image_based_least", std::to_string(imageBased.least));
    RecordProperty("image_based_mean", std::to_string(imageBased.mean));
    RecordProperty("image_based_most", std::to_string(imageBased.most));
}

INSTANTIATE_TEST_SUITE_P(Walls, LineWidthOnWall,
                         testing::Values("full-cylinder", "dome-master", "view-deformation"),
                         [](const auto& wall) {
                             std::string name = wall.param;
                             std::ranges::replace(name, '-', '_');
                             return name;
                         });

TEST_F(LineStyles, SilhouettesAreAsWideAsOtherLines) {
    // A box ahead: of the edges around its shape only one side is seen.
    for (const Wall& wall : {test::fullCylinderWall({1600, 1200}), test::planarWall({800, 600}, 90)}) {
        RenderRequest request =
            test::requestFor(wall, gridRoom({-1, -0.8, -3.2}, {1.2, 0.9, -1.6}, 1, glm::vec3(0)));
        request.style = Style::wireframe;
        request.linearOutput = true;
        request.samples = 16;
        const Frame frame = frameOf(request);
        test::Random random(2);
        for (const double width :
             test::LineWidths(*request.scene, request.wall->displays[0]).measure(frame, 100, random))
            if (width > 0.01) {  // lines behind the box are hidden
                EXPECT_NEAR(width, line_styles::kWireWidthPx, 0.25) << wall.name;
            }
    }
}

TEST_F(LineStyles, AgreeWithTheReferenceAsFarAsThePiecesDo) {
    for (const char* scene : {"room", "city"})
        for (const Style style : kLineStyles) {
            RenderRequest request = test::requestFor(test::fullCylinderWall({800, 600}), loadScene(scene),
                                                     loadScene(scene).defaultCamera);
            request.style = style;
            EXPECT_LT(test::differenceFromReference(request).shareOff, 0.02) << scene;
            request.tolerancePx = 0.01;
            EXPECT_LT(test::differenceFromReference(request).shareOff, 0.0005) << scene;
        }
}

TEST_F(LineStyles, AgreeWithTheReferenceWhereOnePieceServesTheDisplay) {
    for (const Style style : kLineStyles) {
        RenderRequest request = test::requestFor(test::planarWall({800, 600}, 90), loadScene("city"),
                                                 loadScene("city").defaultCamera);
        request.style = style;
        EXPECT_LT(test::differenceFromReference(request).shareOff, 0.0005);
    }
}

// One triangle around the eye and below it: at most one corner lies ahead of any piece's screen.
TEST_F(LineStyles, TrianglesThatReachBehindTheEyeHaveTheirLines) {
    Scene scene;
    startMaterial(scene, plainMaterial({0.3, 0.4, 0.2}));
    addTriangle(scene, {glm::vec3(-5000, -2, 3000), glm::vec3(4000, -2, 4000), glm::vec3(0.5, -2, -9)});
    addTriangle(scene, {glm::vec3(-0.5, -1, -2), glm::vec3(0.5, 3, 30), glm::vec3(0.6, 3, 30)});
    for (const Wall& wall : {test::fullCylinderWall({800, 600}), test::planarWall({800, 600}, 120)})
        for (const Style style : kLineStyles) {
            RenderRequest request = test::requestFor(wall, scene);
            request.style = style;
            request.tolerancePx = 0.02;
            EXPECT_LT(test::differenceFromReference(request).shareOff, 0.0005) << wall.name;
        }
}

TEST_F(LineStyles, GoWithEveryKindOfMaterial) {
    Scene scene;
    Texture stripes = squareTexture(8, [](int, int size) {
        std::vector<glm::u8vec4> texels;
        for (int i = 0; i < size * size; ++i) {
            const bool clear = size > 1 && i % size >= size / 2;
            texels.emplace_back(200, 60, 20, clear ? 0 : 255);
        }
        return texels;
    });
    stripes.levels.resize(1);
    Material plain = plainMaterial({0.6, 0.5, 0.4}), masked = texturedMaterial(scene, stripes);
    masked.alphaCutoff = 0.5f;
    Material unlit = unlitMaterial({0.1, 0.5, 0.9}), singleSided = plain;
    singleSided.doubleSided = false;
    float x = -3;
    for (const Material& material : {plain, unlit, masked, singleSided, singleSided}) {
        startMaterial(scene, material);
        addFrontalSquare(scene, {x, 0, -3}, 1.2f);
        x += 1.5f;
    }
    for (auto last = scene.triangles.end() - 2; last != scene.triangles.end(); ++last)
        std::swap(last->y, last->z);
    for (const Wall& wall : {test::fullCylinderWall({1600, 1200}), test::planarWall({800, 600}, 110)})
        for (const Style style : kLineStyles) {
            RenderRequest request = test::requestFor(wall, scene);
            request.style = style;
            request.tolerancePx = 0.02;
            EXPECT_LT(test::differenceFromReference(request).shareOff, 0.0005) << wall.name;
        }
}

TEST_F(LineStyles, MoreSamplesComeNearerToTheConvergedPicture) {
    for (const Style style : kLineStyles) {
        RenderRequest request = test::requestFor(test::fullCylinderWall({200, 150}), loadScene("city:5000"),
                                                 {{0, 8, 0}, {0.3, 0, 0}});
        request.style = style;
        request.tolerancePx = 0.05;
        request.samples = 128;
        const Frame truth = test::referenceOf(request).frame;
        double nearer = 0;
        for (const int samples : {1, 4, 64}) {  // 64 are more than any driver has
            request.samples = samples;
            const double psnrDb = compareColor(frameOf(request), truth).psnrDb;
            EXPECT_GT(psnrDb, nearer + 1) << samples << " samples";
            nearer = psnrDb;
        }
    }
}

// Hatching knows the display's pixels and the tone alone: on an even surface it is the same at every pixel a
// period away, and has the same share of ink, in every piece.
TEST_F(LineStyles, HatchingIsEvenAllOverTheDisplay) {
    RenderRequest request = test::requestFor(test::shippedWall("view-deformation"),
                                             gridRoom({-3, -3, -3}, {3, 3, 3}, 1, glm::vec3(0.1f)));
    request.style = Style::penAndInk;
    request.linearOutput = true;
    const Frame frame = frameOf(request);
    const int period = static_cast<int>(line_styles::kHatchPeriodPx);
    int compared = 0, different = 0;
    for (int y = 0; y < frame.sizePx.y; ++y)
        for (int x = period; x < frame.sizePx.x; ++x, ++compared)
            different += std::abs(frame.at(x, y)[0] - frame.at(x - period, y)[0]) > 0.01f;
    EXPECT_LT(different, 0.02 * compared);  // the outlines of the box
}

TEST_F(LineStyles, DarkerSurfacesTakeMoreInk) {
    double before = 1.1;
    for (const float tone : {1.0f, 0.4f, 0.2f, 0.1f, 0.05f, 0.0f}) {
        RenderRequest request = test::requestFor(test::planarWall({100, 100}, 60),
                                                 gridRoom({-9, -9, -9}, {9, 9, 9}, 1, glm::vec3(tone)));
        request.style = Style::penAndInk;
        request.linearOutput = true;
        const Frame frame = frameOf(request);
        double light = 0;
        for (const float texel : frame.texels) light += texel / static_cast<double>(frame.texels.size());
        EXPECT_LT(light, before - 0.03) << tone;
        before = light;
    }
}

TEST_F(LineStyles, OtherOutputsDoNotKnowThem) {
    for (const OutputKind output : {OutputKind::depth, OutputKind::coverage, OutputKind::position}) {
        RenderRequest request = test::requestFor(test::fullCylinderWall({200, 150}), loadScene("room"));
        request.output = output;
        const Frame expected = frameOf(request);
        request.style = Style::wireframe;
        EXPECT_EQ(frameOf(request).texels, expected.texels);
    }
}

TEST_F(LineStyles, EdgesBetweenChunksHaveNeighboursToo) {
    // The two halves of a square, each in a chunk of its own: what lies beyond the diagonal is in the other.
    Scene halves[2];
    addQuad((startMaterial(halves[0], plainMaterial(glm::vec3(1))), halves[0]),
            {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(1, 1, 0), glm::vec3(0, 1, 0)});
    halves[1] = halves[0];
    halves[0].triangles.resize(1);
    halves[1].triangles.erase(halves[1].triangles.begin());
    const EglContext context;
    for (Scene& half : halves) half.ranges[0].triangleCount = 1;
    GpuScene scene = uploadScene(std::make_shared<const Scene>(halves[0]));
    GpuScene other = uploadScene(std::make_shared<const Scene>(halves[1]));
    scene.chunks.push_back(std::move(other.chunks[0]));
    uploadEdges(scene);
    for (const SceneChunk& chunk : scene.chunks) {
        std::array<uint32_t, 3> across{};
        glGetNamedBufferSubData(chunk.across.id(), 0, sizeof(across), across.data());
        EXPECT_EQ(std::ranges::count(across, 0x7fffffffu), 1);  // somewhere else, and no crease
        EXPECT_EQ(std::ranges::count(across, 0xffffffffu), 2);
    }
}

TEST(StrokeCoverage, SumsUpToTheWidthOfTheStroke) {
    for (const double widthPx : {0.1, 0.7, 1.0, 2.0, 3.3})
        for (const double footprintPx : {0.25, 1.0}) {
            double sum = 0;
            for (double across = -4; across < 4; across += 0.001)
                sum += 0.001 * line_styles::strokeCoverage(static_cast<float>(std::abs(across)),
                                                           static_cast<float>(widthPx),
                                                           static_cast<float>(footprintPx));
            EXPECT_NEAR(sum, widthPx, 0.002);
        }
}

}  // namespace
}  // namespace curvewall
