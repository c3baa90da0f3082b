#pragma once
// One side of a picture that is linear in an angle about an axis, over less than a turn, exactly a turn or
// more.

#include <vector>

namespace curvewall {

struct AngleAxis {
    double arcRad = 0;    // from one border of the picture to the other; 0 is in the middle
    double lengthPx = 0;  // of that side

    double angleAt(double px) const { return (px / lengthPx - 0.5) * arcRad; }

    // Every position that shows the angle, which lies within half a turn either way. Up to a turn there is
    // one, which may be outside the picture; on exactly a turn it lies in [0, length); beyond a turn there
    // are those of the picture.
    std::vector<double> positionsOf(double angleRad) const;
};

}  // namespace curvewall
