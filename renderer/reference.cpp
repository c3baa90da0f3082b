#include "renderer/reference.h"

#include "calibration/errors.h"
#include "calibration/parallel.h"
#include "renderer/edge_strokes.h"
#include "renderer/line_styles.h"
#include "renderer/ray_scene.h"
#include "renderer/sample_pattern.h"
#include "renderer/shading.h"
#include "renderer/texture_filter.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace curvewall {
namespace {

// Every method cuts what is nearer than this share of the distance to the wall.
constexpr double kNearShareOfWall = 1e-5;

// One display seen from one camera.
struct View {
    const Projection& projection;
    glm::dmat3 sceneFromWall;
    glm::dvec3 eyeM;     // relative to the scene's origin
    double footprintPx;  // side of the square that one sample stands for
    Style style;
    const EdgeStrokes* strokes;  // of styles that draw edges
};

struct SampleRay {
    glm::dvec2 px;
    glm::dvec3 directionInWall;  // length one
    SceneRay inScene;
};

std::optional<SampleRay> sampleRay(const View& view, glm::dvec2 px) {
    const std::optional<glm::dvec3> toWall = view.projection.unproject(px);
    if (!toWall) return std::nullopt;
    const double wallDistanceM = glm::length(*toWall);
    const glm::dvec3 direction = *toWall / wallDistanceM;
    return SampleRay{
        px, direction, {view.eyeM, view.sceneFromWall * direction, kNearShareOfWall * wallDistanceM}};
}

// A triangle seen from the eye, in double: differences of neighbouring rays would drown in float rounding.
class EyeTriangle {
public:
    EyeTriangle(const Scene& scene, uint32_t triangle, glm::dvec3 eyeM)
        : corners_(scene.triangles[triangle]) {
        const glm::dvec3 p0(scene.positions[corners_.x]);
        fromEye_ = p0 - eyeM;
        edge1_ = glm::dvec3(scene.positions[corners_.y]) - p0;
        edge2_ = glm::dvec3(scene.positions[corners_.z]) - p0;
        normal_ = glm::cross(edge1_, edge2_);
    }

    // The sign of the determinant of the three corners.
    bool facesEye() const { return glm::dot(normal_, fromEye_) < 0; }

    // In lengths of the ray. Nothing for rays parallel to the triangle's plane or away from it.
    std::optional<double> distanceAlong(glm::dvec3 ray) const {
        const double distance = glm::dot(normal_, fromEye_) / glm::dot(normal_, ray);
        if (!(distance > 0) || std::isinf(distance)) return std::nullopt;
        return distance;
    }

    // Barycentric, of a point relative to the eye.
    glm::dvec3 weightsAt(glm::dvec3 point) const {
        const glm::dvec3 offset = point - fromEye_, scaledNormal = normal_ / glm::dot(normal_, normal_);
        const double w1 = glm::dot(glm::cross(offset, edge2_), scaledNormal);
        const double w2 = glm::dot(glm::cross(edge1_, offset), scaledNormal);
        return {1 - w1 - w2, w1, w2};
    }

