#include "calibration/pieces/cell_fit.h"

#include "calibration/errors.h"
#include "calibration/parallel.h"
#include "calibration/pieces/cell_mesh.h"
#include "calibration/pieces/ownership.h"
#include "calibration/pieces/piece_fit.h"
#include "calibration/stopwatch.h"

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
// Pixels in each direction of a cell that are looked at before all of them are.
constexpr int kCheckLattice = 20;
// The fit asks for about as many rays as a display of this size has, and more than once for each of a smaller
// one: then keeping them (100 MB at most) is faster.
constexpr size_t kMostKeptRays = size_t{1} << 22;
// Rounds in which cells that fail may hope that balancing mends them. Measured rarely to take more than four.
constexpr int kHopefulRounds = 6;

// Where flags are set.
template <class Flags>
std::vector<uint32_t> indicesOf(const Flags& flags) {
    std::vector<uint32_t> indices;
    for (uint32_t i = 0; i < flags.size(); ++i)
        if (flags[i]) indices.push_back(i);
    return indices;
}

class CellFit {
public:
    CellFit(const Projection& projection, glm::ivec2 sizePx, double tolerancePx, const std::stop_token& stop)
        : rays_(projection, sizePx), tolerancePx_(tolerancePx), stop_(stop) {
        if (pixelCount() <= kMostKeptRays) rays_.keep(stop);
    }

    FittedCells fit() {
        double errorPx = kGainOfBalance * tolerancePx_;
        CutDisplay display = bestCuts(errorPx);
        if (display.pieceCount == 0) throw UsageError("the display shows nothing: no pixel has a ray");
        FittedCells fitted{{}, std::move(display), {}};
        std::vector<uint32_t> failing = tryFit(fitted);
        while (shouldAllBeSmaller(fitted.cells, failing) && errorPx > tolerancePx_) {
            errorPx *= 0.9;
            fitted.cells = bestCuts(errorPx);
            failing = tryFit(fitted);
        }
        return refined(std::move(fitted), std::move(failing));
    }

    // Goes on from the cells of an earlier fit, with the planes that their pixels have now.
    FittedCells fitOn(CutDisplay display, const std::vector<uint32_t>& failing) {
        forEachCell(display, 0, [&](uint32_t id) {
            if (!display.tree.isWhole(id)) return;
            const Cell& cell = display.tree.cell(id);
            display.facets[id] =
                display.lonePixels.contains(id) ? facetsOfLonePixel(rays_, cell) : facetsOf(rays_, cell);
        });
        display.flat.clear();
        for (uint32_t cell : failing) refine(display, cell, true);
        FittedCells fitted{{}, std::move(display), {}};
        std::vector<uint32_t> stillFailing = tryFit(fitted);
        return refined(std::move(fitted), std::move(stillFailing));
    }

private:
    // Cuts the cells that fail, balances and looks again, until none does.
    FittedCells refined(FittedCells fitted, std::vector<uint32_t> failing) {
        for (int round = 0; !failing.empty(); ++round) {
            const bool isHopeful = round < kHopefulRounds && !areTiny(fitted.cells);
            for (uint32_t cell : failing) refine(fitted.cells, cell, isHopeful);
            failing = tryFit(fitted);
        }
        return flattened(std::move(fitted));
    }

