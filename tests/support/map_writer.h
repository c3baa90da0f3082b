#pragma once
// Files of numbers as calibrations come in.

#include "calibration/files/map_file.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

namespace curvewall::test {

// The bytes of a PFM file; the map has one or three channels.
inline std::string pfmBytes(const NumberMap& map, bool bigEndian = false) {
    std::string bytes = (map.channels == 3 ? "PF\n" : "Pf\n") + std::to_string(map.sizePx.x) + " " +
                        std::to_string(map.sizePx.y) + "\n" + (bigEndian ? "1.0" : "-1.0") + "\n";
    for (int y = map.sizePx.y - 1; y >= 0; --y)
        for (int i = 0; i < map.sizePx.x * map.channels; ++i) {
            char number[4];
            std::memcpy(number, map.at(0, y) + i, 4);
            if (bigEndian) std::reverse(number, number + 4);
            bytes.append(number, 4);
        }
    return bytes;
}

// Any format that OpenImageIO writes.
inline void writeMap(const std::string& path, const NumberMap& map,
                     OIIO::TypeDesc type = OIIO::TypeDesc::FLOAT, const std::string& compression = "zip") {
    OIIO::ImageSpec spec(map.sizePx.x, map.sizePx.y, map.channels, type);
    if (type.is_floating_point()) spec.attribute("compression", compression);
    const auto out = OIIO::ImageOutput::create(path);
    if (!out || !out->open(path, spec) || !out->write_image(OIIO::TypeDesc::FLOAT, map.values.data()))
        throw std::runtime_error("no " + path);
    out->close();
}

}  // namespace curvewall::test