    template <int N>
    glm::vec<N, double> interpolate(const std::vector<glm::vec<N, float>>& attribute,
                                    glm::dvec3 weights) const {
        using Value = glm::vec<N, double>;
        return weights.x * Value(attribute[corners_.x]) + weights.y * Value(attribute[corners_.y]) +
               weights.z * Value(attribute[corners_.z]);
    }

private:
    glm::uvec3 corners_;
    glm::dvec3 fromEye_, edge1_, edge2_, normal_;
};

// The plane in double tells the distance better than Embree's floats, but at grazing angles it may be
// anywhere.
double distanceTo(const EyeTriangle& triangle, const SampleRay& ray, const RayHit& hit) {
    const double traced = hit.distanceM;
    const double exact = triangle.distanceAlong(ray.inScene.direction).value_or(traced);
    return std::abs(exact - traced) <= 1e-4 * traced ? exact : traced;
}

const Material& materialOf(const Scene& scene, uint32_t triangle) {
    const auto next = std::upper_bound(
        scene.ranges.begin(), scene.ranges.end(), triangle,
        [](uint32_t value, const MaterialRange& range) { return value < range.firstTriangle; });
    return scene.materials[std::prev(next)->material];
}

// How far uv moves from one sample to the next one `stepPx` away: ray differentials (Igehy, Tracing Ray
// Differentials, 1999) by finite differences, so that any Projection will do. Where the display ends there,
// the other side serves as well; a neighbour that misses the plane looks past its horizon.
glm::dvec2 uvStep(const Scene& scene, const EyeTriangle& triangle, const View& view, glm::dvec2 px,
                  glm::dvec2 uv, glm::dvec2 stepPx) {
    std::optional<glm::dvec3> neighbour = view.projection.unproject(px + stepPx);
    if (!neighbour) neighbour = view.projection.unproject(px - stepPx);
    if (!neighbour) return glm::dvec2(0);
    const glm::dvec3 ray = view.sceneFromWall * *neighbour;
    const std::optional<double> distance = triangle.distanceAlong(ray);
    if (!distance) return glm::dvec2(std::numeric_limits<double>::infinity());
    return triangle.interpolate(scene.uvs, triangle.weightsAt(*distance * ray)) - uv;
}

glm::vec4 baseColorAt(const Scene& scene, const Material& material, const EyeTriangle& triangle,
                      const View& view, glm::dvec2 px, glm::dvec3 weights) {
    if (material.texture < 0) return material.baseColor;
    const Texture& texture = scene.textures[static_cast<size_t>(material.texture)];
    const glm::dvec2 uv = triangle.interpolate(scene.uvs, weights);
    const double level = levelOfDetail(texture.levels.front().sizePx,
                                       uvStep(scene, triangle, view, px, uv, {view.footprintPx, 0}),
                                       uvStep(scene, triangle, view, px, uv, {0, view.footprintPx}));
    return material.baseColor * sampleTexture(texture, uv, level);
}

bool hidesNothing(const Material& material) { return material.doubleSided && material.alphaCutoff < 0; }

// False where the material is discarded: seen from behind, or more transparent than its cutoff.
bool isDrawn(const Scene& scene, const View& view, const SampleRay& ray, const RayHit& hit) {
    const Material& material = materialOf(scene, hit.triangle);
    if (hidesNothing(material)) return true;
    const EyeTriangle triangle(scene, hit.triangle, view.eyeM);
    if (!material.doubleSided && !triangle.facesEye()) return false;
    if (material.alphaCutoff < 0) return true;
    const glm::dvec3 weights = triangle.weightsAt(distanceTo(triangle, ray, hit) * ray.inScene.direction);
    return baseColorAt(scene, material, triangle, view, ray.px, weights).a >= material.alphaCutoff;
}

glm::vec3 surfaceColor(const Scene& scene, const View& view, const SampleRay& ray, const RayHit& hit) {
    const EyeTriangle triangle(scene, hit.triangle, view.eyeM);
    const Material& material = materialOf(scene, hit.triangle);
    const glm::dvec3 weights = triangle.weightsAt(distanceTo(triangle, ray, hit) * ray.inScene.direction);
    const glm::vec3 base(baseColorAt(scene, material, triangle, view, ray.px, weights));
    if (view.style == Style::unlit || material.unlit) return base;
    const glm::vec3 normal(glm::normalize(triangle.interpolate(scene.normals, weights)));
    return base * shading::lightOnSurface(triangle.facesEye() ? normal : -normal);
}

glm::vec3 colorOf(const Scene& scene, const View& view, const SampleRay& ray, const RayHit& hit) {
    const glm::vec3 surface = surfaceColor(scene, view, ray, hit);
    if (!view.strokes) return surface;
    const float line = view.strokes->coverage(
        hit.triangle, {view.projection, view.sceneFromWall, view.eyeM, view.footprintPx}, ray.px);
    if (view.style == Style::wireframe) return line_styles::wireframeColor(surface, line);
    return line_styles::penAndInkColor(surface, glm::vec2(ray.px), line,
                                       static_cast<float>(view.footprintPx));
}

// A ray through an edge meets the triangles on both sides there; that is one crossing of one surface.
int countCrossings(const Scene& scene, const View& view, const std::vector<RayHit>& hits) {
    const auto facesEye = [&](const RayHit& hit) {
        return EyeTriangle(scene, hit.triangle, view.eyeM).facesEye();
    };
    const auto sameCrossing = [&](const RayHit& a, const RayHit& b) {
        return a.onEdge && b.onEdge && std::abs(a.distanceM - b.distanceM) <= 1e-6f * a.distanceM &&
               facesEye(a) == facesEye(b);
    };
    int crossings = 0;
    for (auto hit = hits.begin(); hit != hits.end(); ++hit)
        if (std::none_of(hits.begin(), hit, [&](const RayHit& other) { return sameCrossing(*hit, other); }))
            ++crossings;
    return crossings;
}

}  // namespace

struct ReferenceRenderer::Impl {
    ScenePtr scene;
    RayScene rays;
    bool hasHoles;  // some material hides less than its triangles cover

