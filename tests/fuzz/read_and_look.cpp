#include "tests/fuzz/read_and_look.h"

#include "calibration/errors.h"
#include "calibration/files/json_fields.h"
#include "calibration/formats/calibration_file.h"
#include "calibration/readers/wall_reader.h"

#include <glm/vec2.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

namespace curvewall::test {
namespace {

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

// A file that another file names: the smallest one that its name lets expect.
std::optional<FileBytes> smallFile(const std::string& name) {
    static const std::map<std::string, std::string> kFiles{
        {".csv", "x;y;u;v;column;row\n0;0;0;0;0;0\n1;0;1;0;1;0\n0;1;0;1;0;1\n1;1;1;1;1;1\n"},
        {".data", "2\n2 2\n-1 -1 0 0 1\n1 -1 1 0 1\n-1 1 0 1 1\n1 1 1 1 0.5\n"},
        {".obj", "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0.5 1\nf 1/1 2/2 3/3\n"},
        {".pfm", std::string("Pf\n1 1\n-1\n\0\0\0\x3f", 14)},
    };
    FileBytes file{name, ""};
    const auto found = kFiles.find(file.extension());
    if (found == kFiles.end()) return std::nullopt;
    file.bytes = found->second;
    return file;
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
