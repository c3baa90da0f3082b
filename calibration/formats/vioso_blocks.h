#pragma once
// The blocks of a VIOSO warp file (.vwf), as VIOSO's open interface defines them: little endian, a set header
// or none, then warps, each followed by bitmaps of its blend and black level.

#include "calibration/files/file_bytes.h"
#include "calibration/files/map_file.h"

#include <glm/vec2.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace curvewall {

// Flags of a warp's header.
namespace vioso {
inline constexpr uint32_t kZipped = 0x1, kSplit = 0x2, kBorder = 0x8, kBlackLevel = 0x20, kPoints = 0x40,
                          kEncrypted = 0x400;
}

struct ViosoWarp {
    std::string name;   // may be empty
    std::string place;  // for messages: "block 0"
    uint32_t flags = 0;
    float blackScale = 0, blackDark = 0, blackBright = 0;
    NumberMap numbers{};  // u and v, or x, y and z; invalid ones are NaN; no values where the block has none
    std::optional<NumberMap> blend{}, black{};
    bool hasWhite = false;
};

bool isVioso(std::string_view bytes);

// Throws InputError for a file that is not whole, for blocks of other kinds, and for warps that are zipped or
// encrypted.
std::vector<ViosoWarp> parseVioso(const FileBytes& file);

}  // namespace curvewall
