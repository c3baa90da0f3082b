#include "calibration/pieces/cell_fit.h"

#include "calibration/parallel.h"
#include "calibration/pieces/cell_mesh.h"
#include "calibration/pieces/ownership.h"
#include "calibration/pieces/piece_fit.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <span>

namespace curvewall {
namespace {

// A cell's own best plane may be off by about this many times the tolerance: balancing gains so much.
constexpr double kGainOfBalance = 1.4;
// Planes of neighbours on a smooth display are apart by a few times what either is off.
constexpr double kMostDisagreement = 8;
// Where more cells than this fail, all of them should have been smaller.
constexpr double kFewFailures = 0.1;
// Halving makes cells of 1, 1/2, 1/4 ... of the first ones; these first counts put sizes between.
constexpr std::array<int, 3> kOtherFirstCounts{3, 5, 7};
// Cells of fewer pixels than this on average are what noise is cut into.
constexpr size_t kFewPixels = 16;
// Rounds in which cells that fail may hope that balancing mends them. Measured rarely to take more than four.
constexpr int kHopefulRounds = 6;

class CellFit {
public:
    CellFit(const RayImage& rays, double tolerancePx, const std::stop_token& stop)
        : rays_(rays), tolerancePx_(tolerancePx), stop_(stop) {}

    FittedCells fit() {
        double errorPx = kGainOfBalance * tolerancePx_;
        CutDisplay display = bestCuts(errorPx);
        CellMesh pieces;
        std::vector<uint32_t> failing = tryFit(display, pieces);
        while (shouldAllBeSmaller(display, failing) && errorPx > tolerancePx_) {
            errorPx *= 0.9;
            display = bestCuts(errorPx);
            failing = tryFit(display, pieces);
        }
        return refined(std::move(display), std::move(pieces), std::move(failing));
    }

    // Goes on from the cells of an earlier fit, with the planes that their pixels have now.
    FittedCells fitOn(CutDisplay display, const std::vector<uint32_t>& failing) {
        const std::vector<uint32_t> whole = display.tree.wholeCells();
        parallelRanges(static_cast<int>(whole.size()), [&](int begin, int end) {
            for (int i = begin; i < end; ++i) {
                throwIfStopped(stop_);
                const uint32_t id = whole[static_cast<size_t>(i)];
                const Cell& cell = display.tree.cell(id);
                display.facets[id] =
                    display.lonePixels.contains(id) ? facetsOfLonePixel(rays_, cell) : facetsOf(rays_, cell);
            }
        });
        for (uint32_t cell : failing) refine(display, cell, true);
        CellMesh pieces;
        std::vector<uint32_t> stillFailing = tryFit(display, pieces);
        return refined(std::move(display), std::move(pieces), std::move(stillFailing));
    }

private:
    // Cuts the cells that fail, balances and looks again, until none does.
    FittedCells refined(CutDisplay display, CellMesh pieces, std::vector<uint32_t> failing) {
        for (int round = 0; !failing.empty(); ++round) {
            const bool isHopeful = round < kHopefulRounds && !areTiny(display);
            for (uint32_t cell : failing) refine(display, cell, isHopeful);
            failing = tryFit(display, pieces);
        }
        return flattened({std::move(pieces), std::move(display)});
    }

    // Makes one facet of the two of as many cells as the tolerance allows.
    FittedCells flattened(FittedCells fitted) {
        constexpr double kSlack = 0.9;  // what the own plane of such a cell may be off, of the tolerance
        constexpr int kRounds = 14;
        CutDisplay display = fitted.cells;
        display.flat.clear();
        std::vector<std::pair<double, uint32_t>> candidates;
        for (uint32_t cell : display.tree.wholeCells())
            if (!display.facets[cell].isEmpty && !display.facets[cell].isThin &&
                !display.loose.contains(cell))
                if (const double errorPx = ownErrorPx(display, cell); errorPx <= kSlack * tolerancePx_)
                    candidates.emplace_back(errorPx, cell);
        std::ranges::sort(candidates);
        for (const auto& [errorPx, cell] : candidates) display.flat.push_back(cell);
        for (int round = 0; round < kRounds && !display.flat.empty(); ++round) {
            CellMesh pieces;
            const std::vector<uint32_t> failing = tryFit(display, pieces, &fitted.pieces.mesh);
            if (failing.empty()) return {std::move(pieces), std::move(display)};
            const std::unordered_set<uint32_t> given = cellsToSplit(display.flat, failing, pieces);
            std::erase_if(display.flat, [&](uint32_t cell) { return given.contains(cell); });
        }
        return fitted;
    }

    // Cells that were balanced before have their vertices in the same order, where less follows from others.
    static void startFrom(const PieceMesh& balanced, CellMesh& pieces) {
        std::vector<glm::dvec3> unknowns(pieces.motion.unknownCount());
        for (size_t v = 0; v < balanced.vertices.size(); ++v)
            if (const auto terms = pieces.motion.termsOf(v); terms.size() == 1 && terms.front().weight == 1)
                unknowns[terms.front().unknown] = balanced.vertices[v].m;
        for (size_t v = 0; v < balanced.vertices.size(); ++v) {
            const auto terms = pieces.motion.termsOf(v);
            if (terms.empty()) continue;
            pieces.mesh.vertices[v].m = glm::dvec3(0);
            for (const Motion::Term& term : terms)
                pieces.mesh.vertices[v].m += term.weight * unknowns[term.unknown];
        }
        updateHomographies(pieces.mesh);
    }

