#include "renderer/reference.h"

#include "calibration/errors.h"
#include "calibration/parallel.h"
#include "renderer/edge_strokes.h"
#include "renderer/line_styles.h"
#include "renderer/projected_strokes.h"
#include "renderer/ray_scene.h"
#include "renderer/sample_pattern.h"
#include "renderer/shading.h"
#include "renderer/texture_filter.h"

#include <fmt/core.h>
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

// Embree ends the program where squares of distances overflow.
constexpr double kFarthestEyeM = 1e15;

// One display seen from one camera.
struct View {
    const Projection& projection;
    glm::dmat3 sceneFromWall;
    glm::dvec3 eyeM;     // relative to the scene's origin
    double footprintPx;  // side of the square that one sample stands for
    Style style;
    const EdgeStrokes* edges;                   // of styles that draw them
    const ProjectedStrokes* strokes = nullptr;  // where the scene has any
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

// Whether a ray ends wherever it meets the material's triangles.
bool isSolid(const Material& material) {
    return material.doubleSided && material.alphaCutoff < 0 && material.blending == Blending::none;
}

// False where the material is discarded: seen from behind, or more transparent than its cutoff.
bool isDrawn(const Scene& scene, const View& view, const SampleRay& ray, const RayHit& hit) {
    const Material& material = materialOf(scene, hit.triangle);
    if (isSolid(material)) return true;
    const EyeTriangle triangle(scene, hit.triangle, view.eyeM);
    if (!material.doubleSided && !triangle.facesEye()) return false;
    if (material.alphaCutoff < 0) return true;
    const glm::dvec3 weights = triangle.weightsAt(distanceTo(triangle, ray, hit) * ray.inScene.direction);
    return baseColorAt(scene, material, triangle, view, ray.px, weights).a >= material.alphaCutoff;
}

// Linear light, straight alpha.
glm::vec4 surfaceColor(const Scene& scene, const View& view, const SampleRay& ray, const RayHit& hit) {
    const EyeTriangle triangle(scene, hit.triangle, view.eyeM);
    const Material& material = materialOf(scene, hit.triangle);
    const glm::dvec3 weights = triangle.weightsAt(distanceTo(triangle, ray, hit) * ray.inScene.direction);
    const glm::vec4 base = baseColorAt(scene, material, triangle, view, ray.px, weights);
    if (view.style == Style::unlit || material.unlit) return base;
    const glm::vec3 normal(glm::normalize(triangle.interpolate(scene.normals, weights)));
    return base * glm::vec4(shading::lightOnSurface(triangle.facesEye() ? normal : -normal), 1);
}

glm::vec4 colorOf(const Scene& scene, const View& view, const SampleRay& ray, const RayHit& hit) {
    const glm::vec4 surface = surfaceColor(scene, view, ray, hit);
    if (!view.edges) return surface;
    const float line = view.edges->coverage(
        hit.triangle, {view.projection, view.sceneFromWall, view.eyeM, view.footprintPx}, ray.px);
    const glm::vec3 color(surface);
    if (view.style == Style::wireframe) return {line_styles::wireframeColor(color, line), surface.a};
    return {line_styles::penAndInkColor(color, glm::vec2(ray.px), line, static_cast<float>(view.footprintPx)),
            surface.a};
}

glm::vec4 baseColorAt(const Scene& scene, const Material& material, const View& view,
                      const StrokePlace& place) {
    if (material.texture < 0) return material.baseColor;
    const Texture& texture = scene.textures[static_cast<size_t>(material.texture)];
    const glm::uvec2 ends = verticesOf(scene, place.stroke);
    const glm::dvec2 from(scene.uvs[ends.x]), way = glm::dvec2(scene.uvs[ends.y]) - from;
    const glm::dvec2 step = view.footprintPx * place.alongPerPx;
    const double level = levelOfDetail(texture.levels.front().sizePx, step.x * way, step.y * way);
    return material.baseColor * sampleTexture(texture, from + place.along * way, level);
}

glm::vec4 colorOf(const Scene& scene, const View& view, const StrokePlace& place) {
    const Material& material = strokeMaterialOf(scene, place.stroke);
    const glm::vec4 base = baseColorAt(scene, material, view, place);
    if (view.style == Style::unlit || material.unlit) return base;
    const glm::uvec2 ends = verticesOf(scene, place.stroke);
    const glm::vec3 normal = glm::mix(scene.normals[ends.x], scene.normals[ends.y], place.along);
    return base * glm::vec4(shading::lightOnSurface(glm::normalize(normal)), 1);
}

// The strokes that show at a sample, in the order of the scene.
std::vector<StrokePlace> strokesAt(const Scene& scene, const View& view, const SampleRay& ray) {
    if (!view.strokes) return {};
    std::vector<StrokePlace> places = view.strokes->at(ray.px);
    std::erase_if(places, [&](const StrokePlace& place) {
        const Material& material = strokeMaterialOf(scene, place.stroke);
        return glm::length(place.fromEyeM) < ray.inScene.nearM ||
               (material.alphaCutoff >= 0 &&
                baseColorAt(scene, material, view, place).a < material.alphaCutoff);
    });
    return places;
}

// Something that a ray passes through.
struct Layer {
    double distanceM;
    glm::vec4 color;
    Blending blending;
};

// What a ray sees through layers, of which the nearer of two at one place comes later.
glm::vec3 seenThrough(std::vector<Layer> layers, glm::vec3 behind) {
    std::ranges::reverse(layers);
    std::ranges::stable_sort(layers, {}, &Layer::distanceM);
    glm::vec3 sum(0);
    float shareSeen = 1;  // of what is behind
    for (const Layer& layer : layers) {
        const float alpha = std::clamp(layer.color.a, 0.0f, 1.0f);
        sum += shareSeen * alpha * glm::vec3(layer.color);
        if (layer.blending == Blending::alpha) shareSeen *= 1 - alpha;
    }
    return sum + shareSeen * behind;
}

bool shareCorner(const Scene& scene, uint32_t a, uint32_t b) {
    for (glm::length_t i = 0; i < 3; ++i)
        for (glm::length_t k = 0; k < 3; ++k)
            if (scene.positions[scene.triangles[a][i]] == scene.positions[scene.triangles[b][k]]) return true;
    return false;
}

// A ray through an edge meets the triangles on both sides there; that is one crossing of one surface, and
// the first triangle of the scene stands for it.
void keepCrossings(const Scene& scene, const View& view, std::vector<RayHit>& hits) {
    const auto facesEye = [&](const RayHit& hit) {
        return EyeTriangle(scene, hit.triangle, view.eyeM).facesEye();
    };
    const auto sameCrossing = [&](const RayHit& a, const RayHit& b) {
        return b.onEdge && std::abs(a.distanceM - b.distanceM) <= 1e-6f * a.distanceM &&
               shareCorner(scene, a.triangle, b.triangle) && facesEye(a) == facesEye(b);
    };
    std::ranges::sort(hits, {}, &RayHit::triangle);
    std::vector<RayHit> crossings;
    for (const RayHit& hit : hits)
        if (!hit.onEdge ||
            std::ranges::none_of(crossings, [&](const RayHit& known) { return sameCrossing(hit, known); }))
            crossings.push_back(hit);
    hits = std::move(crossings);
}

}  // namespace

