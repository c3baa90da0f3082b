#pragma once
// Pairs that a render draws against the fewest that it could.

#include "calibration/pieces/piece_fit.h"
#include "renderer/render.h"
#include "tests/support/exact_pairs.h"
#include "tests/support/test_walls.h"

#include <algorithm>
#include <vector>

namespace curvewall::test {

struct Replication {
    double drawn = 0, exact = 0;  // pairs, all turns together
    double worstRatio = 0;        // of one turn

    double ratio() const { return drawn / exact; }
};

inline Camera turned(Camera camera, int turn, int turns) {
    camera.orientation.yawRad += 2 * kPi * turn / turns;
    return camera;
}

// The request must bring its pieces. Its camera looks around in even turns.
inline Replication replicationOf(Renderer& renderer, RenderRequest request, int turns) {
    const ExactPairCounter counter(*request.scene, request.pieces->mesh);
    const Camera ahead = request.camera;
    Replication all;
    for (int turn = 0; turn < turns; ++turn) {
        request.camera = turned(ahead, turn, turns);
        const auto drawn = static_cast<double>(renderer.render(request).stats.pairs);
        const auto exact = static_cast<double>(counter.count(request.camera, request.wall->eyeM).pairs);
        all.drawn += drawn;
        all.exact += exact;
        if (exact > 0) all.worstRatio = std::max(all.worstRatio, drawn / exact);
    }
    return all;
}

}  // namespace curvewall::test
