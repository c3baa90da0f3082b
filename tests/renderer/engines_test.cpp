// The engines put the same triangles into the same pieces, each in its own way. Compute and geometry draw the
// same pairs with the same programs, so that their pictures are the same to the byte. The others land corners
// in programs of their own, which may round their last bits otherwise.

#include "calibration/pieces/ownership.h"
#include "calibration/pieces/piece_fit.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/radial_lens.h"
#include "renderer/frame_target.h"
#include "renderer/geometry_replicator.h"
#include "renderer/names.h"
#include "renderer/pair_replicator.h"
#include "renderer/piecewise.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/broken_displays.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/rendering.h"
#include "tests/support/test_scenes.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

namespace curvewall {
namespace {

using test::kPi;
constexpr Engine kOthers[] = {Engine::geometry, Engine::tessellation, Engine::loop};

struct Case {
    Wall wall;
    double tolerancePx;
    int leastPieces;
};

Wall fisheyeWall(glm::ivec2 sizePx) {
    return wallOf(std::make_shared<LensProjection>(circularLens({RadialModel::equidistant, {}}, kPi, sizePx),
                                                   Orientation{0, kPi / 2, 0}),
                  sizePx);
}

// What a camera texture with unmeasured places gives: rays that bend, and none in a disc.
Wall bentWallWithHoles(glm::ivec2 sizePx) {
    const auto bend = [sizePx](glm::dvec2 px) {
        return 6.0 * glm::dvec2(std::sin(7 * px.y / sizePx.y), std::cos(5 * px.x / sizePx.x));
    };
    const auto inDisc = [sizePx](glm::dvec2 px) {
        return glm::length(px - glm::dvec2(sizePx) / 3.0) < 0.15 * sizePx.y;
    };
    return wallOf(std::make_shared<RayFunctionProjection>(
                      test::withHoles(test::displaced(test::flatRays(sizePx), bend), inDisc)),
                  sizePx);
}

std::vector<Case> cases() {
    return {{test::fullCylinderWall({320, 240}), 0.05, 70},
            {fisheyeWall({240, 240}), 0.05, 100},
            {bentWallWithHoles({320, 240}), 0.05, 100}};
}

// A tilted pane of glass, large enough to lie in many pieces.
void addPane(Scene& scene, glm::vec4 color, Blending blending, glm::vec3 centreM, float tilt) {
    Material material = plainMaterial(glm::vec3(color));
    material.baseColor.a = color.a;
    material.blending = blending;
    material.unlit = true;
    startMaterial(scene, material);
    const glm::vec3 right(2, 0, 2 * tilt), up(0, 2, tilt);
    addQuad(scene, {centreM - right - up, centreM + right - up, centreM + right + up, centreM - right + up});
}

// Before a wall, given in another order than that of their distance from any eye.
Scene glassScene() {
    Scene scene;
    startMaterial(scene, plainMaterial({0.8, 0.8, 0.8}));
    addFrontalSquare(scene, {0, 0, -6}, 12);
    addPane(scene, {0.1, 0.2, 0.9, 0.6}, Blending::alpha, {0.5, 0, -3}, 0.1f);
    addPane(scene, {0.9, 0.1, 0.1, 0.5}, Blending::alpha, {-0.7, 0.3, -4}, -0.1f);
    addPane(scene, {0.1, 0.3, 0.1, 0.5}, Blending::additive, {0, -0.5, -2}, 0.05f);
    addPane(scene, {0.3, 0.8, 0.2, 0.4}, Blending::alpha, {0.2, 0.6, 3}, 0.2f);
    return scene;
}

// Boxes in one another: all of them touch every piece, and the smallest hides the rest.
Scene nestedRooms(int count) {
    Scene scene;
    for (int i = 0; i < count; ++i) {
        const Scene box = boxRoom(glm::vec3(3, 2, 3) * (1 + 0.02f * static_cast<float>(i)));
        const auto firstVertex = static_cast<uint32_t>(scene.positions.size());
        const auto firstTriangle = static_cast<uint32_t>(scene.triangles.size());
        const auto firstMaterial = static_cast<uint32_t>(scene.materials.size());
        scene.positions.insert(scene.positions.end(), box.positions.begin(), box.positions.end());
        scene.normals.insert(scene.normals.end(), box.normals.begin(), box.normals.end());
        scene.uvs.insert(scene.uvs.end(), box.uvs.begin(), box.uvs.end());
        scene.materials.insert(scene.materials.end(), box.materials.begin(), box.materials.end());
        for (const glm::uvec3& triangle : box.triangles) scene.triangles.push_back(triangle + firstVertex);
        for (MaterialRange range : box.ranges) {
            range.material += firstMaterial;
            range.firstTriangle += firstTriangle;
            scene.ranges.push_back(range);
        }
    }
    return scene;
}

// NaN is what a position is where nothing is shown.
bool sameBytes(const Frame& a, const Frame& b) {
    return a.texels.size() == b.texels.size() &&
           std::memcmp(a.texels.data(), b.texels.data(), sizeof(float) * a.texels.size()) == 0;
}

// Texels that differ by more than rounding makes them: a share of what they are, and of a metre.
int farApart(const Frame& a, const Frame& b) {
    constexpr double kShare = 1e-4;
    int count = 0;
    for (size_t i = 0; i < a.texels.size(); ++i) {
        const double x = a.texels[i], y = b.texels[i];
        if (std::isfinite(x) && std::isfinite(y))
            count += std::abs(x - y) > kShare * std::max(1.0, std::abs(x));
        else
            count += std::isnan(x) != std::isnan(y) || std::isinf(x) != std::isinf(y);
    }
    return count;
}

class Engines : public test::GlTest {
protected:
    Frame render(RenderRequest request, Engine engine) {
        request.engine = engine;
        RenderResult result = renderer_.render(request);
        EXPECT_EQ(result.stats.engine, nameOf(engine));
        pairs_ = result.stats.pairs;
        pieces_ = result.stats.pieces;
        return std::move(result.frame);
    }