struct ReferenceRenderer::Impl {
    ScenePtr scene;
    RayScene rays;
    bool isAllSolid;

    explicit Impl(ScenePtr shown)
        : scene(std::move(shown)), rays(*scene), isAllSolid(std::ranges::all_of(scene->materials, isSolid)) {}

    // The nearest surface that hides what is behind it. What is drawn of those that let it through, farther
    // ones among them, goes to `through`.
    std::optional<RayHit> nearest(const View& view, const SampleRay& ray,
                                  std::vector<RayHit>* through = nullptr) const {
        if (isAllSolid) return rays.nearestHit(ray.inScene, nullptr);
        return rays.nearestHit(ray.inScene, [&](const RayHit& hit) {
            const bool hides = materialOf(*scene, hit.triangle).blending == Blending::none;
            if ((!hides && !through) || !isDrawn(*scene, view, ray, hit)) return false;
            if (!hides) through->push_back(hit);
            return hides;
        });
    }

    double distanceOf(const View& view, const SampleRay& ray, const RayHit& hit) const {
        return distanceTo(EyeTriangle(*scene, hit.triangle, view.eyeM), ray, hit);
    }

    // The nearest stroke that hides what is behind it, where it is nearer than the surface.
    const StrokePlace* nearest(const std::vector<StrokePlace>& strokes, double surfaceM) const {
        const StrokePlace* best = nullptr;
        for (const StrokePlace& place : strokes) {
            const double distanceM = glm::length(place.fromEyeM);
            if (strokeMaterialOf(*scene, place.stroke).blending != Blending::none || distanceM >= surfaceM)
                continue;
            best = &place;
            surfaceM = distanceM;
        }
        return best;
    }