    // Of the flat cells those that fail themselves, and those beside others that do.
    static std::unordered_set<uint32_t> cellsToSplit(const std::vector<uint32_t>& flat,
                                                     const std::vector<uint32_t>& failing,
                                                     const CellMesh& pieces) {
        const std::unordered_set<uint32_t> areFlat(flat.begin(), flat.end());
        std::unordered_set<uint32_t> split;
        std::vector<uint32_t> others;
        for (uint32_t cell : failing)
            areFlat.contains(cell) ? void(split.insert(cell)) : others.push_back(cell);
        split.merge(cellsAt(pieces, others));
        return split;
    }

    // Cells that share a vertex with one of these.
    static std::unordered_set<uint32_t> cellsAt(const CellMesh& pieces, const std::vector<uint32_t>& cells) {
        const std::unordered_set<uint32_t> chosen(cells.begin(), cells.end());
        const auto verticesOf = [&](size_t k) {
            const Piece& piece = pieces.mesh.pieces[k];
            return std::span(piece.vertices).first(piece.vertexCount);
        };
        std::vector<bool> touched(pieces.mesh.vertices.size());
        for (size_t k = 0; k < pieces.mesh.pieces.size(); ++k)
            if (chosen.contains(pieces.cellOfPiece[k]))
                for (uint32_t vertex : verticesOf(k)) touched[vertex] = true;
        std::unordered_set<uint32_t> near = chosen;
        for (size_t k = 0; k < pieces.mesh.pieces.size(); ++k)
            if (std::ranges::any_of(verticesOf(k), [&](uint32_t vertex) { return touched[vertex]; }))
                near.insert(pieces.cellOfPiece[k]);
        return near;
    }

    // A cell on its own, with the axis to cut it across when it is off by more than `errorPx`; -1 for none.
    struct Decision {
        CellFacets facets;
        int axis = -1;
    };
    Decision decide(const Cell& cell, double errorPx) const {
        throwIfStopped(stop_);
        Decision decision{facetsOf(rays_, cell)};
        if (!decision.facets.isEmpty && !(decision.facets.errorPx <= errorPx))
            decision.axis = bestCut(rays_, cell);
        return decision;
    }

    // Cuts cells until the own best plane of each is off by `errorPx` at most. Ends early, and is of no use,
    // when that takes more than `mostPieces`.
    CutDisplay cutTo(double errorPx, glm::ivec2 firstCounts, size_t mostPieces) const {
        CutDisplay display{CellTree(rays_.sizePx(), firstCounts)};
        for (uint32_t begin = 0; begin < display.tree.cellCount() && display.pieceCount <= mostPieces;) {
            const uint32_t end = display.tree.cellCount();
            std::vector<Decision> decisions(end - begin);
            parallelRanges(static_cast<int>(decisions.size()), [&](int from, int to) {
                for (int i = from; i < to; ++i)
                    decisions[static_cast<size_t>(i)] =
                        decide(display.tree.cell(begin + static_cast<uint32_t>(i)), errorPx);
            });
            for (const Decision& decision : decisions) {
                display.facets.push_back(decision.facets);
                if (decision.axis >= 0)
                    display.tree.cut(begin, decision.axis);
                else if (!decision.facets.isEmpty)
                    display.pieceCount += 2;
                ++begin;
            }
        }
        return display;
    }

    bool areTiny(const CutDisplay& display) const {
        return display.pieceCount / 2 * kFewPixels > rays_.all().size();
    }

    // The first counts that lead to the fewest pieces, for columns and then for rows.
    CutDisplay bestCuts(double errorPx) const {
        glm::ivec2 counts(1);
        CutDisplay best = cutTo(errorPx, counts, kMostPieces);
        if (best.pieceCount > kMostPieces) refuseTolerance(tolerancePx_);
        if (areTiny(best)) return best;
        for (int axis : {0, 1}) {
            for (int count : kOtherFirstCounts) {
                glm::ivec2 first = counts;
                first[axis] = count;
                CutDisplay tried = cutTo(errorPx, first, best.pieceCount - 1);
                if (tried.pieceCount >= best.pieceCount) continue;
                best = std::move(tried);
                counts = first;
            }
        }
        return best;
    }

