#include "renderer/image_based.h"

namespace curvewall {

GpuSource uploadSource(const ImageSource& source, const PixelRays& rays, double distanceM) {
    GpuSource gpu;
    gpu.faceSizePx = source.faceSizePx;
    gpu.sizePx = source.faces.empty() ? glm::ivec2(1) : source.faces.front().sizePx;
    for (const SourceFace& face : source.faces) gpu.faces.push_back(uploadPieces(faceMesh(face, distanceM)));
    gpu.places = uploadPlaces(sourcePlaces(source, rays), rays.sizePx());
    return gpu;
}

ImageBasedRenderer::ImageBasedRenderer(const std::shared_ptr<const ScenePrograms>& programs,
                                       const GpuScene& scene, const GpuSource& source)
    : scene_(scene), source_(source) {
    for (const GpuPieces& face : source.faces)
        faces_.emplace_back(programs, scene, face, nullptr, PieceOwners{});
}

void ImageBasedRenderer::record(const SceneView& view, const FacePictures& pictures,
                                const Resampler& resampler, const FrameTarget& target, glm::vec3 background) {
    for (size_t i = 0; i < faces_.size(); ++i)
        pictures.draw(i, background, [&](const FramePass& pass) { faces_[i].record(view, pass); });
    resampler.record(pictures.texture(), source_.places, target, background);
}

uint64_t ImageBasedRenderer::pairCount() const { return scene_.scene->triangles.size() * faces_.size(); }

}  // namespace curvewall
