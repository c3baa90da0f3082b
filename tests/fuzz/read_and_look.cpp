#include "tests/fuzz/read_and_look.h"

#include "calibration/errors.h"
#include "calibration/files/json_fields.h"
#include "calibration/formats/calibration_file.h"
#include "calibration/readers/wall_reader.h"

#include <glm/vec2.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

namespace curvewall::test {
namespace {

using namespace std::string_view_literals;

// Small, so that a million inputs take minutes.
constexpr glm::ivec2 kSizePx(8, 6);
constexpr int kLooks = 5;

[[noreturn]] void die(const char* what) {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

void look(const Display& display) {
    for (int y = 0; y < kLooks; ++y)
        for (int x = 0; x < kLooks; ++x) {
            const glm::dvec2 px = glm::dvec2(display.sizePx) * (glm::dvec2(x, y) + 0.5) / double(kLooks);
            const auto ray = display.projection->unproject(px);
            if (!ray) continue;
            if (!(std::isfinite(ray->x) && std::isfinite(ray->y) && std::isfinite(ray->z)))
                die("a ray is not finite");
            for (const glm::dvec2 back : display.projection->project(*ray))
                if (std::isnan(back.x) || std::isnan(back.y)) die("a position is not a number");
        }
}

// A white pixel.
std::string smallPng() {
    static constexpr std::string_view kPng =
        "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\b\0\0\0\0\x3a\x7e\x9b\x55"
        "\0\0\0\nIDAT\x78\x9c\x63\xf8\x0f\0\1\1\1\0\xb1\x38\xf6\x14\0\0\0\0IEND\xae\x42\x60\x82"sv;
    return std::string(kPng);
}

// Where the whole picture is shown as it is.
std::string smallPfm() {
    std::string file = "PF\n2 2\n-1\n";
    for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f})
        file.append(std::bit_cast<std::array<char, sizeof value>>(value).data(), sizeof value);
    return file;
}

// A file that another file names: the smallest one that its name lets expect.
std::optional<FileBytes> smallFile(const std::string& name) {
    static const std::map<std::string, std::string> kByEnding{
        {"_frustum.csv",
         "x;y;z;heading;pitch;bank;left;right;bottom;top;tanLeft;tanRight;tanBottom;tanTop;width;height\n"
         "0;0;0;10;20;30;-40;45;-30;35;-0.8391;1;-0.57735;0.70021;1.8391;1.27756\n"},
        {".csv", "x;y;u;v;column;row\n0;0;0;0;0;0\n1;0;1;0;1;0\n0;1;0;1;0;1\n1;1;1;1;1;1\n"},
        {".data", "2\n2 2\n-1 -1 0 0 1\n1 -1 1 0 1\n-1 1 0 1 1\n1 1 1 1 0.5\n"},
        {".ini", "[channel1]\ncalibFile=display.vwf\ncalibIndex=0\ndir=[10,20,30]\nfov=[40,30,45,35]\n"},
        {".obj", "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0.5 1\nf 1/1 2/2 3/3\n"},
        {".pfm", smallPfm()},
        {".png", smallPng()},
    };
    const std::string lower = lowerCase(name);
    // The longest ending comes first.
    for (const auto& [ending, bytes] : kByEnding)
        if (lower.ends_with(ending) && (ending != ".csv" || !lower.ends_with("_frustum.csv")))
            return FileBytes{name, bytes};
    return std::nullopt;
}

Wall readAs(const std::string& name, std::string_view bytes) {
    const FileBytes file{name, std::string(bytes)};
    if (name == "wall.json") return readWallFile(file);
    Decisions decisions;
    return readCalibration(file, smallFile, {.sizePx = kSizePx}, decisions);
}

}  // namespace

void readAndLook(const std::string& name, std::string_view bytes) {
    try {
        for (const Display& display : readAs(name, bytes).displays) look(display);
    } catch (const InputError&) {
    } catch (const UsageError&) {
    }
}

}  // namespace curvewall::test