    // Makes one facet of the two of as many cells as the tolerance allows.
    FittedCells flattened(FittedCells fitted) {
        constexpr double kSlack = 0.9;  // what the own plane of such a cell may be off, of the tolerance
        constexpr int kRounds = 16;
        FittedCells flat{{}, fitted.cells, {}};
        const CutDisplay& display = fitted.cells;
        std::vector<std::pair<double, uint32_t>> candidates;
        for (uint32_t cell : display.tree.wholeCells())
            if (!display.facets[cell].isEmpty && !display.facets[cell].isThin &&
                !display.loose.contains(cell))
                if (const double errorPx = ownErrorPx(display, cell); errorPx <= kSlack * tolerancePx_)
                    candidates.emplace_back(errorPx, cell);
        std::ranges::sort(candidates);
        flat.cells.flat.clear();
        for (const auto& [errorPx, cell] : candidates) flat.cells.flat.push_back(cell);
        for (int round = 0; round < kRounds && !flat.cells.flat.empty(); ++round) {
            const std::vector<uint32_t> failing = tryFit(flat, &fitted.pieces.mesh);
            if (failing.empty()) return flat;
            const std::unordered_set<uint32_t> split = cellsToSplit(flat.cells.flat, failing, flat.pieces);
            std::erase_if(flat.cells.flat, [&](uint32_t cell) { return split.contains(cell); });
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

    // Cuts cells until the own best plane of each is off by `errorPx` at most. Ends early, and is of no use,
    // when that takes more than `mostPieces`.
    CutDisplay cutTo(double errorPx, glm::ivec2 firstCounts, size_t mostPieces) const {
        CutDisplay display{CellTree(rays_.sizePx(), firstCounts)};
        display.facets.resize(display.tree.cellCount());
        forEachCell(display, 0,
                    [&](uint32_t id) { display.facets[id] = facetsOf(rays_, display.tree.cell(id)); });
        for (uint32_t begin = 0; begin < display.tree.cellCount() && display.pieceCount <= mostPieces;) {
            std::vector<Cut> cuts(display.tree.cellCount() - begin);
            forEachCell(display, begin, [&](uint32_t id) {
                const CellFacets& facets = display.facets[id];
                if (!facets.isEmpty && !(facets.errorPx <= errorPx))
                    cuts[id - begin] = bestCut(rays_, display.tree.cell(id));
            });
            for (const Cut& cut : cuts) {
                if (cut.axis >= 0)
                    addCut(display, begin, cut);
                else if (!display.facets[begin].isEmpty)
                    display.pieceCount += 2;
                ++begin;
            }
        }
        return display;
    }

    // In parallel, from cell `begin` on.
    template <class Work>
    void forEachCell(const CutDisplay& display, uint32_t begin, const Work& work) const {
        parallelRanges(static_cast<int>(display.tree.cellCount() - begin), [&](int from, int to) {
            for (int i = from; i < to; ++i) {
                throwIfStopped(stop_);
                work(begin + static_cast<uint32_t>(i));
            }
        });
    }

    static void addCut(CutDisplay& display, uint32_t id, const Cut& cut) {
        display.tree.cut(id, cut.axis);
        display.facets.insert(display.facets.end(), cut.halves.begin(), cut.halves.end());
    }

    size_t pixelCount() const {
        return static_cast<size_t>(rays_.sizePx().x) * static_cast<size_t>(rays_.sizePx().y);
    }

    bool areTiny(const CutDisplay& display) const {
        return display.pieceCount / 2 * kFewPixels > pixelCount();
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

    // Balances the facets, from those of `start` where that has the same cells. The answer is the cells that
    // do not meet the tolerance.
    std::vector<uint32_t> tryFit(FittedCells& fitted, const PieceMesh* start = nullptr) {
        CutDisplay& display = fitted.cells;
        // Nothing goes on from one to the next that is worth the time.
        if (areTiny(display))
            std::ranges::copy(display.tree.wholeCells(), std::inserter(display.loose, display.loose.end()));
        CellMesh& pieces = fitted.pieces;
        pieces = meshOfCells(display.tree, display.facets, rays_, display.loose,
                             kMostDisagreement * tolerancePx_, display.flat);
        if (start) startFrom(*start, pieces);
        constexpr double kMargin = 0.98;  // for the pixels between the samples
        pieces.mesh = balanceFacets(std::move(pieces.mesh), pieces.motion, pieces.samples,
                                    kMargin * tolerancePx_, stop_)
                          .mesh;
        // Most that fail do so at the samples, most of the others on a lattice; to cut those first saves
        // pieces. Only the certificate decides.
        std::vector<uint32_t> failing = cellsThatFailAtSamples(display, pieces);
        if (failing.empty()) failing = cellsThatFailOnLattice(display, pieces);
        if (failing.empty()) failing = cellsThatFail(fitted);
        return failing;
    }

    std::vector<uint32_t> cellsThatFailAtSamples(const CutDisplay& display, const CellMesh& pieces) const {
        std::vector<bool> fails(display.tree.cellCount());
        for (const FacetSample& sample : pieces.samples) {
            const uint32_t cell = pieces.cellOfPiece[sample.piece];
            fails[cell] = fails[cell] || !meetsTolerance(display, cell, {glm::ivec2(sample.px), sample.ray},
                                                         pieces.mesh.pieces[sample.piece]);
        }
        return indicesOf(fails);
    }

    std::vector<uint32_t> cellsThatFailOnLattice(const CutDisplay& display, const CellMesh& pieces) const {
        const PieceMesh& mesh = pieces.mesh;
        std::vector<std::atomic<bool>> fails(display.tree.cellCount());
        parallelRanges(static_cast<int>(mesh.pieces.size()), [&](int begin, int end) {
            throwIfStopped(stop_);
            for (auto k = static_cast<size_t>(begin); k < static_cast<size_t>(end); ++k) {
                const uint32_t id = pieces.cellOfPiece[k];
                // One on its own plane was looked at everywhere. The two pieces of a cell follow each other.
                if (display.loose.contains(id) || (k > 0 && pieces.cellOfPiece[k - 1] == id)) continue;
                const Cell& cell = display.tree.cell(id);
                const bool isOne = mesh.pieces[k].vertexCount == 4;
                const bool isFalling = mesh.vertices[mesh.pieces[k].vertices[2]].s == glm::dvec2(cell.toPx);
                const std::vector<SeenPixel> pixels = latticePixels(rays_, cell, kCheckLattice);
                fails[id] = !std::ranges::all_of(pixels, [&](const SeenPixel& pixel) {
                    const size_t facet = isOne ? 0 : facetAt(cell, isFalling, pixel.px);
                    return meetsTolerance(display, id, pixel, mesh.pieces[k + facet]);
                });
            }
        });
        return indicesOf(fails);
    }

    bool meetsTolerance(const CutDisplay& display, uint32_t cell, const SeenPixel& pixel,
                        const Piece& piece) const {
        return facetErrorPx(rays_, pixel, piece.screenFromRay, display.facets[cell].isThin) <= tolerancePx_;
    }

    std::vector<uint32_t> cellsThatFail(FittedCells& fitted) const {
        const CutDisplay& display = fitted.cells;
        constexpr double kFloat = 1 - 1e-7;  // what rounding an error to a float may hide
        fitted.pixels = {};                  // before there are others
        const Stopwatch certifying;
        fitted.pixels = certifyPieces(rays_, fitted.pieces.mesh, stop_);
        fitted.certifyMs = certifying.ms();
        std::vector<std::atomic<bool>> fails(display.tree.cellCount());
        const glm::ivec2 sizePx = rays_.sizePx();
        parallelRanges(sizePx.y, [&](int begin, int end) {
            size_t i = static_cast<size_t>(begin) * static_cast<size_t>(sizePx.x);
            for (int y = begin; y < end; ++y) {
                for (int x = 0; x < sizePx.x; ++x, ++i) {
                    if (fitted.pixels.owners[i] == kNoPiece) continue;
                    const auto piece = static_cast<size_t>(fitted.pixels.owners[i]);
                    const uint32_t cell = fitted.pieces.cellOfPiece[piece];
                    if (!(fitted.pixels.errorsPx[i] <= kFloat * tolerancePx_) ||
                        (display.facets[cell].isThin &&
                         !meetsTolerance(display, cell, {{x, y}, rays_.at({x, y})},
                                         fitted.pieces.mesh.pieces[piece])))
                        fails[cell].store(true, std::memory_order_relaxed);
                }
            }
        });
        return indicesOf(fails);
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
        const Cut best = bestCut(rays_, display.tree.cell(id));
        if (best.axis < 0) refuseTolerance(tolerancePx_);
        addCut(display, id, best);
        display.pieceCount += 2;
        if (display.pieceCount > kMostPieces) refuseTolerance(tolerancePx_);
    }

    PixelRays rays_;
    double tolerancePx_;
    const std::stop_token& stop_;
};

}  // namespace

FittedCells fitCells(const Projection& projection, glm::ivec2 sizePx, double tolerancePx,
                     const std::stop_token& stop) {
    return CellFit(projection, sizePx, tolerancePx, stop).fit();
}

FittedCells refitCells(const Projection& projection, double tolerancePx, CutDisplay cells,
                       const std::vector<uint32_t>& failing, const std::stop_token& stop) {
    const glm::ivec2 sizePx = cells.tree.sizePx();
    return CellFit(projection, sizePx, tolerancePx, stop).fitOn(std::move(cells), failing);
}

}  // namespace curvewall
