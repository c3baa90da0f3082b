#include "renderer/stroke_renderer.h"

#include "calibration/pieces/piece_fit.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/radial_lens.h"
#include "renderer/image_compare.h"
#include "renderer/piecewise.h"
#include "renderer/reference.h"
#include "renderer/sampled_target.h"
#include "renderer/strokes.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/random_numbers.h"
#include "tests/support/test_scenes.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace curvewall {
namespace {

// A wall with its pieces.
struct Fitted {
    Wall wall;
    FittedPieces pieces;

    const Display& display() const { return wall.displays.front(); }
};

// At this tolerance hardly a pixel's centre lies between a stroke's border and where the pieces put it.
constexpr double kTolerancePx = 0.04;

Fitted fitted(Wall wall) {
    FittedPieces pieces = fitPieces(wall.displays.front(), kTolerancePx);
    return {std::move(wall), std::move(pieces)};
}

// Fitted once for all tests.
const Fitted& cylinder() {
    static const Fitted on = fitted(test::fullCylinderWall({320, 240}));
    return on;
}

// A dome master: pieces of many shapes, and holes around them.
const Fitted& fisheye() {
    static const Fitted on = [] {
        const glm::ivec2 sizePx(240, 240);
        const auto lens =
            std::make_shared<LensProjection>(circularLens({}, test::kPi, sizePx), Orientation{});
        return fitted({"dome", {}, {}, {{"master", sizePx, "radial", lens}}});
    }();
    return on;
}

const Fitted& planar() {
    static const Fitted on = fitted(test::planarWall({400, 300}, 80));
    return on;
}

struct Drawing {
    const Fitted& on;
    SceneLook look{Style::unlit, OutputKind::color};
    int samples = 1;
    Camera camera{};
};

// The scene's surfaces and strokes, as a frame draws them.
Frame draw(const Drawing& drawing, const Scene& content) {
    const auto scene = std::make_shared<const Scene>(content);
    const glm::ivec2 sizePx = drawing.on.display().sizePx;
    const GpuPieces pieces = uploadPieces(drawing.on.pieces.mesh);
    const StrokePieces strokePieces = uploadStrokePieces(drawing.on.pieces.mesh);
    const GpuOwners owners = uploadOwners(*drawing.on.pieces.owners, sizePx);
    const GpuScene gpu = uploadScene(scene);
    SceneReplicators replicators = makeReplicators(Engine::compute, gpu);
    PiecewiseRenderer renderer(gpu, pieces, &replicators, drawing.look, {&owners, nullptr});
    if (gpu.strokes)
        renderer.addStrokes(
            std::make_unique<StrokeRenderer>(gpu, *gpu.strokes, strokePieces, drawing.look, &owners));
    const SampledTarget target(sizePx, {drawing.look.output, true}, drawing.samples);
    const SceneView view = sceneViewOf(drawing.camera, drawing.on.wall.eyeM, *scene);
    for (bool isDone = false; !isDone;) {
        target.draw(drawing.on.wall.background,
                    [&](const FramePass& pass) { renderer.record(view, pass); });
        glFinish();
        isDone = !renderer.finishFrame().overflowed;
    }
    return target.picture().read();
}

Frame expected(const Drawing& drawing, const Scene& content) {
    return ReferenceRenderer(std::make_shared<const Scene>(content))
        .render(drawing.on.wall, drawing.on.display(), drawing.camera,
                {drawing.look.style, drawing.look.output, drawing.samples});
}

struct Counts {
    int shown = 0, wrong = 0;
};

Counts compare(const Frame& frame, const Frame& truth, float tolerance = 1e-3f) {
    Counts counts;
    const auto channels = static_cast<size_t>(frame.channels);
    for (size_t i = 0; i < frame.texels.size(); i += channels) {
        counts.shown += truth.texels[i] != 0 && std::isfinite(truth.texels[i]);
        const auto isOff = [&](size_t k) {
            const float a = frame.texels[k], b = truth.texels[k];
            return a != b && !(std::abs(a - b) <= tolerance);
        };
        bool isWrong = false;
        for (size_t c = 0; c < channels; ++c) isWrong = isWrong || isOff(i + c);
        counts.wrong += isWrong;
    }
    return counts;
}

// About `count` edges of the pieces: what the display shows there, some metres away.
std::vector<std::array<glm::vec3, 2>> seams(const Fitted& on, size_t count) {
    std::vector<std::array<glm::vec3, 2>> lines;
    const PieceMesh& mesh = on.pieces.mesh;
    for (size_t i = 0; i < mesh.pieces.size(); i += mesh.pieces.size() / count + 1) {
        const Piece& piece = mesh.pieces[i];
        const PieceEdge edge = edgesOf(mesh, piece).back();
        const auto at = [&](uint32_t vertex) {
            return glm::vec3(3.0 * glm::normalize(mesh.vertices[piece.vertices[vertex]].m));
        };
        lines.push_back({at(edge.from), at(edge.to)});
    }
    return lines;
}

class Strokes : public test::GlTest {
protected:
    void SetUp() override {
        test::GlTest::SetUp();
        if (!IsSkipped()) context_.emplace();
    }

private:
    std::optional<EglContext> context_;
};

const Material kWhite = plainMaterial(glm::vec3(1));

// Pixels that differ from the reference are those whose centre is within the pieces' error of a stroke's
// border.
void expectAgreement(const Frame& frame, const Frame& truth, double share, float tolerance = 1e-3f) {
    const Counts counts = compare(frame, truth, tolerance);
    EXPECT_GT(counts.shown, 100);
    EXPECT_LT(counts.wrong, share * counts.shown) << "of " << counts.shown;
}

TEST_F(Strokes, LinesThroughAllPiecesAgreeWithTheReference) {
    test::Random random(1);
    std::vector<std::array<glm::vec3, 2>> lines;
    lines.reserve(30);
    for (int i = 0; i < 30; ++i) lines.push_back({glm::vec3(random.inBox(4)), glm::vec3(random.inBox(4))});
    Scene scene;
    addLines(scene, kWhite, lines);
    for (const Fitted* on : {&cylinder(), &fisheye(), &planar()}) {
        for (const OutputKind output : {OutputKind::color, OutputKind::coverage}) {
            const Drawing drawing{*on, {Style::unlit, output}};
            expectAgreement(draw(drawing, scene), expected(drawing, scene), 0.02);
        }
        // Where lines cross or run away from the eye a hundredth of a pixel is a step in depth.
        const Drawing drawing{*on, {Style::unlit, OutputKind::depth}};
        expectAgreement(draw(drawing, scene), expected(drawing, scene), 0.03, 0.02f);
    }
}

TEST_F(Strokes, StrokesOnSeamsAgreeWithTheReference) {
    test::Random random(5);
    for (const Fitted* on : {&cylinder(), &fisheye()}) {
        const std::vector<std::array<glm::vec3, 2>> lines = seams(*on, 100);
        Scene edges, places;
        std::vector<std::array<glm::vec3, 2>> middles;  // ends on corners are a matter of rounding
        middles.reserve(lines.size());
        for (const auto& [from, to] : lines)
            middles.push_back({glm::mix(from, to, 0.1f), glm::mix(from, to, 0.9f)});
        addLines(edges, kWhite, middles);
        std::vector<glm::vec3> points;
        points.reserve(lines.size());
        for (const auto& [from, to] : lines)
            points.push_back(glm::mix(from, to, static_cast<float>(random.uniform(0, 1))));
        addPoints(places, kWhite, points);
        for (const OutputKind output : {OutputKind::color, OutputKind::coverage}) {
            const Drawing drawing{*on, {Style::unlit, output}};
            expectAgreement(draw(drawing, edges), expected(drawing, edges), 0.02);
            expectAgreement(draw(drawing, places), expected(drawing, places), 0.06);
        }
    }
}

// On a full turn, what is near the border shows on both sides.
TEST_F(Strokes, DiscsAtTheBorderAreWhole) {
    test::Random random(7);
    const Fitted& on = cylinder();
    const glm::dvec2 sizePx(on.display().sizePx);
    std::vector<glm::vec3> points;
    for (double y = 5; y < sizePx.y - 5; y += 5) {
        const double x = random.uniform(-1.4, 1.4);
        points.push_back(glm::vec3(5.0 * *on.display().projection->unproject({x < 0 ? x + sizePx.x : x, y})));
    }
    for (double x = 5; x < sizePx.x - 5; x += 5)
        points.push_back(glm::vec3(*on.display().projection->unproject({x, random.uniform(-1.2, 1)})));
    Scene scene;
    addPoints(scene, kWhite, points);
    for (const OutputKind output : {OutputKind::color, OutputKind::coverage}) {
        const Drawing drawing{on, {Style::unlit, output}};
        expectAgreement(draw(drawing, scene), expected(drawing, scene), 0.08);
    }
}

TEST_F(Strokes, ALineIsCountedOnceAtAPixel) {
    test::Random random(2);
    for (const Fitted* on : {&cylinder(), &fisheye()}) {
        int shown = 0, twice = 0;
        for (int i = 0; i < 8; ++i) {
            Scene scene;
            const glm::vec3 ahead(random.direction()), across(random.inBox(3));
            addLines(scene, kWhite, {{3.0f * ahead - across, 3.0f * ahead + across}});
            for (const float count : draw({*on, {Style::unlit, OutputKind::coverage}}, scene).texels) {
                shown += count > 0;
                twice += count > 1;
            }
        }
        EXPECT_GT(shown, 300);
        EXPECT_LT(twice, 0.005 * shown) << "of " << shown;
    }
}

TEST_F(Strokes, DiscsAreAsLargeAsTheReferencesWhereverTheyAre) {
    test::Random random(3);
    for (const Fitted* on : {&cylinder(), &fisheye()}) {
        const glm::ivec2 sizePx = on->display().sizePx;
        // Apart from each other, so that each can be counted.
        std::vector<glm::dvec2> centres;
        Scene scene;
        std::vector<glm::vec3> points;
        for (int y = 8; y < sizePx.y; y += 12)
            for (int x = 8; x < sizePx.x; x += 12) {
                const glm::dvec2 px = glm::dvec2(x, y) + random.uniform(0, 2);
                const auto ray = on->display().projection->unproject(px);
                if (!ray) continue;
                centres.push_back(px);
                points.push_back(glm::vec3(random.uniform(1, 50) * glm::normalize(*ray)));
            }
        addPoints(scene, kWhite, points);
        const Drawing drawing{*on, {Style::unlit, OutputKind::coverage}};
        const Frame frame = draw(drawing, scene), truth = expected(drawing, scene);
        int differing = 0;
        for (const glm::dvec2 centre : centres) {
            float drawn = 0, right = 0;
            const glm::ivec2 low = glm::max(glm::ivec2(centre) - 4, 0),
                             high = glm::min(glm::ivec2(centre) + 5, sizePx);
            for (int y = low.y; y < high.y; ++y)
                for (int x = low.x; x < high.x; ++x) {
                    drawn += *frame.at(x, y);
                    right += *truth.at(x, y);
                }
            EXPECT_GE(drawn, 1);
            EXPECT_NEAR(drawn, right, 2) << centre.x << ' ' << centre.y;
            differing += drawn != right;
        }
        EXPECT_LT(differing, 0.2 * static_cast<double>(centres.size()));
    }
}

TEST_F(Strokes, SurfacesHideThemAndTheyMixAsSurfacesDo) {
    test::Random random(4);
    Scene scene = boxRoom({8, 5, 8});
    Material glass = plainMaterial({0.2f, 1, 0.5f}), light = plainMaterial({0.5f, 0.1f, 0});
    glass.baseColor.a = 0.4f;
    glass.blending = Blending::alpha;
    light.baseColor.a = 0.5f;
    light.blending = Blending::additive;
    std::vector<std::array<glm::vec3, 2>> solid, lights;
    for (int i = 0; i < 40; ++i) solid.push_back({glm::vec3(random.inBox(6)), glm::vec3(random.inBox(6))});
    for (int i = 0; i < 20; ++i) lights.push_back({glm::vec3(random.inBox(3)), glm::vec3(random.inBox(3))});
    addLines(scene, kWhite, solid);
    addLines(scene, light, lights);
    addPoints(scene, glass, {glm::vec3(1, 0.5f, -2), glm::vec3(-1, 0.7f, 1.2f), glm::vec3(0.3f, -0.4f, 2)});
    for (const Fitted* on : {&cylinder(), &fisheye(), &planar()})
        for (const OutputKind output : {OutputKind::color, OutputKind::depth}) {
            const Drawing drawing{*on, {Style::unlit, output}};
            const Frame frame = draw(drawing, scene), truth = expected(drawing, scene);
            const Counts counts = compare(frame, truth, output == OutputKind::depth ? 0.02f : 2e-3f);
            EXPECT_LT(counts.wrong, 0.002 * counts.shown);
        }
}

TEST_F(Strokes, SamplesSmoothTheirBorders) {
    test::Random random(6);
    std::vector<std::array<glm::vec3, 2>> lines;
    lines.reserve(10);
    for (int i = 0; i < 10; ++i) lines.push_back({glm::vec3(random.inBox(4)), glm::vec3(random.inBox(4))});
    Scene scene;
    addLines(scene, kWhite, lines);
    Drawing drawing{cylinder()};
    drawing.samples = 256;
    const Frame truth = expected(drawing, scene);
    double nearer = 0;
    for (const int samples : {1, 4, 64}) {
        drawing.samples = samples;
        const double psnrDb = compareColor(draw(drawing, scene), truth).psnrDb;
        EXPECT_GT(psnrDb, nearer + 2) << samples << " samples";
        nearer = psnrDb;
    }
}

// Half of the line's texture is another colour, and its normals turn.
TEST_F(Strokes, TexturesAndLightAgreeWithTheReference) {
    Scene scene;
    const Texture halves = squareTexture(4, [](int, int size) {
        std::vector<glm::u8vec4> texels;
        texels.reserve(static_cast<size_t>(size) * static_cast<size_t>(size));
        for (int i = 0; i < size * size; ++i)
            texels.push_back(i % size < size / 2 ? glm::u8vec4(255, 0, 0, 255) : glm::u8vec4(0, 0, 255, 255));
        return texels;
    });
    Material material = texturedMaterial(scene, halves);
    material.unlit = false;
    addLines(scene, material,
             {{glm::vec3(-4, 1, -4), glm::vec3(1, 0.2f, -1)}, {glm::vec3(2, -1, 3), glm::vec3(-3, 1, 1)}});
    for (size_t i = 0; i < scene.normals.size(); ++i)
        scene.normals[i] = glm::normalize(glm::vec3(i % 2 == 0 ? 1 : -1, 1, 0.5f));
    const Drawing drawing{cylinder(), {Style::textured, OutputKind::color}};
    expectAgreement(draw(drawing, scene), expected(drawing, scene), 0.05, 0.02f);
}

TEST_F(Strokes, OneMaskedOrFarTooNearIsNotDrawn) {
    Material masked = kWhite;
    masked.baseColor.a = 0.4f;
    masked.alphaCutoff = 0.5f;
    Scene scene;
    addPoints(scene, masked, {glm::vec3(0, 0, -2)});
    addPoints(scene, kWhite, {glm::vec3(0, 0, -1e-6f)});
    const Drawing drawing{cylinder(), {Style::unlit, OutputKind::coverage}};
    const auto drawn = [&] {
        const Frame frame = draw(drawing, scene);
        return std::ranges::count_if(frame.texels, [](float count) { return count > 0; });
    };
    EXPECT_EQ(drawn(), 0);
    scene.materials[0].alphaCutoff = 0.3f;
    EXPECT_GE(drawn(), 4);
}

}  // namespace
}  // namespace curvewall
