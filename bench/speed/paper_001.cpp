// Table 1 of Lorenz and Doellner (2009) with our city, on our displays.

#include "bench/speed/csv.h"
#include "bench/speed/parts.h"
#include "bench/speed/rounds.h"
#include "bench/speed/walls.h"
#include "renderer/scene/city.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace curvewall {
namespace {

struct Line {
    std::string name;
    RenderRequest request;
};

// The paper's pieces and our fewest, against the picture that the paper resampled.
std::vector<Line> linesOf(const std::string& name, const PieceWall& asInThePaper, const PieceWall& ours,
                          const RenderRequest& imageBased) {
    std::vector<Line> lines{{name + ": IB", imageBased}};
    for (const PieceWall* wall : {&asInThePaper, &ours}) {
        RenderRequest request = imageBased;
        request.wall = wall->wall;
        request.method = Method::piecewise;
        request.pieces = wall->pieces;
        request.tolerancePx = wall->tolerancePx;
        lines.push_back(
            {name + ": PPP, " + std::to_string(wall->pieces->mesh.pieces.size()) + " pieces", request});
    }
    for (size_t i = 0; i < 3; ++i) {
        Line line = lines[i];
        line.name += ", HQ";
        // As far as the software driver goes: it has 4 samples, and each step of anisotropy takes as long as
        // the one before.
        line.request.samples = line.request.anisotropy.emplace(4);
        line.request.frames = std::min(line.request.frames, 4);
        lines.push_back(std::move(line));
    }
    return lines;
}

void measure(const std::vector<Line>& lines, int rounds) {
    std::vector<RenderRequest> requests;
    requests.reserve(lines.size());
    for (const Line& line : lines) requests.push_back(line.request);
    Renderer renderer;
    const std::vector<Rounds> all = renderInTurns(renderer, requests, rounds);
    for (size_t i = 0; i < lines.size(); ++i) {
        print({"paper-001", lines[i].name}, medianRound(all[i]));
        print({"paper-001", lines[i].name}, "replication_ratio", all[i].front().replicationRatio());
        print({"paper-001", lines[i].name}, "times_ib", medianRatio(all[i], all[i < 3 ? 0 : 3]));
    }
}

}  // namespace

void measurePaper001(const SpeedOptions& options) {
    const auto city = std::make_shared<const Scene>(makeCity());
    const PieceWall cylinder = fullCylinder();
    RenderRequest cube = requestFor(cylinder, city, std::min(options.frames, 12));
    cube.method = Method::imageBased;
    cube.facePass = FacePass::layered;
    cube.faceSizePx = 2048;
    measure(linesOf("360 degree cylinder", evenCylinder({160, 1}), cylinder, cube), options.rounds);

    const PieceWall deformation = cameraTexture(0.25);
    RenderRequest picture = requestFor(deformation, city, std::min(options.frames, 12));
    picture.method = Method::imageBased;
    picture.source = SourceKind::planar;
    measure(linesOf("view deformation", evenCameraTexture({79, 59}), deformation, picture), options.rounds);
}

}  // namespace curvewall
