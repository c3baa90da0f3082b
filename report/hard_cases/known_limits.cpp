#include "report/hard_cases/known_limits.h"

#include <algorithm>

namespace curvewall {

const std::vector<KnownLimit>& knownLimits() {
    // Of a family those of any method come last: the first that fits explains.
    static const std::vector<KnownLimit> limits{
        {"pole crossing", "vertex-warp", 0.1, 9.5, 1.3, 0.0063,
         "Beside a pole a part of a triangle spans a wide range of azimuths, and its straight edges sweep "
         "across them. On displays larger than 100 px parts are smaller."},
        {"around the eye", "piecewise", 1e-3, 5.2, 2.1, 0.0053,
         "Corners are rounded to 1e-7 of their distance. Where the plane of a triangle is nearer to the eye "
         "than 1/5000 of the triangle's size this is 0.4 px, and nearer than 1/50,000 it opens gaps between "
         "pieces."},
        {"around the eye", "", 1e-5, 0.78, 0.61, 0.024,
         "Half as far as what every method cuts: what it cuts beside it depends on how it measures "
         "distances."},
        {"long edges", "piecewise", 179.9999, 16, 5.4, 0.013,
         "The corners are 1.6e6 m away, on edges that run past at 1 m: single precision knows them to 0.1 "
         "m."},
        {"vertex at the eye", "", 1e-6, 0.70, 0.57, 0.00087,
         "The sides are within a millionth of edge on, where the reference shows a few pixels of them that "
         "it should not, and each method a few others.",
         false},
        {"edge through the eye", "piecewise", 1e-4, 9.5, 2.6, 0.0031,
         "As around the eye: the triangle is 50,000 times as long as its plane is far from the eye."},
        {"edge through the eye", "", 1e-6, 0.70, 0.57, 0.0053,
         "The plane of the triangle is within a millionth of its corners' distance from the eye: it may show "
         "or not.",
         false},
        {"fan", "vertex-warp", 1e4, 0.093, 0.050, 0.021,
         "Parts thinner than the rasterizer's grid overlap where edges are divided: pixels are covered "
         "twice, by the same surface."},
        {"coplanar overlaps", "vertex-warp", 1e-4, 0.093, 0.050, 0.023,
         "Depths are linear within a part, which is off by the square of its angle: surfaces nearer to one "
         "another than 1e-3 of their distance on displays of 100 px, and 1e-5 on those of 500 px, shine "
         "through each other."},
        {"coplanar overlaps", "piecewise", 0, 0.31, 0.27, 0.0086,
         "No order is right in one plane, and each piece rounds otherwise."},
        {"fields of view, equidistant", "piecewise", 359.9, 620, 0.28, 0.0011,
         "The rim is one direction, seen all around: a point beyond it by less than a pixel belongs on the "
         "other side of the picture."},
        {"fields of view, equidistant", "image-based", 359.9, 220, 2.4, 0.00011,
         "The same, and texels there are many pixels wide.", false},
        {"fields of view, equidistant", "vertex-warp", 359.9, 0.61, 0.18, 0.0097,
         "The picture is torn at its rim, where parts are drawn to both sides."},
        {"fields of view, stereographic", "vertex-warp", 350, 0.79, 0.34, 0.00011,
         "Edges of 4 px are long on displays of 100 px that hold nearly all directions. On those of 512 px "
         "99 pixels in 100 are within 0.07 px."},
        {"fields of view, stereographic", "image-based", 359.9, 130, 110, 0.00011,
         "Faces end at 4096 px, and the display magnifies more than these: a texel is up to 100 px wide."},
        {"fields of view, curvilinear", "vertex-warp", 179.9, 0.76, 0.33, 0.00011,
         "As with stereographic lenses."},
        {"fields of view, curvilinear", "image-based", 179.9, 43, 30, 0.00011,
         "As with stereographic lenses."},
        {"eye at a curved wall", "vertex-warp", 1e-2, 2.0, 0.38, 0.0036,
         "Parts do not follow the wall beside the eye."},
        {"eye at a curved wall", "piecewise", 1e-4, 150, 0.18, 0.00011,
         "Some pixels see the wall along its surface, nearly: of 131,072 fewer than 60 are off by more than "
         "the tolerance.",
         false},
        {"eye at a curved wall", "image-based", 1e-2, 2700, 14, 0.00011,
         "Faces end at 4096 px, and the wall beside the eye is magnified more than these."},
        {"eye at a flat screen", "image-based", 1e-2, 270, 230, 0.00035,
         "Faces end at 4096 px; what is seen beside the axis is magnified more than these."},
        {"screen edge on", "image-based", 1, 1200, 1200, 0.00053, "As with the eye at a flat screen."},
        {"folds of a measured map", "piecewise", 1e-4, 330, 0.23, 0.00035,
         "Facets that the eye sees nearly edge on lose single pixels to single precision: up to 20 on a "
         "display of 512 x 384.",
         false},
        {"folds of a measured map", "vertex-warp", 0.1, 1.5, 0.95, 0.00011,
         "Where the map is squeezed straight parts do not follow it; squeezed more it is refused.", false},
        {"folds of a measured map", "image-based", 1e-2, 330, 44, 0.00019,
         "Where the map is squeezed, the display magnifies its source without end, and faces are as dense as "
         "all but the densest hundredth of the display."},
        {"noise in a measured map", "piecewise", 2, 12, 2.3, 0.00027,
         "The certificate tells where rays land. Where a noisy map nearly folds, where the ray that is shown "
         "comes from is off by several times that."},
        {"noise in a measured map", "vertex-warp", 2, 2.7, 1.1, 0.00053,
         "The picture nearly folds within a part."},
        {"noise in a measured map", "image-based", 8, 14, 4.6, 0.00018, "As where a map folds."},
    };
    return limits;
}

const KnownLimit* knownLimitOf(const HardCaseFamily& family, const CaseResult& result) {
    const auto placeOf = [&](double value) {
        return std::ranges::find(family.values, value) - family.values.begin();
    };
    if (result.outcome != Outcome::drawn || result.errors.nanTexels > 0) return nullptr;
    const auto found = std::ranges::find_if(knownLimits(), [&](const KnownLimit& limit) {
        return limit.family == family.name && result.method.starts_with(limit.methods) &&
               placeOf(limit.from) <= placeOf(result.value) && result.errors.geometric.maxPx <= limit.maxPx &&
               result.errors.geometric.p99Px <= limit.p99Px && result.faultyShare() <= limit.faultyShare;
    });
    return found == knownLimits().end() ? nullptr : &*found;
}

}  // namespace curvewall
