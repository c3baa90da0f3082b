#include "calibration/pieces/cell_mesh.h"

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

namespace curvewall {
namespace {

constexpr int kLattice = 6;  // samples of the fit in each direction of a cell
constexpr uint32_t kNone = UINT32_MAX;

// The four pixels that meet at a corner of the pixel grid, around it.
constexpr std::array<glm::ivec2, 4> kAround{{{-1, -1}, {0, -1}, {0, 0}, {-1, 0}}};

// Cells whose facets share one vertex at a corner of the pixel grid.
struct SharedCorner {
    std::vector<uint32_t> cells;  // with their corner here
    uint32_t longCell = kNone;    // that has the place within an edge
    uint32_t vertex = kNone;
};

class MeshMaker {
public:
    MeshMaker(const CellTree& tree, const std::vector<CellFacets>& facets, const RayImage& rays,
              const std::unordered_set<uint32_t>& loose, double mostDisagreementPx,
              const std::vector<uint32_t>& flat)
        : tree_(tree),
          facets_(facets),
          rays_(rays),
          loose_(loose),
          mostDisagreementPx_(mostDisagreementPx),
          flat_(flat) {}

    CellMesh make() {
        result_.mesh.sizePx = tree_.sizePx();
        for (uint32_t cell : tree_.wholeCells())
            if (!facets_[cell].isEmpty) addCorners(cell);
        findLongEdges();
        for (uint32_t cell : flat_) giveUpACorner(cell);
        placeAlongRays();
        const std::vector<PieceVertex> placed = result_.mesh.vertices;
        for (const auto& [vertex, blend] : blends_) result_.mesh.vertices[vertex].m = pointOf(vertex, placed);
        for (const auto& [cell, vertices] : verticesOfCell_) addPieces(cell, vertices);
        addMotion();
        updateHomographies(result_.mesh);
        return std::move(result_);
    }

private:
    using Terms = std::map<uint32_t, double>;
    // A vertex that is where others put it.
    using Blend = std::vector<std::pair<uint32_t, double>>;

    bool hasPieces(uint32_t cell) const { return cell != kNone && !facets_[cell].isEmpty; }

    uint32_t cellAtOrNone(glm::ivec2 px) const {
        const glm::ivec2 size = tree_.sizePx();
        if (px.x < 0 || px.y < 0 || px.x >= size.x || px.y >= size.y) return kNone;
        return tree_.cellAt(px);
    }

    // Whether the display goes on from one cell into the other: the two planes turn the same side to the eye
    // and agree where the cells meet.
    bool continues(uint32_t a, uint32_t b) {
        if (loose_.contains(a) || loose_.contains(b)) return false;
        const auto [entry, isNew] = continues_.try_emplace(std::minmax(a, b), false);
        if (isNew) {
            const Cell &first = tree_.cell(a), &second = tree_.cell(b);
            const glm::ivec2 from = glm::max(first.fromPx, second.fromPx);
            const glm::ivec2 to = glm::min(first.toPx, second.toPx);
            entry->second = isFront(facets_[a].corners) == isFront(facets_[b].corners);
            for (glm::ivec2 px : {from, to})
                entry->second = entry->second && disagreementPx(a, b, px) <= mostDisagreementPx_ &&
                                disagreementPx(b, a, px) <= mostDisagreementPx_;
        }
        return entry->second;
    }

    static bool isFront(const std::array<glm::dvec3, 4>& m) {
        return glm::determinant(glm::dmat3(m[0], m[1], m[2])) > 0;
    }

    // Where the plane of `shown` puts the ray that the plane of `seen` has at a place, from that place.
    double disagreementPx(uint32_t shown, uint32_t seen, glm::dvec2 px) const {
        const Cell& cell = tree_.cell(seen);
        const auto& m = facets_[seen].corners;
        const glm::dvec2 at = (px - glm::dvec2(cell.fromPx)) / glm::dvec2(cell.sizePx());
        const glm::dvec3 ray = m[0] + at.x * (m[1] - m[0]) + at.y * (m[3] - m[0]);
        const auto corners = cornersOf(tree_.cell(shown));
        const auto vertex = [&](size_t i) {
            return PieceVertex{facets_[shown].corners[i], glm::dvec2(corners[i])};
        };
        const glm::dvec3 h = homographyThrough(vertex(0), vertex(1), vertex(2)) * ray;
        // What cannot be compared does not agree.
        return h.z > 0 ? glm::distance(glm::dvec2(h) / h.z, px) : std::numeric_limits<double>::infinity();
    }

