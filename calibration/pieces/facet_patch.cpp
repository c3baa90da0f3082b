#include "calibration/pieces/facet_patch.h"

#include <algorithm>
#include <utility>

namespace curvewall {
namespace {

constexpr uint32_t kNone = UINT32_MAX;

template <class Visit>
void forTerms(const Motion& motion, const Piece& piece, const Visit& visit) {
    for (uint32_t i = 0; i < piece.vertexCount; ++i)
        for (const Motion::Term& term : motion.termsOf(piece.vertices[i])) visit(term);
}

// The pieces that move where any of these unknowns does.
std::vector<uint32_t> piecesMovedBy(const PieceMesh& mesh, const Motion& motion,
                                    const std::vector<bool>& unknowns) {
    std::vector<uint32_t> pieces;
    for (uint32_t k = 0; k < mesh.pieces.size(); ++k) {
        bool moves = false;
        forTerms(motion, mesh.pieces[k],
                 [&](const Motion::Term& term) { moves = moves || unknowns[term.unknown]; });
        if (moves) pieces.push_back(k);
    }
    return pieces;
}

}  // namespace

FacetPatch::FacetPatch(const PieceMesh& whole, const Motion& motion, std::vector<uint32_t> centre, int rings)
    : pieces_(std::move(centre)) {
    std::vector<bool> isFree(motion.unknownCount());
    for (int ring = 0; ring <= rings; ++ring) {
        for (uint32_t k : pieces_)
            forTerms(motion, whole.pieces[k], [&](const Motion::Term& term) { isFree[term.unknown] = true; });
        pieces_ = piecesMovedBy(whole, motion, isFree);
    }
    std::vector<uint32_t> ownVertex(whole.vertices.size(), kNone), ownUnknown(isFree.size(), kNone);
    uint32_t unknownCount = 0;
    mesh_.sizePx = whole.sizePx;
    for (uint32_t k : pieces_) {
        Piece piece = whole.pieces[k];
        for (uint32_t i = 0; i < piece.vertexCount; ++i) {
            const uint32_t vertex = piece.vertices[i];
            if (ownVertex[vertex] == kNone) {
                ownVertex[vertex] = static_cast<uint32_t>(vertices_.size());
                vertices_.push_back(vertex);
                mesh_.vertices.push_back(whole.vertices[vertex]);
                std::vector<Motion::Term> terms;
                for (const Motion::Term& term : motion.termsOf(vertex)) {
                    if (!isFree[term.unknown]) continue;
                    if (ownUnknown[term.unknown] == kNone) ownUnknown[term.unknown] = unknownCount++;
                    terms.push_back({ownUnknown[term.unknown], term.weight});
                }
                motion_.addVertex(terms);
            }
            piece.vertices[i] = ownVertex[vertex];
        }
        mesh_.pieces.push_back(piece);
    }
}

void FacetPatch::balance(const std::vector<FacetSample>& samples, double goodEnoughPx,
                         const std::stop_token& stop) {
    mesh_ = balanceFacets(std::move(mesh_), motion_, samples, goodEnoughPx, stop).mesh;
}

void FacetPatch::putBack(PieceMesh& whole) const {
    for (size_t v = 0; v < vertices_.size(); ++v) whole.vertices[vertices_[v]] = mesh_.vertices[v];
    for (size_t k = 0; k < pieces_.size(); ++k)
        whole.pieces[pieces_[k]].screenFromRay = mesh_.pieces[k].screenFromRay;
}

}  // namespace curvewall
