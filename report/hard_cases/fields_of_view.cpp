// Lenses around half turns and whole turns.

#include "report/hard_cases/case_scenes.h"
#include "report/hard_cases/case_walls.h"
#include "report/hard_cases/families.h"

namespace curvewall::hard_cases {
namespace {

const Camera kInRoom{{0.31, 0.22, 0.43}, {0.3, 0.1, 0.05}};

HardCaseFamily ofLens(const char* model, std::vector<double> fovsDeg, size_t pictured, std::string what) {
    return {
        std::string("fields of view, ") + model,
        std::move(what),
        "field of view, deg",
        std::move(fovsDeg),
        pictured,
        [model](double value, int sizePx) {
            return HardCase{fisheyeWall(model, value, glm::ivec2(sizePx)), shared(clutteredRoom(1)), kInRoom};
        }};
}

}  // namespace

std::vector<HardCaseFamily> fieldOfViewFamilies() {
    return {
        ofLens("equidistant", {90, 179.9, 180, 180.1, 270, 359.9, 360, 360.1}, 4,
               "The usual fisheye around half a turn, where a plane ahead no longer holds what it sees, and "
               "around a whole one, where its rim is a single direction."),
        ofLens("stereographic", {90, 179.9, 180, 180.1, 300, 350, 359.9, 360}, 4,
               "Near a whole turn its middle shrinks to nothing, while most of the picture is what lies "
               "straight behind; at a whole turn it is infinitely large."),
        ofLens(
            "orthographic", {90, 179.9, 180, 180.1}, 2,
            "Its pixels at the rim of half a turn see infinitely steep angles, and beyond there is nothing."),
        {"fields of view, curvilinear",
         "The curvilinear view on a rectangle, whose corners see farther around than its sides.",
         "field of view, deg",
         {60, 130, 170, 179.9, 180, 180.1, 359.9},
         1,
         [](double value, int sizePx) {
             return HardCase{wallOf({{"type", "curvilinear"}, {"fov_deg", value}}, {sizePx, sizePx * 3 / 4}),
                             shared(clutteredRoom(1)), kInRoom};
         }},
        {"more than a turn",
         "A cylinder whose picture goes around more than once and shows some directions twice, as "
         "overlapping panoramas do.",
         "arc, deg",
         {300, 359.9, 360, 360.1, 540, 720},
         4,
         [](double value, int sizePx) {
             const glm::ivec2 size(sizePx, sizePx / 2);
             return HardCase{
                 wallOf({{"type", "cylinder"}, {"radius", 2}, {"arc_deg", value}, {"height", 4}}, size),
                 shared(clutteredRoom(1)), kInRoom};
         }},
    };
}

}  // namespace curvewall::hard_cases
