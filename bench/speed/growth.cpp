// What more triangles cost, what more pieces cost, and what a camera costs that sees little.

#include "bench/speed/csv.h"
#include "bench/speed/parts.h"
#include "bench/speed/walls.h"
#include "renderer/scene/city.h"
#include "tests/support/test_walls.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

namespace curvewall {
namespace {

constexpr uint32_t kManyTriangles = 1'000'000;

// Frames of so many triangles take seconds on a processor.
int framesFor(uint32_t triangles, const SpeedOptions& options) {
    return triangles < kManyTriangles ? options.frames : std::min(options.frames, 8);
}

// Beyond the city's last house on the side of +z.
glm::dvec3 placeOutside(const Scene& city) {
    float farthest = std::numeric_limits<float>::lowest();
    for (const glm::vec3& position : city.positions) farthest = std::max(farthest, position.z);
    return city.originM + glm::dvec3(0, 8, farthest + 10);
}

struct Look {
    std::string name;
    Camera camera;
};

// The same picture so many times; a request of several frames would turn the camera.
void measureStill(Renderer& renderer, const RenderRequest& request, const Row& row, int times) {
    std::vector<RenderStats> all;
    all.reserve(static_cast<size_t>(times));
    renderer.render(request);
    for (int i = 0; i < times; ++i) all.push_back(renderer.render(request).stats);
    std::ranges::sort(all, {}, &RenderStats::frameMsMedian);
    print(row, all[all.size() / 2]);
}

}  // namespace

void measureTriangles(const SpeedOptions& options) {
    const PieceWall cylinder = fullCylinder();
    for (const uint32_t triangles : {5'000u, 50'000u, 500'000u, 5'000'000u}) {
        if (triangles > options.mostTriangles) continue;
        const auto city = std::make_shared<const Scene>(makeCity(triangles));
        Renderer renderer;
        print({"triangles", std::to_string(triangles)},
              renderer.render(requestFor(cylinder, city, framesFor(triangles, options))).stats);
    }
}

void measurePieces(const SpeedOptions& options) {
    const auto city = std::make_shared<const Scene>(makeCity());
    std::vector<PieceWall> walls;
    for (const double tolerancePx : {60.0, 8.0, 2.0, 0.5, 0.2, 0.1}) walls.push_back(domeMaster(tolerancePx));
    for (const glm::ivec2 cells :
         {glm::ivec2(10, 1), {15, 2}, {25, 4}, {50, 6}, {100, 10}, {150, 20}, {250, 40}})
        walls.push_back(evenCylinder(cells));
    for (const PieceWall& wall : walls) {
        Renderer renderer;
        print({"pieces", wall.name + ", " + std::to_string(wall.pieces->mesh.pieces.size())},
              renderer.render(requestFor(wall, city, options.frames)).stats);
    }
}

void measureLook(const SpeedOptions& options) {
    const auto city = std::make_shared<const Scene>(makeCity(options.mostTriangles));
    const glm::dvec3 outside = placeOutside(*city);
    const std::vector<Look> looks{
        {"from its middle", city->defaultCamera},
        {"from outside", {outside, {}}},
        {"away from it", {outside, {test::kPi, 0, 0}}},
        {"up from above", {city->originM + glm::dvec3(0, 500, 0), {0, test::kPi / 2, 0}}},
    };
    Renderer renderer;
    for (const PieceWall& wall : {planar90(), quarterCylinder()}) {
        for (const auto& [name, camera] : looks) {
            RenderRequest request = requestFor(wall, city, 1);
            request.camera = camera;
            measureStill(renderer, request, {"look", wall.name + ", " + name},
                         framesFor(options.mostTriangles, options));
        }
    }
}

}  // namespace curvewall
