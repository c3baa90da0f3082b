// Every kind of projection, read from a wall file, by every method, against the reference and its own
// certificate. About 60 s of one core with a software OpenGL.

#include "calibration/pieces/piece_fit.h"
#include "renderer/scene/load_scene.h"
#include "tests/hard_cases/wall_files.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/rendering.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace curvewall {
namespace {

using nlohmann::json;
using test::mapOf;
constexpr glm::ivec2 kWidePx(320, 240), kSquarePx(256, 256);

struct Kind {
    std::string name;
    glm::ivec2 sizePx;
    json projection;
    glm::dvec3 eyeM{0};
    bool hasHoles = false;
};

void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

std::string shippedMap(const std::string& name) { return CURVEWALL_SOURCE_DIR "/configs/maps/" + name; }

glm::dvec3 bentOffsets(glm::dvec2 at) {
    const glm::dvec2 c = at - 0.5;
    return {320 * (-0.10 * c.x * (4 * c.x * c.x - 1) + 0.02 * c.y),
            240 * (0.14 * c.y * (1 - 4 * c.x * c.x) - 0.03 * c.x * (1 - 2 * c.x)), 0};
}

json radial(const std::string& model, double fovDeg) {
    json projection = {{"type", "radial"}, {"model", model}, {"fov_deg", fovDeg}, {"pitch_deg", 25}};
    if (model == "polynomial") projection["coefficients"] = {1, 0, -0.08, 0, 0.004};
    return projection;
}

json onSphere(json projection, glm::dvec3 centreM) {
    projection["center"] = {centreM.x, centreM.y, centreM.z};
    projection["surface"] = {{"type", "sphere"}, {"center", {0, 0, 0}}, {"radius", 4.0}};
    return projection;
}

std::vector<Kind> kinds() {
    const json cylinder = {{"type", "cylinder"}, {"radius", 2.0}, {"arc_deg", 360}, {"height", 9.42477796}};
    const json arc = {{"type", "cylinder"}, {"radius", 3.0}, {"arc_deg", 200}, {"height", 2.6}};
    const json pinhole = {{"type", "camera"},
                          {"model", "pinhole"},
                          {"focal_px", {200.4, 198.9}},
                          {"principal_px", {162.3, 117.8}},
                          {"distortion",
                           {-0.2, 0.05, 0.0008, -0.0005, -0.004, 0.02, 0.01, 0.001, 0.002, -0.001, 0.0015,
                            0.0005, 0.02, -0.03}}};
    const json fisheye = {{"type", "camera"},
                          {"model", "fisheye"},
                          {"focal_px", {104.6, 103.8}},
                          {"principal_px", {159.1, 120.7}},
                          {"distortion", {0.021, -0.0063, 0.0012, -0.0002}}};
    const json dome = {{"type", "radial"}, {"model", "equidistant"}, {"fov_deg", 180}, {"pitch_deg", 30}};
    const json warp = {{"type", "warp_mesh"},
                       {"source_origin", "bottom_left"},
                       {"source", {{"size", {1024, 1024}}, {"projection", dome}}}};
    json warpGrid = warp, warpTriangles = warp;
    warpGrid.update({{"mesh", shippedMap("dome-warp.json")}, {"screen_units", "aspect"}});
    warpTriangles.update({{"mesh", "triangles.json"}, {"screen_units", "normalized"}});
    json warpBilinear = warpGrid;
    warpBilinear["interpolation"] = "bilinear";
    json measured = test::surfaceMap(shippedMap("curved-screen.pfm"), "centers");
    measured["units"] = "cm";

    std::vector<Kind> all{
        {"Planar",
         kWidePx,
         {{"type", "planar"},
          {"lower_left", {-1.2, -0.7, -1}},
          {"lower_right", {1, -0.75, -1.3}},
          {"upper_left", {-1.1, 0.8, -0.9}}}},
        {"CylinderOnAxis", kWidePx, cylinder},
        {"CylinderOffAxis", kWidePx, arc, {0.8, 0.3, 0.9}},
        {"RadialOnASphereOffCentre",
         kSquarePx,
         onSphere(radial("equidistant", 170), {0.3, -0.2, 0.1}),
         {1.5, -0.5, 1},
         true},
        {"Equirectangular",
         kWidePx,
         {{"type", "equirectangular"}, {"horizontal_fov_deg", 360}, {"vertical_fov_deg", 180}}},
        {"SphereSlices",
         kSquarePx,
         {{"type", "sphere_slices"}, {"horizontal_fov_deg", 180}, {"vertical_fov_deg", 180}}},
        {"Curvilinear", kWidePx, {{"type", "curvilinear"}, {"fov_deg", 130}}},
        {"CameraPinholeWithFourteenCoefficients", kWidePx, pinhole},
        {"CameraFisheye", kWidePx, fisheye},
        {"CameraOnASphere", kWidePx, onSphere(pinhole, {0.5, -1, 2.5}), {0.2, 0.1, 0}},
        {"CameraTextureForward", kWidePx, test::cameraTexture("offsets.pfm", "forward"), {}, true},
        {"CameraTextureInverse", kWidePx, test::cameraTexture("offsets.pfm", "inverse")},
        {"SurfaceMap", kWidePx, measured},
        {"SurfaceMapFromAnotherEye", kWidePx, measured, {0.9, 0.3, -0.8}},
        {"WarpMeshGrid", kWidePx, warpGrid, {}, true},
        {"WarpMeshBilinearGrid", kWidePx, warpBilinear, {}, true},
        {"WarpMeshTriangles", kWidePx, warpTriangles, {}, true}};
    for (const auto& [model, fovDeg] : std::map<std::string, double>{{"Orthographic", 180},
                                                                     {"Stereographic", 220},
                                                                     {"Equisolid", 300},
                                                                     {"Equidistant", 180},
                                                                     {"Polynomial", 180}}) {
        std::string lower = model;
        lower[0] = static_cast<char>(std::tolower(lower[0]));
        all.push_back({"Radial" + model, kSquarePx, radial(lower, fovDeg), {}, true});
    }
    return all;
}

// A fan of triangles about the middle, round, with (u, v) a little bent.
std::string triangleMesh() {
    json vertices = json::array(), triangles = json::array();
    constexpr int kRings = 6, kSpokes = 24;
    vertices.push_back({0.5, 0.5, 0.5, 0.52});
    for (int ring = 1; ring <= kRings; ++ring) {
        for (int spoke = 0; spoke < kSpokes; ++spoke) {
            const double angle = 2 * M_PI * spoke / kSpokes, r = 0.48 * ring / kRings;
            const double x = r * std::cos(angle), y = r * std::sin(angle);
            vertices.push_back({0.5 + x, 0.5 + y, 0.5 + 0.8 * x * (1 - 0.3 * y), 0.52 - 0.8 * y, 1 - r});
            const int next = (spoke + 1) % kSpokes;
            const auto at = [&](int ofRing, int ofSpoke) {
                return ofRing == 0 ? 0 : 1 + (ofRing - 1) * kSpokes + ofSpoke;
            };
            triangles.push_back({at(ring - 1, spoke), at(ring, spoke), at(ring, next)});
            if (ring > 1) triangles.push_back({at(ring - 1, spoke), at(ring, next), at(ring - 1, next)});
        }
    }
    return json{{"triangles", triangles}, {"vertices", vertices}}.dump();
}

// Scenes and the context are made once.
struct Shared {
    std::shared_ptr<const Scene> room = std::make_shared<const Scene>(loadScene("room"));
    std::shared_ptr<const Scene> city = std::make_shared<const Scene>(loadScene("city"));
    Renderer renderer;
};

class EveryProjection : public test::GlTest, public ::testing::WithParamInterface<Kind> {
protected:
    static void TearDownTestSuite() { shared_.reset(); }

