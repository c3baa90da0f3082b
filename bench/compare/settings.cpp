#include "bench/compare/settings.h"

#include "renderer/names.h"

#include <sstream>

namespace curvewall {
namespace {

RenderRequest imageBased(const RenderRequest& base, SourceKind source, SourceFilter filter, int faceSizePx) {
    RenderRequest request = base;
    request.method = Method::imageBased;
    request.source = source;
    request.filter = filter;
    request.faceSizePx = faceSizePx;
    return request;
}

}  // namespace

std::vector<RenderRequest> settingsFor(const RenderRequest& base) {
    std::vector<RenderRequest> requests;
    for (const double tolerancePx : {1.0, 0.5, 0.25, 0.1, 0.05}) {
        requests.push_back(base);
        requests.back().tolerancePx = tolerancePx;
    }
    for (const SourceFilter filter : {SourceFilter::nearest, SourceFilter::linear, SourceFilter::bicubic}) {
        for (const int faceSizePx : {512, 1024, 2048, 4096})
            requests.push_back(imageBased(base, SourceKind::cube, filter, faceSizePx));
        // 0: the size that the display needs.
        for (const int faceSizePx : {0, 4096})
            requests.push_back(imageBased(base, SourceKind::planar, filter, faceSizePx));
    }
    return requests;
}

std::string settingAsCsv(const RenderRequest& request) {
    std::ostringstream csv;
    csv << nameOf(request.method) << ',';
    if (request.method == Method::imageBased)
        csv << nameOf(request.source) << ',' << nameOf(request.filter) << ",-,";
    else
        csv << "-,-," << request.tolerancePx << ',';
    csv << request.samples;
    return csv.str();
}

}  // namespace curvewall
