// Stages of a frame, and the engines side by side.

#include "bench/speed/csv.h"
#include "bench/speed/parts.h"
#include "bench/speed/rounds.h"
#include "bench/speed/walls.h"
#include "renderer/names.h"
#include "renderer/scene/city.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace curvewall {

void measureStages(const SpeedOptions& options) {
    const auto city = std::make_shared<const Scene>(makeCity());
    const std::vector<PieceWall> walls{fullCylinder(), cameraTexture(), domeMaster(), planar90()};
    std::vector<RenderRequest> requests;
    requests.reserve(walls.size());
    for (const PieceWall& wall : walls) requests.push_back(requestFor(wall, city, options.frames));
    Renderer renderer;
    const std::vector<Rounds> rounds = renderInTurns(renderer, requests, options.rounds);
    for (size_t i = 0; i < walls.size(); ++i) print({"stages", walls[i].name}, medianRound(rounds[i]));
}

void measureEngines(const SpeedOptions& options) {
    const auto city = std::make_shared<const Scene>(makeCity());
    // The baseline takes seconds a frame.
    const int frames = std::min(options.frames, 12), loopFrames = std::min(options.frames, 3);
    for (const PieceWall& wall : {fullCylinder(), cameraTexture(), domeMaster()}) {
        std::vector<RenderRequest> requests;
        for (const Engine engine : {Engine::compute, Engine::geometry, Engine::tessellation, Engine::loop}) {
            requests.push_back(requestFor(wall, city, engine == Engine::loop ? loopFrames : frames));
            requests.back().engine = engine;
        }
        Renderer renderer;
        const std::vector<Rounds> rounds = renderInTurns(renderer, requests, options.rounds);
        for (size_t i = 0; i < requests.size(); ++i)
            print({"engines", wall.name + ", " + std::string(nameOf(requests[i].engine))},
                  medianRound(rounds[i]));
    }
}

}  // namespace curvewall