    void SetUp() override {
        if (!shared_) {
            GlTest::SetUp();  // makes a context of its own, and so comes before the renderer's
            if (IsSkipped() || HasFatalFailure()) return;
            shared_ = std::make_unique<Shared>();
        }
        folder_.write("offsets.pfm", test::pfmBytes(mapOf({33, 33}, true, bentOffsets)));
        folder_.write("triangles.json", triangleMesh());
        wall_ = std::make_shared<const Wall>(
            test::readWallOf(folder_, GetParam().projection, GetParam().sizePx, GetParam().eyeM));
    }

    const Display& display() const { return wall_->displays.front(); }

    std::optional<glm::dvec3> rayAt(int x, int y) const {
        return display().projection->unproject({x + 0.5, y + 0.5});
    }

    bool isBesideAHole(int x, int y) const {
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (!rayAt(x + dx, y + dy)) return true;
        return false;
    }

    RenderRequest inRoom() const {
        RenderRequest request;
        request.wall = wall_;
        request.scene = shared_->room;
        request.camera = {{0.4, 0.2, -0.3}, {0.3, 0.1, 0.2}};
        return request;
    }

    RenderRequest inCity() const {
        RenderRequest request = inRoom();
        request.scene = shared_->city;
        request.camera = {{0, 8, 0}, {0.4, 0, 0}};
        return request;
    }

    RenderResult render(const RenderRequest& request) { return shared_->renderer.render(request); }

    ImageDifference fromReference(RenderRequest request) {
        const Frame drawn = render(request).frame;
        request.method = Method::reference;
        return compareColor(drawn, render(request).frame);
    }

