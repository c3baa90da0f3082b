#include "calibration/pieces/certificate.h"

#include "calibration/parallel.h"
#include "calibration/pieces/fit_stop.h"
#include "calibration/pieces/ownership.h"
#include "calibration/pieces/pixel_rays.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace curvewall {
namespace {

// Pixels of the lattice along each axis.
glm::ivec2 latticeSize(glm::ivec2 sizePx, int every) { return (sizePx + (every - 1)) / every; }

float landingErrorPx(const glm::dmat3& screenFromRay, const glm::dvec3& ray, glm::ivec2 px) {
    const glm::dvec3 h = screenFromRay * ray;
    const double errorPx = glm::length(glm::dvec2(h) / h.z - centreOf(px));
    return h.z > 0 && std::isfinite(errorPx) ? static_cast<float>(errorPx)
                                             : std::numeric_limits<float>::infinity();
}

// Element `rank` of those values, none negative, for which `counts` says whether they count, in ascending
// order. Such floats are ordered as the integers with their bits are, and the upper half of those says nearly
// where the element is.
class RankOfFloats {
public:
    void count(float value) { ++counts_[upperHalf(value)]; }

    // Of the values that were counted.
    template <class ForEach>
    float find(size_t rank, const ForEach& forEachValue) const {
        size_t half = 0;
        while (rank >= counts_[half]) rank -= counts_[half++];
        std::vector<float> near;
        near.reserve(counts_[half]);
        forEachValue([&](float value) {
            if (upperHalf(value) == half) near.push_back(value);
        });
        const auto element = near.begin() + static_cast<std::ptrdiff_t>(rank);
        std::nth_element(near.begin(), element, near.end());
        return *element;
    }

private:
    static size_t upperHalf(float value) { return std::bit_cast<uint32_t>(value) >> 16; }

    std::vector<uint32_t> counts_ = std::vector<uint32_t>(1 << 16);
};

}  // namespace

CertifiedPixels certifyPieces(const Projection& projection, const PieceMesh& mesh,
                              const std::stop_token& stop, int every) {
    const PixelRays rays(projection, mesh.sizePx);
    const Ownership ownership(mesh);
    const glm::ivec2 lattice = latticeSize(mesh.sizePx, every);
    const auto width = static_cast<size_t>(lattice.x);
    CertifiedPixels pixels;
    pixels.owners.resize(width * static_cast<size_t>(lattice.y));
    pixels.errorsPx.resize(pixels.owners.size());
    parallelRanges(lattice.y, [&](int begin, int end) {
        ownership.fillRows(
            begin, end, every,
            std::span(pixels.owners)
                .subspan(static_cast<size_t>(begin) * width, static_cast<size_t>(end - begin) * width));
        for (int y = begin; y < end; ++y) {
            throwIfStopped(stop);
            int32_t* const owners = pixels.owners.data() + static_cast<size_t>(y) * width;
            float* const errorsPx = pixels.errorsPx.data() + static_cast<size_t>(y) * width;
            for (int x = 0; x < lattice.x; ++x) {
                const glm::ivec2 px(x * every, y * every);
                const glm::dvec3 ray = rays.at(px);
                if (!PixelRays::isRay(ray)) {
                    owners[x] = kNoPiece;
                    errorsPx[x] = std::numeric_limits<float>::quiet_NaN();
                } else if (owners[x] == kNoPiece) {
                    errorsPx[x] = std::numeric_limits<float>::infinity();
                } else {
                    errorsPx[x] =
                        landingErrorPx(mesh.pieces[static_cast<size_t>(owners[x])].screenFromRay, ray, px);
                }
            }
        }
    });
    pixels.certificate = certificateOf(pixels.errorsPx, pixels.owners, mesh.sizePx, every);
    return pixels;
}

Certificate certificateOf(const std::vector<float>& errorsPx, const std::vector<int32_t>& owners,
                          glm::ivec2 sizePx, int every) {
    Certificate certificate;
    certificate.every = every;
    RankOfFloats ranks;
    size_t measured = 0, largestAt = 0;
    double sum = 0;
    float largest = -1;
    for (size_t i = 0; i < errorsPx.size(); ++i) {
        const float error = errorsPx[i];
        if (std::isnan(error)) {
            ++certificate.holes;
        } else if (owners[i] == kNoPiece) {
            ++certificate.uncoveredPixels;
        } else {
            ++measured;
            sum += error;
            ranks.count(error);
            if (error > largest) {
                largest = error;
                largestAt = i;
            }
        }
    }
    if (measured == 0) return certificate;
    const auto width = static_cast<size_t>(latticeSize(sizePx, every).x);
    certificate.maxAt =
        every * glm::ivec2(static_cast<int>(largestAt % width), static_cast<int>(largestAt / width));
    certificate.maxPx = largest;
    certificate.p99Px =
        ranks.find(static_cast<size_t>(0.99 * static_cast<double>(measured - 1)), [&](const auto& take) {
            for (size_t i = 0; i < errorsPx.size(); ++i)
                if (!std::isnan(errorsPx[i]) && owners[i] != kNoPiece) take(errorsPx[i]);
        });
    certificate.meanPx = sum / static_cast<double>(measured);
    return certificate;
}

}  // namespace curvewall
