#pragma once
// What can be measured. docs/speed.md tells what each is for.

#include "renderer/request_limits.h"

#include <cstdint>
#include <string>
#include <vector>

namespace curvewall {

struct SpeedOptions {
    int frames = 36;  // of one turn of the camera
    int rounds = 3;   // where times are compared
    uint32_t mostTriangles = 5'000'000;
    std::vector<std::string> walls, scenes;  // of measureMethods
    bool firstDisplays = false;              // of each wall only
    double tolerancePx = kDefaultTolerancePx;
};

void measurePairs(const SpeedOptions& options);
void measureRatios(const SpeedOptions& options);
void measureStages(const SpeedOptions& options);
void measureTriangles(const SpeedOptions& options);
void measurePieces(const SpeedOptions& options);
void measureEngines(const SpeedOptions& options);
void measurePaper000(const SpeedOptions& options);
void measurePaper001(const SpeedOptions& options);
void measureMethods(const SpeedOptions& options);
void measureLook(const SpeedOptions& options);

}  // namespace curvewall
