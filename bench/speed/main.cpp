// What a frame costs, and why, as CSV. Run it on an otherwise idle machine.

#include "bench/speed/csv.h"
#include "bench/speed/parts.h"
#include "renderer/gl/egl_context.h"
#include "renderer/scene/city.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <exception>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

namespace curvewall {
namespace {

struct Part {
    const char* name;
    void (*measure)(const SpeedOptions&);
};

constexpr std::array kParts{
    Part{"pairs", measurePairs},         Part{"ratios", measureRatios},   Part{"stages", measureStages},
    Part{"triangles", measureTriangles}, Part{"pieces", measurePieces},   Part{"engines", measureEngines},
    Part{"look", measureLook},           Part{"methods", measureMethods}, Part{"paper-000", measurePaper000},
    Part{"paper-001", measurePaper001},
};

void measure(const std::vector<std::string>& names, const SpeedOptions& options) {
    printHeader();
    print({"machine", "gl_renderer"}, "name", EglContext().rendererName());
    print({"machine", "processors"}, "count", std::thread::hardware_concurrency());
    for (const Part& part : kParts)
        if (names.empty() || std::ranges::find(names, part.name) != names.end()) part.measure(options);
}

}  // namespace
}  // namespace curvewall

int main(int argc, char** argv) {
    using namespace curvewall;
    CLI::App app("What a frame costs, and why, as CSV");
    std::vector<std::string> names, known;
    for (const Part& part : kParts) known.emplace_back(part.name);
    SpeedOptions options;
    app.add_option("parts", names, "What to measure; all without")->check(CLI::IsMember(known));
    app.add_option("--frames", options.frames, "Frames of one turn of the camera")
        ->check(CLI::Range(1, 3600))
        ->capture_default_str();
    app.add_option("--rounds", options.rounds, "Rounds in turns where times are compared")
        ->check(CLI::Range(1, 99))
        ->capture_default_str();
    app.add_option("--most-triangles", options.mostTriangles, "Of the largest city")
        ->check(CLI::Range(kMinCityTriangles, kMaxCityTriangles))
        ->capture_default_str();
    app.add_option("--walls", options.walls,
                   "Wall files, for the part methods; without them nothing is measured");
    app.add_flag("--first-displays", options.firstDisplays, "Only one display of each of these walls");
    app.add_option("--scenes", options.scenes, "Scenes, for the part methods")->capture_default_str();
    app.add_option("--tolerance", options.tolerancePx, "For the part methods, pixels")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    try {
        measure(names, options);
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
