#include "renderer/prepared_images.h"

#include "renderer/planar_source.h"

#include <glm/geometric.hpp>

namespace curvewall {
namespace {

PreparedSource prepare(const Display& display, SourceKind kind, int faceSizePx) {
    PixelRays rays(*display.projection, display.sizePx);
    rays.keep({});
    const ImageSource source =
        kind == SourceKind::cube ? cubeSource(rays, faceSizePx) : planarSource(rays, faceSizePx);
    const auto middle = display.projection->unproject(glm::dvec2(display.sizePx) / 2.0);
    return {uploadSource(source, rays, middle ? glm::length(*middle) : 1.0),
            sourceError(source, display, rays)};
}

}  // namespace

std::shared_ptr<const PreparedSource> PreparedImages::source(const WallPtr& wall, const Display& display,
                                                             SourceKind kind, int faceSizePx) {
    return sources_.get({wall, &display, kind, faceSizePx}, [&] {
        return std::make_shared<const PreparedSource>(prepare(display, kind, faceSizePx));
    });
}

std::shared_ptr<const FacePictures> PreparedImages::pictures(const GpuSource& source, TargetFormat format,
                                                             int samples) {
    const size_t count = source.faces.size();
    constexpr size_t kMostSmallTexels = 16 << 20;
    const size_t texels = count * static_cast<size_t>(source.sizePx.x) * static_cast<size_t>(source.sizePx.y);
    auto& kept = texels * static_cast<size_t>(samples) > kMostSmallTexels ? largePictures_ : smallPictures_;
    return kept.get({source.sizePx, count, format, samples}, [&] {
        return std::make_shared<const FacePictures>(source.sizePx, count, format, samples);
    });
}

std::shared_ptr<const Resampler> PreparedImages::resampler(SourceFilter filter) {
    return resamplers_.get(filter, [&] { return std::make_shared<const Resampler>(filter); });
}

}  // namespace curvewall
