#include "renderer/lookup_mesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <optional>

namespace curvewall {
namespace {

size_t indexOf(glm::ivec2 px, glm::ivec2 sizePx) {
    return static_cast<size_t>(px.y) * static_cast<size_t>(sizePx.x) + static_cast<size_t>(px.x);
}

glm::dvec2 placeIn(const LookupCell& cell, glm::ivec2 px) {
    const auto& [topLeft, topRight, bottomLeft, bottomRight] = cell.places;
    const glm::dvec2 at = (centreOf(px) - glm::dvec2(cell.fromPx)) / glm::dvec2(cell.toPx - cell.fromPx);
    if (at.x + at.y <= 1) return topLeft + at.x * (topRight - topLeft) + at.y * (bottomLeft - topLeft);
    return bottomRight + (1 - at.x) * (bottomLeft - bottomRight) + (1 - at.y) * (topRight - bottomRight);
}

class MeshMaker {
public:
    MeshMaker(const ImageSource& source, const PixelRays& rays, const Projection& projection)
        : source_(source),
          projection_(projection),
          sizePx_(rays.sizePx()),
          places_(sourcePlaces(source, rays)),
          gradients_(sourceGradients(source, rays)) {}

    void add(glm::ivec2 fromPx, glm::ivec2 toPx) {
        if (!seesAnything(fromPx, toPx)) return;
        if (const auto whole = cellOf(fromPx, toPx)) {
            cells_.push_back(*whole);
            return;
        }
        const glm::ivec2 size = toPx - fromPx;
        if (size == glm::ivec2(1)) {
            cells_.push_back(pixelCell(fromPx));
            return;
        }
        const glm::ivec2 middlePx = fromPx + size / 2;
        for (const glm::ivec2 half : {glm::ivec2(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
            const glm::ivec2 from(half.x ? middlePx.x : fromPx.x, half.y ? middlePx.y : fromPx.y);
            const glm::ivec2 to(half.x ? toPx.x : middlePx.x, half.y ? toPx.y : middlePx.y);
            if (from.x < to.x && from.y < to.y) add(from, to);
        }
    }

    std::vector<LookupCell> take() { return std::move(cells_); }

private:
    const glm::vec4& placeOf(glm::ivec2 px) const { return places_[indexOf(px, sizePx_)]; }

    bool seesAnything(glm::ivec2 fromPx, glm::ivec2 toPx) const {
        for (int y = fromPx.y; y < toPx.y; ++y)
            for (int x = fromPx.x; x < toPx.x; ++x)
                if (placeOf({x, y}).w != 0) return true;
        return false;
    }

    bool allSee(float face, glm::ivec2 fromPx, glm::ivec2 toPx) const {
        for (int y = fromPx.y; y < toPx.y; ++y)
            for (int x = fromPx.x; x < toPx.x; ++x)
                if (const glm::vec4& place = placeOf({x, y}); place.w == 0 || place.z != face) return false;
        return true;
    }

    // Nothing where one picture does not hold all of it with room for a filter.
    std::optional<LookupCell> cellOf(glm::ivec2 fromPx, glm::ivec2 toPx) const {
        const float index = placeOf(fromPx).z;
        if (!allSee(index, fromPx, toPx)) return std::nullopt;
        const SourceFace& face = source_.faces[static_cast<size_t>(index)];
        LookupCell cell{fromPx, toPx, {}, static_cast<int>(index)};
        for (size_t i = 0; i < 4; ++i) {
            const glm::ivec2 corner(i % 2 ? toPx.x : fromPx.x, i / 2 ? toPx.y : fromPx.y);
            const auto ray = projection_.unproject(glm::dvec2(corner));
            if (!ray || !(glm::dot(*ray, face.axes.ahead) > 0)) return std::nullopt;
            cell.places[i] = face.place(*ray);
        }
        return leavesRoom(cell, face) ? std::optional(cell) : std::nullopt;
    }

    // Corners may lie beyond the picture: it ends with the centres of the display's outermost pixels, and
    // between corners only centres are looked up. A bicubic filter reaches one and a half texels.
    bool leavesRoom(const LookupCell& cell, const SourceFace& face) const {
        const double roomPx = source_.apronPx - 0.5;
        const glm::dvec2 leastPx(roomPx), mostPx = glm::dvec2(face.sizePx) - roomPx;
        for (int y = cell.fromPx.y; y < cell.toPx.y; ++y)
            for (int x = cell.fromPx.x; x < cell.toPx.x; ++x)
                if (const glm::dvec2 place = placeIn(cell, {x, y});
                    place != glm::clamp(place, leastPx, mostPx))
                    return false;
        return true;
    }

    LookupCell pixelCell(glm::ivec2 px) const {
        const glm::vec4 place = placeOf(px), gradient = gradients_[indexOf(px, sizePx_)];
        const glm::dvec2 centre(place.x, place.y);
        const glm::dvec2 right = glm::dvec2(gradient.x, gradient.y) / 2.0;
        const glm::dvec2 down = glm::dvec2(gradient.z, gradient.w) / 2.0;
        return {px,
                px + 1,
                {centre - right - down, centre + right - down, centre - right + down, centre + right + down},
                static_cast<int>(place.z)};
    }

    const ImageSource& source_;
    const Projection& projection_;
    glm::ivec2 sizePx_;
    std::vector<glm::vec4> places_, gradients_;
    std::vector<LookupCell> cells_;
};

}  // namespace

std::vector<LookupCell> lookupMesh(const ImageSource& source, const PixelRays& rays,
                                   const Projection& projection, int stepPx) {
    const glm::ivec2 sizePx = rays.sizePx();
    MeshMaker maker(source, rays, projection);
    for (int y = 0; y < sizePx.y; y += stepPx)
        for (int x = 0; x < sizePx.x; x += stepPx)
            maker.add({x, y}, glm::min(glm::ivec2(x, y) + stepPx, sizePx));
    return maker.take();
}

std::vector<glm::vec4> meshPlaces(const std::vector<LookupCell>& mesh, glm::ivec2 sizePx) {
    std::vector<glm::vec4> places(indexOf({0, sizePx.y}, sizePx), glm::vec4(0));
    for (const LookupCell& cell : mesh)
        for (int y = cell.fromPx.y; y < cell.toPx.y; ++y)
            for (int x = cell.fromPx.x; x < cell.toPx.x; ++x)
                places[indexOf({x, y}, sizePx)] = {glm::vec2(placeIn(cell, {x, y})), cell.face, 1};
    return places;
}

}  // namespace curvewall
