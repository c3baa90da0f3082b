#include "renderer/prepared_images.h"

#include "renderer/cube_source.h"
#include "renderer/planar_source.h"

#include <glm/geometric.hpp>

namespace curvewall {
namespace {

ImageSource sourceFor(const PixelRays& rays, const SourceSettings& settings) {
    switch (settings.kind) {
        case SourceKind::cube:
            return cubeSource(rays, settings.faceSizePx);
        case SourceKind::hemicube:
            return hemicubeSource(rays, settings.faceSizePx);
        case SourceKind::planar:
            break;
    }
    return planarSource(rays, settings.faceSizePx);
}

PreparedSource prepare(const Display& display, const SourceSettings& settings) {
    PixelRays rays(*display.projection, display.sizePx);
    rays.keep({});
    ImageSource source = sourceFor(rays, settings);
    if (settings.hasLevels) source = withLevels(std::move(source), rays);
    const auto middle = display.projection->unproject(glm::dvec2(display.sizePx) / 2.0);
    const double distanceM = middle ? glm::length(*middle) : 1.0;
    const auto upload = [&](GpuLookup lookup) {
        return uploadSource(source, settings.pass, distanceM, std::move(lookup));
    };
    if (settings.lookup == SourceLookup::mesh) {
        const auto mesh = lookupMesh(source, rays, *display.projection, settings.meshStepPx);
        const auto places = meshPlaces(mesh, display.sizePx);
        return {upload(uploadLookup(mesh)), sourceError(source, places, display),
                lookupError(source, places, display)};
    }
    const auto places = sourcePlaces(source, rays);
    const auto gradients = settings.hasLevels ? sourceGradients(source, rays) : std::vector<glm::vec4>();
    return {
        upload(uploadLookup(places, gradients, display.sizePx)), sourceError(source, places, display), {}};
}

}  // namespace

std::shared_ptr<const PreparedSource> PreparedImages::source(const WallPtr& wall, const Display& display,
                                                             const SourceSettings& settings) {
    return sources_.get({wall, &display, settings},
                        [&] { return std::make_shared<const PreparedSource>(prepare(display, settings)); });
}

std::shared_ptr<const FacePictures> PreparedImages::pictures(const GpuSource& source, TargetFormat format,
                                                             int samples) {
    constexpr size_t kMostSmallTexels = 16 << 20;
    const PicturesLayout& layout = source.layout;
    const size_t texels = layout.sizesPx.size() * static_cast<size_t>(layout.layerSizePx.x) *
                          static_cast<size_t>(layout.layerSizePx.y);
    auto& kept = texels * static_cast<size_t>(samples) > kMostSmallTexels ? largePictures_ : smallPictures_;
    return kept.get({layout, format, samples},
                    [&] { return std::make_shared<const FacePictures>(layout, format, samples); });
}

std::shared_ptr<const Resampler> PreparedImages::resampler(SourceFilter filter, SourceLookup lookup) {
    return resamplers_.get({filter, lookup},
                           [&] { return std::make_shared<const Resampler>(filter, lookup); });
}

}  // namespace curvewall
