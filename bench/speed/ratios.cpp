// Frames of bent displays against those of plain ones, in one run.

#include "bench/speed/csv.h"
#include "bench/speed/parts.h"
#include "bench/speed/rounds.h"
#include "bench/speed/walls.h"
#include "renderer/scene/city.h"
#include "tests/support/replication_ratio.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

namespace curvewall {
namespace {

// Distinct triangles that face the eye and touch the display, the median over one turn of the camera.
double drawnTriangles(const PieceWall& wall, const Scene& scene, int turns) {
    const test::ExactPairCounter counter(scene, wall.pieces->mesh);
    std::vector<double> counts;
    counts.reserve(static_cast<size_t>(turns));
    for (int turn = 0; turn < turns; ++turn)
        counts.push_back(static_cast<double>(
            counter.count(test::turned(scene.defaultCamera, turn, turns), wall.wall->eyeM).triangles));
    const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
    std::ranges::nth_element(counts, middle);
    return *middle;
}

struct FittingCity {
    ScenePtr scene;
    double drawn = 0;
};

// The city of which a display draws so many triangles, within one percent.
FittingCity cityThatDraws(double triangles, const PieceWall& wall, int turns) {
    double least = kMinCityTriangles, most = kMaxCityTriangles;
    FittingCity found;
    while (most - least > 1) {
        const double middle = std::sqrt(least * most);
        found.scene = std::make_shared<const Scene>(makeCity(static_cast<uint32_t>(middle)));
        found.drawn = drawnTriangles(wall, *found.scene, turns);
        if (std::abs(found.drawn / triangles - 1) < 0.01) break;
        (found.drawn < triangles ? least : most) = middle;
    }
    return found;
}

struct Case {
    std::string name;
    RenderRequest request;
};

struct Demand {
    std::string name;
    size_t bent, plain;  // cases
    double mostRatio;
};

}  // namespace

void measureRatios(const SpeedOptions& options) {
    const int frames = options.frames;
    const auto city = std::make_shared<const Scene>(makeCity());
    const PieceWall cylinder = fullCylinder(), planar = planar90();
    const double drawn = drawnTriangles(cylinder, *city, frames);
    const FittingCity larger = cityThatDraws(drawn, planar, frames);
    const std::string largerName = "planar 90, city:" + std::to_string(larger.scene->triangles.size());
    print({"ratios", "full cylinder"}, "triangles_drawn", drawn);
    print({"ratios", largerName}, "triangles_drawn", larger.drawn);
    print({"ratios", "planar 90"}, "triangles_drawn", drawnTriangles(planar, *city, frames));

    const std::vector<Case> cases{
        {"full cylinder", requestFor(cylinder, city, frames)},
        {largerName, requestFor(planar, larger.scene, frames)},
        {"planar 90", requestFor(planar, city, frames)},
        {"camera texture", requestFor(cameraTexture(), city, frames)},
        {"dome master", requestFor(domeMaster(), city, frames)},
        {"planar 2048 up", requestFor(squareUp(), city, frames)},
        {"planar 2048 ahead", requestFor(squareAhead(), city, frames)},
    };
    std::vector<RenderRequest> requests;
    requests.reserve(cases.size());
    for (const Case& each : cases) requests.push_back(each.request);
    Renderer renderer;
    const std::vector<Rounds> rounds = renderInTurns(renderer, requests, options.rounds);
    for (size_t i = 0; i < cases.size(); ++i) print({"ratios", cases[i].name}, medianRound(rounds[i]));

    const std::array demands{
        Demand{"full cylinder to planar 90 with as many triangles", 0, 1, 1.3},
        Demand{"full cylinder to planar 90 of the same city", 0, 2, 0},
        Demand{"camera texture to its undistorted picture", 3, 2, 1.5},
        Demand{"dome master to planar 2048 up", 4, 5, 2},
        Demand{"dome master to planar 2048 ahead", 4, 6, 2},
    };
    for (const auto& [name, bent, plain, mostRatio] : demands) {
        print({"ratios", name}, "ratio", medianRatio(rounds[bent], rounds[plain]));
        if (mostRatio > 0) print({"ratios", name}, "demanded_ratio", mostRatio);
    }
}

}  // namespace curvewall
