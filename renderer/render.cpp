#include "renderer/render.h"

#include "renderer/gl/egl_context.h"
#include "renderer/methods/automatic_method.h"
#include "renderer/methods/bounded_raycast_method.h"
#include "renderer/methods/image_based_method.h"
#include "renderer/methods/piecewise_method.h"
#include "renderer/methods/reference_method.h"
#include "renderer/methods/vertex_warp_method.h"

#include <sys/resource.h>

#include <optional>

namespace curvewall {
namespace {

double peakMemoryMib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

struct EyeKey {
    WallPtr wall;
    glm::dvec3 eyeM;
    bool operator==(const EyeKey&) const = default;
};

}  // namespace

// The GL objects are declared after the context, so that they go first.
struct Renderer::Impl {
    explicit Impl(size_t mostScenes) : resources(mostScenes), reference(mostScenes) {}

    std::optional<EglContext> context;
    RecentlyUsed<EyeKey, const Wall> movedWalls{16};
    RasterResources resources;
    PiecewiseMethod piecewise{resources};
    ImageBasedMethod imageBased{resources};
    BoundedRaycastMethod boundedRaycast{resources};
    VertexWarpMethod vertexWarp{resources};
    ReferenceMethod reference;
    AutomaticMethod automatic;

    RenderResult render(const RenderRequest& request, const Display& display);
};

RenderResult Renderer::Impl::render(const RenderRequest& request, const Display& display) {
    switch (request.method) {
        case Method::piecewise:
            return piecewise.render(request, display);
        case Method::imageBased:
            return imageBased.render(request, display);
        case Method::boundedRaycast:
            return boundedRaycast.render(request, display);
        case Method::vertexWarp:
            return vertexWarp.render(request, display);
        case Method::reference:
            return reference.render(request, display);
        case Method::automatic: {
            RenderRequest fitted = request;
            fitted.pieces = piecewise.piecesFor(request, display);
            return automatic.render(fitted, display,
                                    [&](const RenderRequest& settled) { return render(settled, display); });
        }
    }
    return {};
}

Renderer::Renderer(size_t mostScenes) : impl_(std::make_unique<Impl>(mostScenes)) {}
Renderer::~Renderer() = default;

RenderResult Renderer::render(const RenderRequest& asked) {
    RenderRequest request = asked;
    if (asked.eyeM)
        request.wall = impl_->movedWalls.get({asked.wall, *asked.eyeM}, [&] {
            return std::make_shared<const Wall>(seenFrom(*asked.wall, *asked.eyeM));
        });
    const Display& display = findDisplay(*request.wall, request.display);
    if (request.method != Method::reference) {
        if (!impl_->context) impl_->context.emplace();
        const int usual = impl_->context->isSoftware() ? 1 : kMostAnisotropy;
        setAnisotropy(impl_->resources.scene(request.scene)->gpu, request.anisotropy.value_or(usual));
    }
    RenderResult result = impl_->render(request, display);
    result.stats.triangles = request.scene->triangles.size();
    result.stats.samples = request.samples;
    result.stats.frames = request.frames;
    result.stats.peakMemoryMib = peakMemoryMib();
    if (request.method != Method::reference) result.stats.glRenderer = impl_->context->rendererName();
    return result;
}

}  // namespace curvewall
