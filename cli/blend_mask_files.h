#pragma once
// inspect --blend: the masks of a wall as files, and what is said about them.

#include "calibration/blending/blend_masks.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace curvewall {

struct BlendMaskFiles {
    struct Entry {
        std::string display;
        std::string path;         // of the mask
        std::string pathForWall;  // as the wall file would name it
        double overlapShare = 0;
    };
    std::vector<Entry> entries;
    BlendSum sum;
};

// Writes FOLDER/DISPLAY-alpha.png for every display; the folder is there.
BlendMaskFiles writeBlendMasks(const Wall& wall, const std::string& wallPath, const std::string& folder);

nlohmann::json toJson(const BlendMaskFiles& files);
void printReport(const BlendMaskFiles& files);

}  // namespace curvewall
