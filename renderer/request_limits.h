#pragma once
// What may be asked for, on the command line and over the network alike.

namespace curvewall {

inline constexpr double kDefaultTolerancePx = 0.25;
inline constexpr double kLeastTolerancePx = 0.001;
inline constexpr double kMostTolerancePx = 100;
// Of vertex-warp; 0 is allowed as well.
inline constexpr double kLeastTessellationPx = 1;
inline constexpr double kMostTessellationPx = 1000;
inline constexpr int kLeastFacePx = 16;
inline constexpr int kMostFacePx = 8192;
inline constexpr int kMostAutomaticFacePx = 4096;  // six of them are 400 MB
inline constexpr int kDefaultMeshStepPx = 16;
inline constexpr int kLeastMeshStepPx = 4;
inline constexpr int kMostMeshStepPx = 256;
inline constexpr int kMostSamples = 4096;
inline constexpr int kMostAnisotropy = 16;

}  // namespace curvewall
