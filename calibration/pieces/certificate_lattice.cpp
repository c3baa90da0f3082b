#include "calibration/pieces/certificate_lattice.h"

#include "calibration/parallel.h"
#include "calibration/pieces/fit_stop.h"
#include "calibration/pieces/ownership.h"
#include "calibration/pieces/pixel_rays.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace curvewall {

CertificateLattice::CertificateLattice(const Projection& projection, const PieceMesh& mesh,
                                       const std::vector<int32_t>& owners, int every, double hopelessPx,
                                       const std::stop_token& stop)
    : projection_(projection),
      every_(every),
      counts_((mesh.sizePx + every - 1) / every),
      owners_(static_cast<size_t>(counts_.x) * static_cast<size_t>(counts_.y), kNoPiece),
      errorsPx_(owners_.size(), std::numeric_limits<float>::quiet_NaN()) {
    std::atomic<bool> isHopeless = false;
    parallelRanges(counts_.y, [&](int begin, int end) {
        for (int y = begin; y < end && !isHopeless; ++y) {
            throwIfStopped(stop);
            for (int x = 0; x < counts_.x; ++x) {
                const glm::ivec2 px = pixelOf({x, y});
                const size_t i = indexOf({x, y});
                owners_[i] = owners[static_cast<size_t>(px.y) * static_cast<size_t>(mesh.sizePx.x) +
                                    static_cast<size_t>(px.x)];
                errorsPx_[i] = errorAt(mesh, {x, y});
                if (errorsPx_[i] > hopelessPx) isHopeless = true;
            }
        }
    });
    for (size_t i = 0; i < owners_.size() && !outlineHasMoved_; ++i)
        outlineHasMoved_ = std::isnan(errorsPx_[i]) != (owners_[i] == kNoPiece);
}

void CertificateLattice::update(const PieceMesh& mesh, const std::vector<uint32_t>& pieces) {
    for (uint32_t k : pieces) {
        glm::dvec2 least(std::numeric_limits<double>::infinity()), most(-least);
        for (uint32_t i = 0; i < mesh.pieces[k].vertexCount; ++i) {
            const glm::dvec2 s = mesh.vertices[mesh.pieces[k].vertices[i]].s;
            least = glm::min(least, s);
            most = glm::max(most, s);
        }
        const glm::ivec2 from = glm::max(glm::ivec2(glm::floor(least / double(every_))), glm::ivec2(0));
        const glm::ivec2 to = glm::min(glm::ivec2(glm::floor(most / double(every_))), counts_ - 1);
        for (int y = from.y; y <= to.y; ++y)
            for (int x = from.x; x <= to.x; ++x)
                if (const size_t i = indexOf({x, y}); owners_[i] == static_cast<int32_t>(k))
                    errorsPx_[i] = errorAt(mesh, {x, y});
    }
}

std::vector<CertificateLattice::Failure> CertificateLattice::failures(double tolerancePx) const {
    std::vector<Failure> all;
    const auto fails = [tolerancePx](float errorPx) { return errorPx > tolerancePx; };
    if (std::ranges::none_of(errorsPx_, fails)) return all;
    for (int y = 0; y < counts_.y; ++y)
        for (int x = 0; x < counts_.x; ++x)
            if (const size_t i = indexOf({x, y}); owners_[i] != kNoPiece && errorsPx_[i] > tolerancePx)
                all.push_back({static_cast<uint32_t>(owners_[i]), pixelOf({x, y}), errorsPx_[i]});
    std::ranges::stable_sort(all, [](const Failure& a, const Failure& b) {
        return a.piece != b.piece ? a.piece < b.piece : a.errorPx > b.errorPx;
    });
    const auto samePiece = [](const Failure& a, const Failure& b) { return a.piece == b.piece; };
    all.erase(std::unique(all.begin(), all.end(), samePiece), all.end());
    return all;
}

bool CertificateLattice::isEmpty() const {
    return std::ranges::all_of(errorsPx_, [](float errorPx) { return std::isnan(errorPx); });
}

Certificate CertificateLattice::certificate() const {
    Certificate certificate = certificateOf(errorsPx_, owners_, counts_);
    certificate.maxAt = pixelOf(certificate.maxAt);
    certificate.every = every_;
    return certificate;
}

float CertificateLattice::errorAt(const PieceMesh& mesh, glm::ivec2 node) const {
    const glm::dvec2 centre = centreOf(pixelOf(node));
    const auto ray = projection_.unproject(centre);
    if (!ray) return std::numeric_limits<float>::quiet_NaN();
    if (const double square = glm::dot(*ray, *ray); !(square > 0 && std::isfinite(square)))
        return std::numeric_limits<float>::quiet_NaN();
    const int32_t owner = owners_[indexOf(node)];
    if (owner == kNoPiece) return std::numeric_limits<float>::infinity();
    const glm::dvec3 h = mesh.pieces[static_cast<size_t>(owner)].screenFromRay * *ray;
    const double px = glm::length(glm::dvec2(h) * (1 / h.z) - centre);
    return h.z > 0 && std::isfinite(px) ? static_cast<float>(px) : std::numeric_limits<float>::infinity();
}

}  // namespace curvewall