    // The vertices at a corner of the pixel grid: one for each group of cells that the display joins there.
    const std::vector<SharedCorner>& cornersAt(glm::ivec2 corner) {
        const uint64_t key = static_cast<uint64_t>(corner.y) << 32 | static_cast<uint32_t>(corner.x);
        const auto [entry, isNew] = corners_.try_emplace(key);
        if (isNew) entry->second = sharedCornersAt(corner);
        return entry->second;
    }

    std::vector<SharedCorner> sharedCornersAt(glm::ivec2 corner) {
        std::array<uint32_t, 4> cells{};
        std::array<size_t, 4> group{0, 1, 2, 3};
        for (size_t i = 0; i < 4; ++i) {
            cells[i] = cellAtOrNone(corner + kAround[i]);
            if (!hasPieces(cells[i])) cells[i] = kNone;
        }
        for (size_t i = 0; i < 4; ++i) {
            const size_t next = (i + 1) % 4;
            if (cells[i] == kNone || cells[next] == kNone) continue;
            if (cells[i] == cells[next] || continues(cells[i], cells[next]))
                std::ranges::replace(group, size_t{group[next]}, size_t{group[i]});
        }
        std::vector<SharedCorner> shared;
        for (size_t g = 0; g < 4; ++g) {
            SharedCorner one;
            for (size_t i = 0; i < 4; ++i) {
                if (group[i] != g || cells[i] == kNone) continue;
                const size_t before = (i + 3) % 4;
                if (cells[i] == cells[before])
                    one.longCell = cells[i];
                else if (cells[i] != cells[(i + 1) % 4])
                    one.cells.push_back(cells[i]);
            }
            if (!one.cells.empty()) shared.push_back(std::move(one));
        }
        for (SharedCorner& one : shared) one.vertex = addVertex(corner, one);
        return shared;
    }

    uint32_t addVertex(glm::ivec2 corner, const SharedCorner& shared) {
        const auto vertex = static_cast<uint32_t>(result_.mesh.vertices.size());
        glm::dvec3 m(0);
        for (uint32_t cell : shared.cells) {
            const auto corners = cornersOf(tree_.cell(cell));
            const auto at = static_cast<size_t>(std::ranges::find(corners, corner) - corners.begin());
            m += static_cast<double>(facets_[cell].pixelCount) * glm::normalize(facets_[cell].corners[at]);
        }
        result_.mesh.vertices.push_back({glm::normalize(m), glm::dvec2(corner)});
        const bool isFree = shared.longCell == kNone && !loose_.contains(shared.cells.front());
        terms_.push_back(isFree ? Terms{{unknownCount_++, 1.0}} : Terms{});
        longCells_.push_back(shared.longCell);
        return vertex;
    }

    uint32_t vertexOf(uint32_t cell, glm::ivec2 corner) {
        for (const SharedCorner& shared : cornersAt(corner))
            if (std::ranges::find(shared.cells, cell) != shared.cells.end()) return shared.vertex;
        return kNone;
    }

    void addCorners(uint32_t id) {
        std::array<uint32_t, 4> vertices{};
        const std::array<glm::ivec2, 4> corners = cornersOf(tree_.cell(id));
        for (size_t i = 0; i < 4; ++i) vertices[i] = vertexOf(id, corners[i]);
        verticesOfCell_.emplace(id, vertices);
    }