    // Along seams, where the guards of two pieces show the same point at the same depth, what is drawn first
    // stays, and each engine has its own order of pieces.
    void expectAlike(const RenderRequest& request, double mostShareAtSeams = 0) {
        const Frame expected = render(request, Engine::compute);
        const uint64_t pairs = pairs_;
        for (const Engine engine : kOthers) {
            SCOPED_TRACE(nameOf(engine));
            const Frame frame = render(request, engine);
            if (engine == Engine::geometry || request.output == OutputKind::coverage) {
                EXPECT_TRUE(sameBytes(frame, expected));
            } else {
                EXPECT_LE(farApart(frame, expected),
                          mostShareAtSeams * static_cast<double>(frame.texels.size()));
            }
            if (engine != Engine::loop) {
                EXPECT_EQ(pairs_, pairs);
            }
        }
    }

    Renderer renderer_;
    uint64_t pairs_ = 0;
    int pieces_ = 0;
};

TEST_F(Engines, GiveTheSameImage) {
    for (const Case& c : cases()) {
        for (const char* scene : {"room", "city:2000"}) {
            for (const OutputKind output :
                 {OutputKind::color, OutputKind::depth, OutputKind::coverage, OutputKind::position}) {
                SCOPED_TRACE(c.wall.name + " " + c.wall.displays[0].projectionType + " " + scene +
                             " output " + std::to_string(static_cast<int>(output)));
                RenderRequest request = test::requestFor(c.wall, loadScene(scene));
                request.camera = request.scene->defaultCamera;
                request.camera.orientation.yawRad = 0.7;
                request.tolerancePx = c.tolerancePx;
                request.output = output;
                request.linearOutput = true;
                expectAlike(request, 1e-3);
                EXPECT_GE(pieces_, c.leastPieces);
            }
        }
    }
}

TEST_F(Engines, GiveTheSameImageOfManySamples) {
    // Four are the hardware's, 65 more than any driver has: shifted passes.
    for (const int samples : {4, 65}) {
        RenderRequest request = test::requestFor(fisheyeWall({100, 100}), loadScene("city:2000"));
        request.camera = request.scene->defaultCamera;
        request.samples = samples;
        request.linearOutput = true;
        expectAlike(request, 0.01);
    }
}

TEST_F(Engines, MixTransparentTrianglesFarToNear) {
    for (const Case& c : cases()) {
        for (const int samples : {1, 4}) {
            for (const glm::dvec3 eye : {glm::dvec3(0), glm::dvec3(0.3, 0.2, -5)}) {
                SCOPED_TRACE(c.wall.displays[0].projectionType + " " + std::to_string(samples));
                RenderRequest request = test::requestFor(c.wall, glassScene(), {eye, {}});
                request.tolerancePx = c.tolerancePx;
                request.samples = samples;
                request.linearOutput = true;
                expectAlike(request);
            }
        }
    }
}

// Programs with transparent triangles keep an order that changes with the eye.
TEST_F(Engines, FollowAnEyeThatMovesThroughTransparentTriangles) {
    const ScenePtr glass = std::make_shared<const Scene>(glassScene());
    RenderRequest request;
    request.wall = std::make_shared<const Wall>(test::fullCylinderWall({320, 240}));
    request.scene = glass;
    request.linearOutput = true;
    for (int i = 0; i < 6; ++i) {
        request.camera.positionM = {0.1 * i, 0, -1.1 * i};
        expectAlike(request);
    }
}

// One frame drawn piece by piece over a mesh made by hand.
class EnginesOnMeshes : public test::GlTest {
protected:
    struct Drawn {
        Frame frame;
        uint64_t pairs = 0;
        int attempts = 0;
    };