    glm::vec3 color(const View& view, glm::dvec2 px, glm::vec3 background) const {
        const std::optional<SampleRay> ray = sampleRay(view, px);
        if (!ray) return background;
        std::vector<RayHit> through;
        const std::optional<RayHit> hit = nearest(view, *ray, &through);
        const std::vector<StrokePlace> strokes = strokesAt(*scene, view, *ray);
        if (through.empty() && strokes.empty())
            return hit ? glm::vec3(colorOf(*scene, view, *ray, *hit)) : background;

        double endM = hit ? distanceOf(view, *ray, *hit) : std::numeric_limits<double>::infinity();
        const StrokePlace* const front = nearest(strokes, endM);
        if (front) endM = glm::length(front->fromEyeM);
        const glm::vec3 behind = front ? glm::vec3(colorOf(*scene, view, *front))
                                 : hit ? glm::vec3(colorOf(*scene, view, *ray, *hit))
                                       : background;
        keepCrossings(*scene, view, through);
        std::vector<Layer> layers;
        for (const RayHit& layer : through)
            if (const double m = distanceOf(view, *ray, layer); m < endM)
                layers.push_back(
                    {m, colorOf(*scene, view, *ray, layer), materialOf(*scene, layer.triangle).blending});
        for (const StrokePlace& layer : strokes) {
            const Blending blending = strokeMaterialOf(*scene, layer.stroke).blending;
            if (const double m = glm::length(layer.fromEyeM); m < endM && blending != Blending::none)
                layers.push_back({m, colorOf(*scene, view, layer), blending});
        }
        return seenThrough(std::move(layers), behind);
    }

    // Relative to the eye, wall axes.
    std::optional<glm::dvec3> position(const View& view, glm::dvec2 px) const {
        const std::optional<SampleRay> ray = sampleRay(view, px);
        if (!ray) return std::nullopt;
        const std::optional<RayHit> hit = nearest(view, *ray);
        const double hitM = hit ? distanceOf(view, *ray, *hit) : std::numeric_limits<double>::infinity();
        const std::vector<StrokePlace> strokes = strokesAt(*scene, view, *ray);
        if (const StrokePlace* const front = nearest(strokes, hitM))
            return glm::transpose(view.sceneFromWall) * front->fromEyeM;
        if (!hit) return std::nullopt;
        return hitM * ray->directionInWall;
    }

    int coverage(const View& view, glm::dvec2 px) const {
        const std::optional<SampleRay> ray = sampleRay(view, px);
        if (!ray) return 0;
        std::vector<RayHit> hits = rays.allHits(ray->inScene);
        std::erase_if(hits, [&](const RayHit& hit) { return !isDrawn(*scene, view, *ray, hit); });
        keepCrossings(*scene, view, hits);
        return static_cast<int>(hits.size() + strokesAt(*scene, view, *ray).size());
    }
};

ReferenceRenderer::ReferenceRenderer(ScenePtr scene) : impl_(std::make_unique<Impl>(std::move(scene))) {}
ReferenceRenderer::~ReferenceRenderer() = default;
ReferenceRenderer::ReferenceRenderer(ReferenceRenderer&&) noexcept = default;
ReferenceRenderer& ReferenceRenderer::operator=(ReferenceRenderer&&) noexcept = default;

Frame ReferenceRenderer::render(const Wall& wall, const Display& display, const Camera& camera,
                                const Options& options) const {
    if (options.samples < 1) throw UsageError("the reference needs at least one sample a pixel");
    const glm::dvec3 eyeM = eyeInScene(camera, wall.eyeM) - impl_->scene->originM;
    if (!(glm::length(eyeM) <= kFarthestEyeM))
        throw UsageError(
            fmt::format("the reference sees scenes from at most {:g} m away, and this eye is {:g} m "
                        "from the scene's origin",
                        kFarthestEyeM, glm::length(eyeM)));
    const bool isColor = options.output == OutputKind::color;
    std::optional<EdgeStrokes> edges;
    if (drawsEdges(options.style, options.output)) edges.emplace(*impl_->scene, options.style);
    View view{*display.projection,
              rotationFromOrientation(camera.orientation),
              eyeM,
              isColor ? 1 / std::sqrt(options.samples) : 1.0,
              options.style,
              edges ? &*edges : nullptr};
    std::optional<ProjectedStrokes> strokes;
    if (!impl_->scene->points.empty() || !impl_->scene->lines.empty())
        view.strokes =
            &strokes.emplace(*impl_->scene, display, view.sceneFromWall, view.eyeM, options.threads);

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
                for (const glm::dvec2 offset : samplePattern(options.samples, index ^ (options.seed << 40)))
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