    // Each cell alone knows how far its corners should be from the eye in proportion to each other. Least
    // squares on the logarithms makes one distance a vertex of that; a trace of the distance itself decides
    // where nothing else does.
    void placeAlongRays() {
        constexpr double kTrace = 1e-6;
        const auto count = static_cast<Eigen::Index>(result_.mesh.vertices.size());
        std::vector<Eigen::Triplet<double>> entries;
        Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
        const auto equation = [&](int i, int j, double weight, double difference) {
            entries.insert(entries.end(), {{i, i, weight}, {j, j, weight}, {i, j, -weight}, {j, i, -weight}});
            right[i] += weight * difference;
            right[j] -= weight * difference;
        };
        for (const auto& [cell, vertices] : verticesOfCell_) {
            std::array<double, 4> logM{};
            for (size_t i = 0; i < 4; ++i) {
                logM[i] = std::log(glm::length(facets_[cell].corners[i]));
                const auto vertex = static_cast<int>(vertices[i]);
                entries.emplace_back(vertex, vertex, kTrace);
                right[vertex] += kTrace * logM[i];
            }
            for (size_t i = 0; i < 4; ++i) {
                const size_t next = (i + 1) % 4;
                equation(static_cast<int>(vertices[i]), static_cast<int>(vertices[next]),
                         facets_[cell].pixelCount, logM[i] - logM[next]);
            }
        }
        Eigen::SparseMatrix<double> normal(count, count);
        normal.setFromTriplets(entries.begin(), entries.end());
        const Eigen::VectorXd logs = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(normal).solve(right);
        for (Eigen::Index i = 0; i < count; ++i)
            result_.mesh.vertices[static_cast<size_t>(i)].m *= std::exp(logs[i]);
        for (const auto& [cell, vertices] : verticesOfCell_) {
            if (!loose_.contains(cell)) continue;
            for (size_t i = 0; i < 4; ++i) result_.mesh.vertices[vertices[i]].m = facets_[cell].corners[i];
        }
    }

    void addPieces(uint32_t id, const std::array<uint32_t, 4>& vertices) {
        const std::vector<glm::ivec2> pixels = latticePixels(rays_, tree_.cell(id), kLattice);
        if (loose_.contains(id) || oneFacet_.contains(id)) {
            addPiece(id, vertices);
            if (loose_.contains(id)) return;
            for (glm::ivec2 px : pixels) addSample(static_cast<uint32_t>(result_.mesh.pieces.size()) - 1, px);
        } else {
            addTwoPieces(id, vertices, pixels);
        }
    }

    void addPiece(uint32_t id, std::span<const uint32_t> vertices) {
        Piece piece;
        for (uint32_t vertex : vertices) piece.vertices[piece.vertexCount++] = vertex;
        result_.mesh.pieces.push_back(piece);
        result_.cellOfPiece.push_back(id);
    }

    // Split along the diagonal that leaves the smaller error.
    void addTwoPieces(uint32_t id, const std::array<uint32_t, 4>& vertices,
                      const std::vector<glm::ivec2>& pixels) {
        const Cell& cell = tree_.cell(id);
        std::array<glm::dvec3, 4> m{};
        for (size_t i = 0; i < 4; ++i) m[i] = result_.mesh.vertices[vertices[i]].m;
        const bool falling =
            facetErrorPx(rays_, cell, m, true, pixels) <= facetErrorPx(rays_, cell, m, false, pixels);
        const auto first = static_cast<uint32_t>(result_.mesh.pieces.size());
        for (const auto& facet : facetCorners(falling))
            addPiece(id, std::array<uint32_t, 3>{vertices[facet[0]], vertices[facet[1]], vertices[facet[2]]});
        for (size_t k = 0; k < 2; ++k)
            for (glm::ivec2 px : pixels)
                if (facetAt(cell, falling, px) == k) addSample(first + static_cast<uint32_t>(k), px);
    }

    void addSample(uint32_t piece, glm::ivec2 px) {
        const auto corner = [&](size_t i) {
            return glm::dvec3(result_.mesh.vertices[result_.mesh.pieces[piece].vertices[i]].s, 1);
        };
        const glm::dvec3 blend =
            glm::inverse(glm::dmat3(corner(0), corner(1), corner(2))) * glm::dvec3(centreOf(px), 1);
        result_.samples.push_back({piece, {blend.x, blend.y, blend.z, 0}, centreOf(px), rays_.at(px)});
    }

    void findLongEdges() {
        for (uint32_t vertex = 0; vertex < longCells_.size(); ++vertex) {
            if (longCells_[vertex] == kNone) continue;
            const Cell& cell = tree_.cell(longCells_[vertex]);
            const glm::ivec2 at(result_.mesh.vertices[vertex].s);
            const int along = at.x == cell.fromPx.x || at.x == cell.toPx.x ? 1 : 0;
            glm::ivec2 from = at, to = at;
            from[along] = cell.fromPx[along];
            to[along] = cell.toPx[along];
            const double share = double(at[along] - from[along]) / double(to[along] - from[along]);
            blends_[vertex] = {{vertexOf(longCells_[vertex], from), 1 - share},
                               {vertexOf(longCells_[vertex], to), share}};
        }
    }