    // Balances the facets. The answer is the cells that do not meet the tolerance.
    std::vector<uint32_t> tryFit(CutDisplay& display, CellMesh& pieces, const PieceMesh* start = nullptr) {
        // Nothing goes on from one to the next that is worth the time.
        if (areTiny(display))
            std::ranges::copy(display.tree.wholeCells(), std::inserter(display.loose, display.loose.end()));
        pieces = meshOfCells(display.tree, display.facets, rays_, display.loose,
                             kMostDisagreement * tolerancePx_, display.flat);
        if (start) startFrom(*start, pieces);
        constexpr double kMargin = 0.98;  // for the pixels between the samples
        pieces.mesh = balanceFacets(std::move(pieces.mesh), pieces.motion, pieces.samples,
                                    kMargin * tolerancePx_, stop_)
                          .mesh;
        std::vector<uint32_t> failing;
        for (uint32_t piece : piecesThatFail(display, pieces.cellOfPiece, pieces.mesh))
            failing.push_back(pieces.cellOfPiece[piece]);
        failing.erase(std::unique(failing.begin(), failing.end()), failing.end());
        return failing;
    }

    std::vector<uint32_t> piecesThatFail(const CutDisplay& display, const std::vector<uint32_t>& cellOfPiece,
                                         const PieceMesh& mesh) const {
        const std::vector<int32_t> owners = ownerImage(mesh);
        std::vector<std::atomic<bool>> fails(mesh.pieces.size());
        parallelRanges(mesh.sizePx.y, [&](int begin, int end) {
            for (int y = begin; y < end; ++y) {
                for (int x = 0; x < mesh.sizePx.x; ++x) {
                    if (!rays_.has({x, y})) continue;
                    const auto k = static_cast<size_t>(owners[rays_.indexOf({x, y})]);
                    const bool isThin = display.facets[cellOfPiece[k]].isThin;
                    if (!(facetErrorPx(rays_, {x, y}, mesh.pieces[k].screenFromRay, isThin) <= tolerancePx_))
                        fails[k].store(true, std::memory_order_relaxed);
                }
            }
        });
        std::vector<uint32_t> failing;
        for (uint32_t k = 0; k < fails.size(); ++k)
            if (fails[k]) failing.push_back(k);
        return failing;
    }

    bool isGoodAlone(const CutDisplay& display, uint32_t cell) const {
        return display.facets[cell].errorPx <= 0.5 * tolerancePx_;
    }

    bool shouldAllBeSmaller(const CutDisplay& display, const std::vector<uint32_t>& failing) const {
        const auto tooLarge =
            std::ranges::count_if(failing, [&](uint32_t cell) { return !isGoodAlone(display, cell); });
        return !areTiny(display) &&
               2 * static_cast<double>(tooLarge) > kFewFailures * static_cast<double>(display.pieceCount);
    }

    double ownErrorPx(const CutDisplay& display, uint32_t id) const {
        const Cell& cell = display.tree.cell(id);
        const int every = std::max(cell.sizePx().x, cell.sizePx().y);
        return facetErrorPx(rays_, cell, display.facets[id].corners, true, latticePixels(rays_, cell, every));
    }

    // Cuts a cell, and its parts as long as no balance could mend them. One that is good enough alone lets go
    // of its neighbours instead, and stays as it is from then on; so does a single pixel.
    void refine(CutDisplay& display, uint32_t id, bool isHopeful) {
        constexpr double kSafely = 0.98;
        const double goodPx = tolerancePx_ * (isHopeful ? 0.5 : kSafely);
        const double mendablePx = tolerancePx_ * (isHopeful ? kGainOfBalance : kSafely);
        if (display.tree.cell(id).sizePx() == glm::ivec2(1)) {
            if (!display.lonePixels.insert(id).second) refuseTolerance(tolerancePx_);
            display.facets[id] = facetsOfLonePixel(rays_, display.tree.cell(id));
            display.loose.insert(id);
            return;
        }
        if (ownErrorPx(display, id) <= goodPx && display.loose.insert(id).second) return;
        for (std::vector<uint32_t> tooLarge{id}; !tooLarge.empty();) {
            const uint32_t cell = tooLarge.back();
            tooLarge.pop_back();
            cut(display, cell);
            for (uint32_t half : {display.tree.cellCount() - 2, display.tree.cellCount() - 1})
                if (!display.facets[half].isEmpty && display.tree.cell(half).sizePx() != glm::ivec2(1) &&
                    ownErrorPx(display, half) > mendablePx)
                    tooLarge.push_back(half);
        }
    }

    void cut(CutDisplay& display, uint32_t id) const {
        throwIfStopped(stop_);
        const int axis = bestCut(rays_, display.tree.cell(id));
        if (axis < 0) refuseTolerance(tolerancePx_);
        display.tree.cut(id, axis);
        for (uint32_t half : {display.tree.cellCount() - 2, display.tree.cellCount() - 1})
            display.facets.push_back(facetsOf(rays_, display.tree.cell(half)));
        display.pieceCount += 2;
        if (display.pieceCount > kMostPieces) refuseTolerance(tolerancePx_);
    }

    const RayImage& rays_;
    double tolerancePx_;
    const std::stop_token& stop_;
};

}  // namespace

FittedCells fitCells(const RayImage& rays, double tolerancePx, const std::stop_token& stop) {
    return CellFit(rays, tolerancePx, stop).fit();
}

FittedCells refitCells(const RayImage& rays, double tolerancePx, CutDisplay cells,
                       const std::vector<uint32_t>& failing, const std::stop_token& stop) {
    return CellFit(rays, tolerancePx, stop).fitOn(std::move(cells), failing);
}

}  // namespace curvewall
