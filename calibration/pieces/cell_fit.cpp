#include "calibration/pieces/cell_fit.h"

#include "calibration/parallel.h"
#include "calibration/pieces/cell_mesh.h"
#include "calibration/pieces/ownership.h"
#include "calibration/pieces/piece_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace curvewall {
namespace {

// A cell's own best plane may be off by about this many times the tolerance: balancing gains so much.
constexpr double kGainOfBalance = 1.4;
// Planes of neighbours on a smooth display are apart by a few times what either is off.
constexpr double kMostDisagreement = 8;
// Where more cells than this fail, all of them should have been smaller.
constexpr double kFewFailures = 0.1;
// Halving one first cell makes cells of 1/2, 1/4 ... of the display; other first counts put sizes between.
constexpr std::array<int, 3> kOtherFirstCounts{3, 5, 7};

// A display cut into cells, each with its own best plane.
struct CutDisplay {
    CellTree tree;
    std::vector<CellFacets> facets;  // of every cell of the tree
    size_t pieceCount = 0;
};

class CellFit {
public:
    CellFit(const RayImage& rays, double tolerancePx, const std::stop_token& stop)
        : rays_(rays), tolerancePx_(tolerancePx), stop_(stop) {}

    PieceMesh fit() {
        double errorPx = kGainOfBalance * tolerancePx_;
        CutDisplay display = bestCuts(errorPx);
        PieceMesh mesh;
        std::vector<uint32_t> failing = tryFit(display, mesh);
        while (shouldAllBeSmaller(display, failing) && errorPx > tolerancePx_) {
            errorPx *= 0.9;
            display = bestCuts(errorPx);
            failing = tryFit(display, mesh);
        }
        while (!failing.empty()) {
            for (uint32_t cell : failing) refine(display, cell);
            failing = tryFit(display, mesh);
        }
        return mesh;
    }

private:
    // Cuts cells until the own best plane of each is off by `errorPx` at most, or there are more than
    // `mostPieces`.
    CutDisplay cutTo(double errorPx, glm::ivec2 firstCounts, size_t mostPieces) const {
        CutDisplay display{CellTree(rays_.sizePx(), firstCounts), {}, 0};
        for (uint32_t id = 0; id < display.tree.cellCount() && display.pieceCount <= mostPieces; ++id) {
            throwIfStopped(stop_);
            const Cell cell = display.tree.cell(id);
            const CellFacets& facets = display.facets.emplace_back(facetsOf(rays_, cell));
            if (facets.isEmpty) continue;
            const int axis = facets.errorPx <= errorPx ? -1 : bestCut(rays_, cell);
            if (axis >= 0)
                display.tree.cut(id, axis);
            else
                display.pieceCount += 2;
        }
        return display;
    }

    // The first counts that lead to the fewest pieces, for columns and then for rows.
    CutDisplay bestCuts(double errorPx) const {
        glm::ivec2 counts(1);
        CutDisplay best = cutTo(errorPx, counts, kMostPieces);
        if (best.pieceCount > kMostPieces) refuseTolerance(tolerancePx_);
        for (int axis : {0, 1}) {
            std::array<std::optional<CutDisplay>, kOtherFirstCounts.size()> tried;
            parallelRanges(static_cast<int>(tried.size()), [&](int begin, int end) {
                for (int i = begin; i < end; ++i) {
                    glm::ivec2 first = counts;
                    first[axis] = kOtherFirstCounts[static_cast<size_t>(i)];
                    tried[static_cast<size_t>(i)] = cutTo(errorPx, first, best.pieceCount);
                }
            });
            for (size_t i = 0; i < tried.size(); ++i) {
                if (tried[i]->pieceCount >= best.pieceCount) continue;
                best = std::move(*tried[i]);
                counts[axis] = kOtherFirstCounts[i];
            }
        }
        return best;
    }

    // Balances the facets. The answer is the cells that do not meet the tolerance.
    std::vector<uint32_t> tryFit(const CutDisplay& display, PieceMesh& mesh) const {
        const CellMesh cells =
            meshOfCells(display.tree, display.facets, rays_, loose_, kMostDisagreement * tolerancePx_);
        constexpr double kMargin = 0.98;  // for the pixels between the samples
        mesh = balanceFacets(cells.mesh, cells.motion, cells.samples, kMargin * tolerancePx_, stop_).mesh;
        const std::vector<int32_t> owners = ownerImage(mesh);
        const std::vector<float> errors = pieceErrorsPx(rays_, mesh, owners);
        std::vector<uint32_t> failing;
        for (size_t i = 0; i < errors.size(); ++i)
            if (errors[i] > tolerancePx_)  // not so in holes
                failing.push_back(cells.cellOfPiece[static_cast<size_t>(owners[i])]);
        std::ranges::sort(failing);
        failing.erase(std::unique(failing.begin(), failing.end()), failing.end());
        return failing;
    }

    bool isGoodAlone(const CutDisplay& display, uint32_t cell) const {
        return display.facets[cell].errorPx <= 0.5 * tolerancePx_;
    }

    bool shouldAllBeSmaller(const CutDisplay& display, const std::vector<uint32_t>& failing) const {
        const auto tooLarge =
            std::ranges::count_if(failing, [&](uint32_t cell) { return !isGoodAlone(display, cell); });
        return 2 * static_cast<double>(tooLarge) > kFewFailures * static_cast<double>(display.pieceCount);
    }

    // Cuts a cell. One that would meet the tolerance alone, as one of a single pixel does, lets go of its
    // neighbours instead.
    void refine(CutDisplay& display, uint32_t id) {
        const int axis = bestCut(rays_, display.tree.cell(id));
        if (axis < 0 || (isGoodAlone(display, id) && !loose_.contains(id))) {
            if (!loose_.insert(id).second) refuseTolerance(tolerancePx_);
            return;
        }
        display.tree.cut(id, axis);
        display.pieceCount += 2;
        if (display.pieceCount > kMostPieces) refuseTolerance(tolerancePx_);
        for (uint32_t half : {display.tree.cellCount() - 2, display.tree.cellCount() - 1})
            display.facets.push_back(facetsOf(rays_, display.tree.cell(half)));
    }

    const RayImage& rays_;
    double tolerancePx_;
    const std::stop_token& stop_;
    std::unordered_set<uint32_t> loose_;
};

}  // namespace

PieceMesh fitCells(const RayImage& rays, double tolerancePx, const std::stop_token& stop) {
    return CellFit(rays, tolerancePx, stop).fit();
}

}  // namespace curvewall
