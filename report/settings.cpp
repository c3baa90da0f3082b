#include "report/settings.h"

#include "calibration/pieces/pixel_rays.h"
#include "renderer/cube_source.h"
#include "renderer/names.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace curvewall {
namespace {

// A method whose knob is turned: one curve of the plots.
struct Sweep {
    RenderRequest request;
    std::string variant, knob;
    std::function<void(RenderRequest&, double)> turn;
    std::vector<double> values;
    double shown = -1;  // the value whose picture is shown; none below 0
};

constexpr auto kTurnTolerance = [](RenderRequest& request, double px) { request.tolerancePx = px; };
constexpr auto kTurnFaces = [](RenderRequest& request, double px) {
    request.faceSizePx = static_cast<int>(px);
};
constexpr auto kTurnEdges = [](RenderRequest& request, double px) { request.tessellationPx = px; };
constexpr auto kTurnSamples = [](RenderRequest& request, double samples) {
    request.samples = static_cast<int>(samples);
};
constexpr auto kNothing = [](RenderRequest&, double) {};

// Around one texel a pixel: the power of two next to the size that image-based would take by itself, as far
// as a quarter and twice of it are sizes that faces may have.
double usualFacePx(const RenderRequest& base) {
    const Display& display = findDisplay(*base.wall, base.display);
    PixelRays rays(*display.projection, display.sizePx);
    rays.keep({});
    const double nearest = std::exp2(std::round(std::log2(cubeSource(rays, 0).faceSizePx)));
    return std::clamp(nearest, 4.0 * kLeastFacePx, 0.5 * kMostAutomaticFacePx);
}

class Sweeps {
public:
    Sweeps(const RenderRequest& base, Extent extent)
        : base_(base), isFull_(extent == Extent::full), facePx_(usualFacePx(base)) {}

    std::vector<Sweep> all() {
        addPiecewise();
        addImageBased();
        addBoundedRaycast();
        addVertexWarp();
        addReference();
        if (isFull_) addSamples();
        return std::move(sweeps_);
    }

private:
    RenderRequest of(Method method) const {
        RenderRequest request = base_;
        request.method = method;
        return request;
    }

    void addPiecewise() {
        const double usual = base_.tolerancePx;
        std::vector<double> tolerances =
            isFull_ ? std::vector{2.0, 1.0, 0.5, 0.25, 0.1, 0.05} : std::vector{1.0, 0.25, 0.1};
        if (std::ranges::find(tolerances, usual) == tolerances.end()) tolerances.push_back(usual);
        std::ranges::sort(tolerances, std::greater());
        sweeps_.push_back({of(Method::piecewise), "", "tolerance_px", kTurnTolerance, tolerances, usual});
        if (!isFull_) return;
        for (const Engine engine : {Engine::geometry, Engine::tessellation, Engine::loop}) {
            Sweep sweep{of(Method::piecewise), fmt::format("{} engine", nameOf(engine)), "tolerance_px",
                        kTurnTolerance, usual == 1 ? std::vector{usual} : std::vector{1, usual}};
            sweep.request.engine = engine;
            sweeps_.push_back(sweep);
        }
    }

    RenderRequest imageBased(SourceKind source, SourceFilter filter) const {
        RenderRequest request = of(Method::imageBased);
        request.source = source;
        request.filter = filter;
        return request;
    }

    void addFaces(RenderRequest request, std::string variant, std::vector<double> sizesPx,
                  double shown = -1) {
        sweeps_.push_back(
            {std::move(request), std::move(variant), "face_size_px", kTurnFaces, std::move(sizesPx), shown});
    }

