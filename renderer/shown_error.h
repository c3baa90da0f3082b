#pragma once
// The geometric error of a picture, whatever drew it: how far from each pixel the display has the ray of what
// the pixel shows.

#include "calibration/pieces/certificate.h"
#include "calibration/wall.h"
#include "renderer/frame.h"

#include <optional>
#include <vector>

namespace curvewall {

// How far rays land from pixels on one display. On a closed one, whose right border shows what its left
// border shows, distances go the shorter way around.
class PixelDistance {
public:
    explicit PixelDistance(const Display& display);

    // To the nearest place that sees `ray`, or that would just beyond the border of what the projection
    // knows. Nothing where no place does.
    std::optional<double> from(glm::dvec2 px, glm::dvec3 ray) const;

private:
    std::optional<double> acrossTheBorder(glm::dvec2 px, glm::dvec3 ray) const;

    const Display& display_;
    bool isClosed_;
};

// Of an output of OutputKind::position with one sample, row by row from the top: NaN where nothing is shown,
// infinity where the point is one that the display does not see anywhere.
std::vector<float> shownErrorsPx(const Frame& position, const Display& display);

// Over the pixels that show something.
Certificate shownError(const Frame& position, const Display& display);

}  // namespace curvewall
