#pragma once
// Files of numbers in the shape of a picture: offset grids, surface points, masks.

#include "calibration/files/file_bytes.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace curvewall {

// Of a display or a map in each direction.
inline constexpr int64_t kMostPx = 16384;

// A damaged header must not make us ask for all memory there is. 16,384 x 16,384 passes.
inline constexpr int64_t kMaxMapTexels = int64_t{1} << 28;
inline constexpr int64_t kMaxMapSidePx = int64_t{1} << 24;
inline constexpr int kMaxMapChannels = 4;

struct NumberMap {
    glm::ivec2 sizePx{0};
    int channels = 0;
    bool isInteger = false;     // the file holds 8 or 16-bit integers; they come as fractions of the largest
    std::vector<float> values;  // row 0 is the top row; channels are interleaved
    double scale = 1;           // of a PFM, which says that the numbers are in units of it; not applied

    const float* at(int x, int y) const {
        return &values[(static_cast<size_t>(y) * static_cast<size_t>(sizePx.x) + static_cast<size_t>(x)) *
                       static_cast<size_t>(channels)];
    }
};

// The size that a header says. Throws InputError where it is none, or more than a map may have.
glm::ivec2 mapSizePx(const std::string& path, int64_t width, int64_t height, int channels);

// Throws InputError where the file is too small to hold numbers of that many pixels and channels, however
// well they are packed: a damaged header must not take all memory there is.
void requirePlausibleSize(const std::string& path, uint64_t fileBytes, const NumberMap& map);

// Every format that OpenImageIO reads. Numbers are not touched: no transfer function, no alpha
// multiplied in. Throws InputError.
NumberMap readNumberMap(const std::string& path);

// The same from memory, for PFM and for the pictures that isPicture knows. `allow` gets the size that the
// header says, before the memory for it is taken, and may throw.
using AllowSize = std::function<void(glm::ivec2 sizePx)>;
NumberMap readNumberMap(const FileBytes& file, const AllowSize& allow = {});

// Whether the bytes begin like EXR, PNG, TIFF, JPEG or BMP.
bool isPicture(std::string_view bytes);
bool isExr(std::string_view bytes);

// One or three channels of numbers from 0 to 1 as a 16-bit PNG, likewise untouched. Throws std::runtime_error
// where it cannot be written.
void writePng16(const std::string& path, const NumberMap& map);

}  // namespace curvewall