    void addImageBased() {
        const std::vector<double> few{facePx_ / 2, facePx_, 2 * facePx_};
        std::vector<double> sizesPx = few;
        if (isFull_) sizesPx.insert(sizesPx.begin(), facePx_ / 4);
        addFaces(imageBased(SourceKind::cube, SourceFilter::nearest), "cube, nearest", sizesPx, facePx_ / 2);
        addFaces(imageBased(SourceKind::cube, SourceFilter::linear), "cube, linear", sizesPx, facePx_);
        addFaces(imageBased(SourceKind::planar, SourceFilter::linear), "planar, linear", few, facePx_);
        if (!isFull_) return;
        addFaces(imageBased(SourceKind::cube, SourceFilter::bicubic), "cube, bicubic", sizesPx, facePx_);
        addFaces(imageBased(SourceKind::cube, SourceFilter::mipmap), "cube, mipmap", few);
        addFaces(imageBased(SourceKind::cube, SourceFilter::anisotropic), "cube, anisotropic", few);
        addFaces(imageBased(SourceKind::hemicube, SourceFilter::linear), "hemicube, linear", few);
        RenderRequest layered = imageBased(SourceKind::cube, SourceFilter::linear);
        layered.facePass = FacePass::layered;
        addFaces(layered, "cube, linear, layered", {facePx_ / 2, facePx_});
        RenderRequest mesh = imageBased(SourceKind::cube, SourceFilter::linear);
        mesh.lookup = SourceLookup::mesh;
        addFaces(mesh, fmt::format("cube, linear, mesh of {} px", mesh.meshStepPx), few);
    }

    void addBoundedRaycast() {
        std::vector<BoundingShape> shapes{BoundingShape::triangle};
        if (isFull_) shapes.insert(shapes.end(), {BoundingShape::quad, BoundingShape::genericQuad});
        for (const BoundingShape shape : shapes) {
            Sweep sweep{of(Method::boundedRaycast), std::string(nameOf(shape)), "", kNothing, {0}};
            sweep.request.bounds = shape;
            if (shape == BoundingShape::triangle) sweep.shown = 0;
            sweeps_.push_back(sweep);
        }
    }

    void addVertexWarp() {
        const std::vector<double> lengthsPx =
            isFull_ ? std::vector<double>{64, 32, 16, 8, 4} : std::vector<double>{32, 16, 8};
        sweeps_.push_back({of(Method::vertexWarp), "", "tessellation_px", kTurnEdges, lengthsPx, 16});
        if (isFull_)
            sweeps_.push_back({of(Method::vertexWarp), "triangles as they are", "", kNothing, {0}, 0});
    }

    void addReference() {
        const std::vector<double> rays = isFull_ ? std::vector<double>{1, 4, 16} : std::vector<double>{1};
        sweeps_.push_back({of(Method::reference), "", "samples", kTurnSamples, rays});
    }

    void addSamples() {
        const std::vector<double> samples{4, 16};
        RenderRequest pieces = of(Method::piecewise);
        sweeps_.push_back(
            {pieces, fmt::format("{:g} px", pieces.tolerancePx), "samples", kTurnSamples, samples});
        RenderRequest faces = imageBased(SourceKind::cube, SourceFilter::linear);
        faces.faceSizePx = static_cast<int>(facePx_);
        sweeps_.push_back(
            {faces, fmt::format("cube, linear, {} px", faces.faceSizePx), "samples", kTurnSamples, samples});
        sweeps_.push_back({of(Method::boundedRaycast), "triangle", "samples", kTurnSamples, samples});
        RenderRequest warp = of(Method::vertexWarp);
        warp.tessellationPx = 8;
        sweeps_.push_back({warp, "8 px", "samples", kTurnSamples, samples});
    }

    const RenderRequest& base_;
    bool isFull_;
    double facePx_;
    std::vector<Sweep> sweeps_;
};

}  // namespace

std::vector<Setting> settingsFor(const RenderRequest& base, Extent extent) {
    std::vector<Setting> settings;
    for (const Sweep& sweep : Sweeps(base, extent).all())
        for (const double value : sweep.values) {
            RenderRequest request = sweep.request;
            sweep.turn(request, value);
            settings.push_back(
                {{std::string(nameOf(request.method)), sweep.variant, sweep.knob, value, request.samples},
                 request,
                 value == sweep.shown});
        }
    return settings;
}

}  // namespace curvewall