    // A parallelogram's corner follows from the other three, m = before + after - opposite, and then the
    // whole cell is one facet exactly.
    void giveUpACorner(uint32_t cell) {
        const auto found = verticesOfCell_.find(cell);
        if (found == verticesOfCell_.end()) return;
        const std::array<uint32_t, 4>& around = found->second;
        for (size_t i = 0; i < 4; ++i) {
            const std::array<uint32_t, 3> others{around[(i + 1) % 4], around[(i + 2) % 4],
                                                 around[(i + 3) % 4]};
            if (terms_[around[i]].empty() || blends_.contains(around[i]) || held_.contains(around[i]))
                continue;
            std::vector<uint32_t> roots;
            for (uint32_t other : others) addRoots(other, roots);
            if (std::ranges::any_of(
                    roots, [&](uint32_t root) { return root == around[i] || givenUp_.contains(root); }))
                continue;
            blends_[around[i]] = {{others[0], 1}, {others[1], -1}, {others[2], 1}};
            terms_[around[i]].clear();
            givenUp_.insert(around[i]);
            held_.insert(roots.begin(), roots.end());
            oneFacet_.insert(cell);
            return;
        }
    }

    // The vertices that a vertex's place comes from, those on the way included.
    void addRoots(uint32_t vertex, std::vector<uint32_t>& roots) const {
        roots.push_back(vertex);
        if (const auto blend = blends_.find(vertex); blend != blends_.end())
            for (const auto& [other, weight] : blend->second) addRoots(other, roots);
    }

    // A long edge may end in a vertex that hangs on a longer one.
    glm::dvec3 pointOf(uint32_t vertex, const std::vector<PieceVertex>& placed) const {
        const auto blend = blends_.find(vertex);
        if (blend == blends_.end()) return placed[vertex].m;
        glm::dvec3 m(0);
        for (const auto& [other, weight] : blend->second) m += weight * pointOf(other, placed);
        return m;
    }

    void addMotion() {
        for (uint32_t vertex = 0; vertex < terms_.size(); ++vertex) {
            std::vector<Motion::Term> terms;
            for (const auto& [unknown, weight] : termsOf(vertex)) terms.push_back({unknown, weight});
            result_.motion.addVertex(terms);
        }
    }

    const Terms& termsOf(uint32_t vertex) {
        const auto blend = blends_.find(vertex);
        if (blend != blends_.end() && terms_[vertex].empty()) {
            Terms blended;
            for (const auto& [other, share] : blend->second)
                for (const auto& [unknown, weight] : termsOf(other)) blended[unknown] += share * weight;
            terms_[vertex] = std::move(blended);
        }
        return terms_[vertex];
    }

    const CellTree& tree_;
    const std::vector<CellFacets>& facets_;
    const RayImage& rays_;
    const std::unordered_set<uint32_t>& loose_;
    double mostDisagreementPx_;
    const std::vector<uint32_t>& flat_;
    CellMesh result_;
    uint32_t unknownCount_ = 0;
    std::vector<Terms> terms_;          // of every vertex
    std::vector<uint32_t> longCells_;   // that a vertex hangs on
    std::map<uint32_t, Blend> blends_;  // of vertices that hang or were given up
    std::unordered_set<uint32_t> givenUp_, held_;
    std::unordered_set<uint32_t> oneFacet_;  // cells
    std::map<uint32_t, std::array<uint32_t, 4>> verticesOfCell_;
    std::unordered_map<uint64_t, std::vector<SharedCorner>> corners_;
    std::map<std::pair<uint32_t, uint32_t>, bool> continues_;
};

}  // namespace

CellMesh meshOfCells(const CellTree& tree, const std::vector<CellFacets>& facets, const RayImage& rays,
                     const std::unordered_set<uint32_t>& loose, double mostDisagreementPx,
                     const std::vector<uint32_t>& flat) {
    return MeshMaker(tree, facets, rays, loose, mostDisagreementPx, flat).make();
}

}  // namespace curvewall
