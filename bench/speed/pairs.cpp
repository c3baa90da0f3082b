// Pairs drawn against the smallest possible number.

#include "bench/speed/csv.h"
#include "bench/speed/parts.h"
#include "bench/speed/walls.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/replication_ratio.h"
#include "tests/support/sample_paths.h"

#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

namespace curvewall {
namespace {

constexpr int kTurns = 8;

struct NamedScene {
    std::string name;
    ScenePtr scene;
};

std::vector<NamedScene> scenes() {
    std::vector<NamedScene> all{{"city", std::make_shared<const Scene>(loadScene("city"))}};
    for (const char* file : {"dutch_ship/dutch_ship_medium_1k.gltf", "kenney_city/kenney_city.glb",
                             "vr_gallery/vr_gallery.glb"}) {
        const std::filesystem::path path = test::scenesFolder() / file;
        if (std::filesystem::exists(path))
            all.push_back({path.parent_path().filename(), std::make_shared<const Scene>(loadScene(path))});
        else
            std::cerr << "left out, as there is no " << path << '\n';
    }
    return all;
}

}  // namespace

void measurePairs(const SpeedOptions&) {
    Renderer renderer;
    const std::vector<PieceWall> walls{fullCylinder(), domeMaster(), cameraTexture()};
    for (const auto& [name, scene] : scenes()) {
        for (const PieceWall& wall : walls) {
            for (const int samples : {1, 4}) {
                RenderRequest request = requestFor(wall, scene, 1);
                request.samples = samples;
                const test::Replication found = test::replicationOf(renderer, request, kTurns);
                const Row row{"pairs", name + ", " + wall.name + ", samples " + std::to_string(samples)};
                print(row, "pairs", found.drawn / kTurns);
                print(row, "exact_pairs", found.exact / kTurns);
                print(row, "ratio", found.ratio());
                print(row, "worst_ratio", found.worstRatio);
            }
        }
    }
}

}  // namespace curvewall
