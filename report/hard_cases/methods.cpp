#include "report/hard_cases/methods.h"

#include <limits>

namespace curvewall {
namespace {

constexpr double kAnyPx = std::numeric_limits<double>::infinity();

// The certificate tells where a pixel's ray lands; where the ray that is shown comes from is the same to
// first order. OpenGL rasterizes on a grid of 1/256 px.
constexpr double kPiecewisePx = 1.2 * kDefaultTolerancePx + 1.0 / 256;

// As docs/methods.md states them.
constexpr StatedBounds kPiecewise{kPiecewisePx, kPiecewisePx}, kImageBased{kAnyPx, 0.75},
    kBoundedRaycast{1, 0.01}, kVertexWarp{kAnyPx, 0.25};

}  // namespace

const std::vector<HardCaseMethod>& hardCaseMethods() {
    static const std::vector<HardCaseMethod> methods{
        {"piecewise", [](RenderRequest& request) { request.method = Method::piecewise; }, kPiecewise},
        {"image-based, cube", [](RenderRequest& request) { request.method = Method::imageBased; },
         kImageBased},
        {"bounded-raycast, triangle",
         [](RenderRequest& request) {
             request.method = Method::boundedRaycast;
             request.bounds = BoundingShape::triangle;
         },
         kBoundedRaycast},
        {"bounded-raycast, quad",
         [](RenderRequest& request) {
             request.method = Method::boundedRaycast;
             request.bounds = BoundingShape::quad;
         },
         kBoundedRaycast},
        {"vertex-warp, 4 px",
         [](RenderRequest& request) {
             request.method = Method::vertexWarp;
             request.tessellationPx = 4;
         },
         kVertexWarp},
    };
    return methods;
}

}  // namespace curvewall