    test::TemporaryFolder folder_;
    WallPtr wall_;
    static inline std::unique_ptr<Shared> shared_;
};

// What a pixel shows may be what its neighbour should, within the tolerance of an edge. Cube faces have their
// own pixels, which blur edges, so that the picture is off along all of them.
TEST_P(EveryProjection, PiecesShowWhatTheReferenceShows) {
    EXPECT_LT(fromReference(inRoom()).shareOff, 0.003);
    EXPECT_LT(fromReference(inCity()).shareOff, 0.025);
}

TEST_P(EveryProjection, ImageBasedShowsAboutWhatTheReferenceShows) {
    RenderRequest request = inRoom();
    request.method = Method::imageBased;
    EXPECT_LT(fromReference(request).shareOff, 0.05);
    request = inCity();
    request.method = Method::imageBased;
    EXPECT_LT(fromReference(request).shareOff, 0.4);
}

TEST_P(EveryProjection, PiecesAreCertifiedAtEveryPixel) {
    int holes = 0;
    for (int y = 0; y < GetParam().sizePx.y; ++y)
        for (int x = 0; x < GetParam().sizePx.x; ++x) holes += !rayAt(x, y);
    EXPECT_EQ(holes > 0, GetParam().hasHoles);
    for (const double tolerancePx : {1.0, 0.25}) {
        const Certificate certificate =
            fitPieces(*display().projection, display().sizePx, tolerancePx).certificate;
        EXPECT_LE(certificate.maxPx, tolerancePx);
        EXPECT_EQ(certificate.uncoveredPixels, 0);
        EXPECT_EQ(certificate.holes, holes);
    }
}

TEST_P(EveryProjection, EveryPixelShowsAPointWithinTheCertifiedError) {
    RenderRequest request = inRoom();
    request.output = OutputKind::position;
    const RenderResult result = render(request);
    const glm::ivec2 size = GetParam().sizePx;
    double largest = 0;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const float* p = result.frame.at(x, y);
            ASSERT_EQ(std::isfinite(p[0]), rayAt(x, y).has_value()) << x << ", " << y;
            if (!std::isfinite(p[0])) continue;
            if (isBesideAHole(x, y)) continue;  // what is shown may lie beyond the map
            double nearest = std::numeric_limits<double>::infinity();
            for (const glm::dvec2 px : display().projection->project({p[0], p[1], p[2]})) {
                const glm::dvec2 off = glm::abs(px - glm::dvec2(x + 0.5, y + 0.5));
                // The borders of a full turn are one place.
                nearest =
                    std::min({nearest, glm::length(off), glm::length(glm::dvec2(size.x - off.x, off.y))});
            }
            largest = std::max(largest, nearest);
        }
    }
    // OpenGL rasterizes on a grid of 1/256 px. The certificate tells where the pixel's ray lands; where the
    // ray that is shown comes from is the same to first order.
    EXPECT_LE(largest, 1.2 * request.tolerancePx + 1.0 / 256);
    EXPECT_LE(result.stats.geometricError.maxPx, request.tolerancePx);
}

TEST_P(EveryProjection, AClosedRoomCoversEveryPixelWithARayOnceAndNoHole) {
    RenderRequest request = inRoom();
    request.output = OutputKind::coverage;
    for (const double yawRad : {0.0, 1.1, 2.9}) {
        request.camera.orientation.yawRad = yawRad;
        const Frame coverage = render(request).frame;
        int wrong = 0;
        for (int y = 0; y < GetParam().sizePx.y; ++y)
            for (int x = 0; x < GetParam().sizePx.x; ++x)
                wrong += *coverage.at(x, y) != (rayAt(x, y) ? 1.0f : 0.0f);
        EXPECT_EQ(wrong, 0) << "yaw " << yawRad;
    }
}

class EveryProjectionWithHoles : public EveryProjection {};

TEST_P(EveryProjectionWithHoles, ShowsTheBackgroundThere) {
    for (const Method method : {Method::piecewise, Method::imageBased, Method::reference}) {
        RenderRequest request = inRoom();
        request.method = method;
        request.linearOutput = true;
        const Frame colour = render(request).frame;
        request.output = OutputKind::depth;
        const Frame depth = render(request).frame;
        request.output = OutputKind::position;
        const Frame position = render(request).frame;
        int wrong = 0;
        for (int y = 0; y < GetParam().sizePx.y; ++y) {
            for (int x = 0; x < GetParam().sizePx.x; ++x) {
                if (rayAt(x, y)) continue;
                const float* c = colour.at(x, y);
                wrong += glm::distance(glm::vec3(c[0], c[1], c[2]), test::kBackground) > 1e-3f;
                wrong += !(std::isinf(*depth.at(x, y)) && *depth.at(x, y) > 0);
                for (int k = 0; k < 3; ++k) wrong += !std::isnan(position.at(x, y)[k]);
            }
        }
        EXPECT_EQ(wrong, 0) << "method " << static_cast<int>(method);
    }
}

std::vector<Kind> kindsWithHoles() {
    std::vector<Kind> all = kinds();
    std::erase_if(all, [](const Kind& kind) { return !kind.hasHoles; });
    return all;
}

std::string nameOf(const ::testing::TestParamInfo<Kind>& kind) { return kind.param.name; }

INSTANTIATE_TEST_SUITE_P(Kinds, EveryProjection, ::testing::ValuesIn(kinds()), nameOf);
INSTANTIATE_TEST_SUITE_P(Kinds, EveryProjectionWithHoles, ::testing::ValuesIn(kindsWithHoles()), nameOf);

}  // namespace
}  // namespace curvewall
