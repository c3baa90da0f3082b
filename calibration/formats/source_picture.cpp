#include "calibration/formats/source_picture.h"

#include "calibration/projections/equirectangular_lens.h"
#include "calibration/projections/frustum.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/radial_lens.h"

#include <glm/trigonometric.hpp>

#include <cmath>
#include <memory>
#include <numbers>

namespace curvewall {
namespace {

enum class Source { perspective, domeMaster, equirectangular };

ProjectionPtr perspectiveView(double fovDeg, glm::ivec2 sizePx) {
    Frustum view;
    view.rightRad = glm::radians(fovDeg / 2);
    view.leftRad = -view.rightRad;
    view.upRad = std::atan(std::tan(view.rightRad) * sizePx.y / sizePx.x);
    view.downRad = -view.upRad;
    return std::make_shared<FrustumProjection>(view, sizePx);
}

}  // namespace

SourcePicture decideSource(const CalibrationRequest& request, glm::ivec2 sizePx, Decisions& decisions) {
    constexpr double kPi = std::numbers::pi;
    if (request.source) return *request.source;
    const auto atInfinity = [&](LensPtr lens) -> SourcePicture {
        return {sizePx, std::make_shared<LensProjection>(std::move(lens), Orientation{})};
    };
    switch (decisions.choose<Source>(
        "source",
        {{"perspective", Source::perspective},
         {"dome_master", Source::domeMaster},
         {"equirectangular", Source::equirectangular}},
        Source::perspective, "the file does not say what its picture shows; flat pictures are usual")) {
        case Source::domeMaster:
            return atInfinity(circularLens({RadialModel::equidistant},
                                           glm::radians(decisions.number("source_fov_deg", {1, 360}, 180,
                                                                         "dome masters show half a turn")),
                                           sizePx));
        case Source::equirectangular:
            return atInfinity(std::make_shared<EquirectangularLens>(2 * kPi, kPi, sizePx));
        case Source::perspective:
            break;
    }
    const double fovDeg =
        decisions.number("source_fov_deg", {1, 170}, 90, "the file does not say how wide its picture looks");
    return {sizePx, perspectiveView(fovDeg, sizePx)};
}

}  // namespace curvewall