    void SetUp() override {
        test::GlTest::SetUp();
        if (!IsSkipped() && !HasFatalFailure()) context_.emplace();
    }

    static PieceMesh fineMesh(const Wall& wall, int columns, int rows) {
        const Display& display = wall.displays[0];
        PieceGrid grid{display.sizePx, columns, rows, {}};
        for (int y = 0; y <= rows; ++y) {
            for (int x = 0; x <= columns; ++x) {
                const glm::dvec2 s =
                    glm::dvec2(display.sizePx) * glm::dvec2(x, y) / glm::dvec2(columns, rows);
                grid.vertices.push_back({*display.projection->unproject(s), s});
            }
        }
        return meshFromGrid(grid, true);
    }

    // Draws until everything has room, as the renderer does.
    static Drawn draw(const PieceMesh& mesh, const GpuScene& scene, Engine engine, OutputKind output,
                      std::unique_ptr<Replicator> replicator) {
        const GpuPieces pieces = uploadPieces(mesh);
        const GpuOwners owners = uploadOwners(ownerImage(mesh), mesh.sizePx);
        SceneReplicators replicators{engine, std::move(replicator), nullptr};
        PiecewiseRenderer renderer(scene, pieces, &replicators, {Style::unlit, output}, {&owners, nullptr});
        const FrameTarget target(mesh.sizePx, {output, true}, 1);
        Drawn drawn;
        for (FrameOutcome outcome{.overflowed = true}; outcome.overflowed; ++drawn.attempts) {
            target.begin({});
            renderer.record(sceneViewOf({}, {}, *scene.scene));
            glFinish();
            outcome = renderer.finishFrame();
            drawn.pairs = outcome.pairCount;
        }
        drawn.frame = target.read();
        replicator_ = std::move(replicators.opaque);
        return drawn;
    }

    static Drawn draw(const PieceMesh& mesh, const GpuScene& scene, Engine engine, OutputKind output) {
        return draw(mesh, scene, engine, output, makeReplicator(engine, scene.chunks));
    }

    // The pairs that a replicator holds after its frame.
    static std::vector<glm::uvec2> read(const GlBuffer& buffer, uint64_t count) {
        std::vector<glm::uvec2> pairs(count);
        glGetNamedBufferSubData(buffer.id(), 0, static_cast<GLsizeiptr>(sizeof(glm::uvec2) * count),
                                pairs.data());
        return pairs;
    }

    void TearDown() override {
        replicator_.reset();
        context_.reset();
    }

