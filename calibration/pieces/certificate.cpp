#include "calibration/pieces/certificate.h"

#include "calibration/parallel.h"
#include "calibration/pieces/ownership.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvewall {

std::vector<float> pieceErrorsPx(const RayImage& rays, const PieceMesh& mesh,
                                 const std::vector<int32_t>& owners) {
    std::vector<float> errors(owners.size(), std::numeric_limits<float>::infinity());
    parallelRanges(mesh.sizePx.y, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < mesh.sizePx.x; ++x) {
                const size_t i = rays.indexOf({x, y});
                if (!rays.has({x, y})) {
                    errors[i] = std::numeric_limits<float>::quiet_NaN();
                } else if (owners[i] != kNoPiece) {
                    const Piece& piece = mesh.pieces[static_cast<size_t>(owners[i])];
                    const glm::dvec3 h = piece.screenFromRay * rays.at({x, y});
                    const double px = glm::length(glm::dvec2(h) / h.z - centreOf({x, y}));
                    if (h.z > 0 && std::isfinite(px)) errors[i] = static_cast<float>(px);
                }
            }
        }
    });
    return errors;
}

Certificate certificateOf(const std::vector<float>& errorsPx, const std::vector<int32_t>& owners,
                          glm::ivec2 sizePx) {
    Certificate certificate;
    std::vector<float> measured;
    measured.reserve(errorsPx.size());
    double sum = 0;
    float largest = -1;
    for (size_t i = 0; i < errorsPx.size(); ++i) {
        const float error = errorsPx[i];
        if (std::isnan(error)) {
            ++certificate.holes;
        } else if (owners[i] == kNoPiece) {
            ++certificate.uncoveredPixels;
        } else {
            measured.push_back(error);
            sum += error;
            if (error > largest) {
                largest = error;
                certificate.maxAt = {static_cast<int>(i % static_cast<size_t>(sizePx.x)),
                                     static_cast<int>(i / static_cast<size_t>(sizePx.x))};
            }
        }
    }
    if (measured.empty()) return certificate;
    const auto p99 =
        measured.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(measured.size() - 1));
    std::nth_element(measured.begin(), p99, measured.end());
    certificate.maxPx = largest;
    certificate.p99Px = *p99;
    certificate.meanPx = sum / static_cast<double>(measured.size());
    return certificate;
}

}  // namespace curvewall
