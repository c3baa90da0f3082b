#pragma once
// How much memory one calibration may ask for: a small file may name one large picture a thousand times, or a
// thousand large displays.

#include "calibration/errors.h"
#include "calibration/files/map_file.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <string>
#include <utility>

namespace curvewall {

// Nodes of maps, texels of pictures and pixels of blended displays that the files of one wall may have
// together. Larger files may ask for more.
class TexelBudget {
public:
    TexelBudget(std::string path, uint64_t fileBytes)
        : path_(std::move(path)), most_(kMaxMapTexels + 4 * static_cast<int64_t>(fileBytes)), left_(most_) {}

    // To be called before the memory is. Throws InputError, with `place` as the field, when all is spent.
    void take(glm::ivec2 sizePx, const std::string& place) {
        left_ -= int64_t{sizePx.x} * sizePx.y;
        if (left_ < 0)
            throw InputError(path_, place,
                             "maps and blended displays of at most " + std::to_string(most_) +
                                 " nodes and pixels together",
                             "more");
    }

private:
    std::string path_;
    int64_t most_, left_;
};

}  // namespace curvewall
