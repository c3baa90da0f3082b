#pragma once
// How points and lines look on a display, whatever their distance and whichever method draws them.

namespace curvewall {

inline constexpr float kPointSizePx = 3;     // the diameter of a disc
inline constexpr float kLineWidthPx = 1.5f;  // of a capsule: the ends are round

}  // namespace curvewall