    explicit Impl(ScenePtr shown)
        : scene(std::move(shown)),
          rays(*scene),
          hasHoles(!std::all_of(scene->materials.begin(), scene->materials.end(), hidesNothing)) {}

    std::optional<RayHit> nearest(const View& view, const SampleRay& ray) const {
        if (!hasHoles) return rays.nearestHit(ray.inScene, nullptr);
        return rays.nearestHit(ray.inScene,
                               [&](const RayHit& hit) { return isDrawn(*scene, view, ray, hit); });
    }

    glm::vec3 color(const View& view, glm::dvec2 px, glm::vec3 background) const {
        const std::optional<SampleRay> ray = sampleRay(view, px);
        const std::optional<RayHit> hit = ray ? nearest(view, *ray) : std::nullopt;
        return hit ? colorOf(*scene, view, *ray, *hit) : background;
    }

    std::optional<glm::dvec3> position(const View& view, glm::dvec2 px) const {
        const std::optional<SampleRay> ray = sampleRay(view, px);
        const std::optional<RayHit> hit = ray ? nearest(view, *ray) : std::nullopt;
        if (!hit) return std::nullopt;
        return distanceTo(EyeTriangle(*scene, hit->triangle, view.eyeM), *ray, *hit) * ray->directionInWall;
    }

    int coverage(const View& view, glm::dvec2 px) const {
        const std::optional<SampleRay> ray = sampleRay(view, px);
        if (!ray) return 0;
        std::vector<RayHit> hits = rays.allHits(ray->inScene);
        std::erase_if(hits, [&](const RayHit& hit) { return !isDrawn(*scene, view, *ray, hit); });
        return countCrossings(*scene, view, hits);
    }
};

ReferenceRenderer::ReferenceRenderer(ScenePtr scene) : impl_(std::make_unique<Impl>(std::move(scene))) {}
ReferenceRenderer::~ReferenceRenderer() = default;
ReferenceRenderer::ReferenceRenderer(ReferenceRenderer&&) noexcept = default;
ReferenceRenderer& ReferenceRenderer::operator=(ReferenceRenderer&&) noexcept = default;

Frame ReferenceRenderer::render(const Wall& wall, const Display& display, const Camera& camera,
                                const Options& options) const {
    if (options.samples < 1) throw UsageError("the reference needs at least one sample a pixel");
    const bool isColor = options.output == OutputKind::color;
    std::optional<EdgeStrokes> strokes;
    if (drawsEdges(options.style, options.output)) strokes.emplace(*impl_->scene, options.style);
    const View view{*display.projection,
                    rotationFromOrientation(camera.orientation),
                    eyeInScene(camera, wall.eyeM) - impl_->scene->originM,
                    isColor ? 1 / std::sqrt(options.samples) : 1.0,
                    options.style,
                    strokes ? &*strokes : nullptr};

    Frame frame{display.sizePx, channelsOf(options.output), {}};
    const auto width = static_cast<size_t>(frame.sizePx.x), channels = static_cast<size_t>(frame.channels);
    frame.texels.resize(width * static_cast<size_t>(frame.sizePx.y) * channels);

    const auto renderPixel = [&](glm::dvec2 corner, size_t index) {
        const auto put = [&](const auto& values) {
            std::copy_n(&values[0], channels, &frame.texels[index * channels]);
        };
        const glm::dvec2 centre = corner + 0.5;
        switch (options.output) {
            case OutputKind::color: {
                glm::dvec3 sum(0);
                for (const glm::dvec2 offset : samplePattern(options.samples, index))
                    sum += glm::dvec3(impl_->color(view, corner + offset, wall.background));
                return put(glm::vec3(sum / static_cast<double>(options.samples)));
            }
            case OutputKind::coverage:
                return put(glm::vec3(static_cast<float>(impl_->coverage(view, centre))));
            case OutputKind::depth:
            case OutputKind::position: {
                const std::optional<glm::dvec3> point = impl_->position(view, centre);
                if (!point) return put(emptyTexel(options.output, wall.background));
                const bool isDepth = options.output == OutputKind::depth;
                return put(isDepth ? glm::vec3(static_cast<float>(glm::length(*point))) : glm::vec3(*point));
            }
        }
    };
    parallelRanges(
        frame.sizePx.y,
        [&](int begin, int end) {
            for (int y = begin; y < end; ++y)
                for (int x = 0; x < frame.sizePx.x; ++x)
                    renderPixel({x, y}, static_cast<size_t>(y) * width + static_cast<size_t>(x));
        },
        options.threads);
    return frame;
}

}  // namespace curvewall