    inline static std::unique_ptr<Replicator> replicator_;  // the one that drew last
    std::optional<EglContext> context_;
};

GpuScene onGpu(Scene scene) { return uploadScene(std::make_shared<const Scene>(std::move(scene))); }

TEST_F(EnginesOnMeshes, AreExactWhereATriangleTouchesThousandsOfPieces) {
    const Wall wall = test::planarWall({400, 300}, 100);
    // More than a point's worth, more than a line's of the tessellator, more than one patch's.
    for (const glm::ivec2 cells : {glm::ivec2(2, 1), {8, 8}, {11, 6}, {25, 20}, {100, 60}}) {
        const PieceMesh mesh = fineMesh(wall, cells.x, cells.y);
        const auto pieces = static_cast<uint64_t>(cells.x) * static_cast<uint64_t>(cells.y);
        Scene scene;
        startMaterial(scene, plainMaterial({0.2, 0.5, 0.9}));
        addTriangle(scene, {glm::vec3(-100, -50, -5), {100, -50, -5}, {0, 90, -5}});
        const GpuScene gpu = onGpu(std::move(scene));
        for (const Engine engine : {Engine::compute, Engine::geometry, Engine::tessellation}) {
            SCOPED_TRACE(std::string(nameOf(engine)) + " " + std::to_string(pieces));
            const Drawn drawn = draw(mesh, gpu, engine, OutputKind::coverage);
            EXPECT_EQ(drawn.pairs, pieces);
            EXPECT_EQ(std::ranges::count(drawn.frame.texels, 1.0f), 400 * 300);
        }
    }
}

TEST_F(EnginesOnMeshes, DrawTheSamePairs) {
    const Wall wall = test::fullCylinderWall({320, 240});
    const FittedPieces cylinder = fitPieces(*wall.displays[0].projection, {320, 240}, 0.05);
    const PieceMesh fine = fineMesh(test::planarWall({400, 300}, 100), 100, 60);
    for (const PieceMesh* mesh : {&cylinder.mesh, &fine}) {
        for (const char* name : {"room", "city:20000"}) {
            const GpuScene scene = onGpu(loadScene(name));
            const Drawn byCompute = draw(*mesh, scene, Engine::compute, OutputKind::color);
            const auto expected =
                read(dynamic_cast<PairReplicator&>(*replicator_).coverage().pairs(), byCompute.pairs);
            const Drawn byGeometry = draw(*mesh, scene, Engine::geometry, OutputKind::color);
            ASSERT_EQ(byGeometry.pairs, byCompute.pairs) << name;
            EXPECT_EQ(read(dynamic_cast<GeometryReplicator&>(*replicator_).pairs(), byGeometry.pairs),
                      expected);
            EXPECT_EQ(byGeometry.frame.texels, byCompute.frame.texels);
        }
    }
}

TEST_F(EnginesOnMeshes, GrowUntilEveryPairHasRoom) {
    const PieceMesh mesh = fineMesh(test::planarWall({400, 300}, 100), 40, 25);
    const GpuScene scene = onGpu(nestedRooms(70));
    const Drawn expected = draw(mesh, scene, Engine::compute, OutputKind::color);
    EXPECT_GT(expected.attempts, 1);
    EXPECT_GT(expected.pairs, 1u << 16);
    const Drawn grown = draw(mesh, scene, Engine::geometry, OutputKind::color);
    EXPECT_GT(grown.attempts, 1);
    EXPECT_EQ(grown.pairs, expected.pairs);
    EXPECT_EQ(grown.frame.texels, expected.frame.texels);
    const Drawn tessellated = draw(mesh, scene, Engine::tessellation, OutputKind::color);
    EXPECT_EQ(tessellated.attempts, 1);
    EXPECT_EQ(tessellated.pairs, expected.pairs);
    EXPECT_LE(farApart(tessellated.frame, expected.frame), 0);
}

// Two passes make one frame, and the first has all the pairs.
TEST_F(EnginesOnMeshes, NoticeThatAnEarlierPassHadNoRoom) {
    const PieceMesh mesh = fineMesh(test::planarWall({400, 300}, 100), 40, 25);
    const GpuPieces pieces = uploadPieces(mesh);
    const GpuScene scene = onGpu(nestedRooms(70));
    for (const Engine engine : {Engine::compute, Engine::geometry}) {
        SceneReplicators replicators = makeReplicators(engine, scene);
        PiecewiseRenderer renderer(scene, pieces, &replicators, {Style::unlit, OutputKind::color});
        const FrameTarget target(mesh.sizePx, {}, 1);
        target.begin({});
        renderer.record(sceneViewOf({}, {}, *scene.scene));
        renderer.record(sceneViewOf({{0, 0, -100}, {}}, {}, *scene.scene));
        glFinish();
        EXPECT_TRUE(renderer.finishFrame().overflowed) << nameOf(engine);
    }
}

TEST_F(EnginesOnMeshes, GeometryDrawsAFrameInParts) {
    const Wall wall = test::fullCylinderWall({400, 300});
    const FittedPieces fitted = fitPieces(*wall.displays[0].projection, {400, 300}, 0.25);
    const GpuScene scene = onGpu(loadScene("city:20000"));
    const Drawn whole = draw(fitted.mesh, scene, Engine::geometry, OutputKind::color);
    EXPECT_EQ(whole.attempts, 1);
    const Drawn parted = draw(fitted.mesh, scene, Engine::geometry, OutputKind::color,
                              std::make_unique<GeometryReplicator>(scene.chunks, 3000));
    EXPECT_GT(parted.attempts, 1);
    EXPECT_GT(dynamic_cast<GeometryReplicator&>(*replicator_).parts().size(), 4u);
    EXPECT_EQ(whole.pairs, parted.pairs);
    EXPECT_EQ(whole.frame.texels, parted.frame.texels);
}

}  // namespace
}  // namespace curvewall
