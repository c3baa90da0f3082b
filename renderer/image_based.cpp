#include "renderer/image_based.h"

namespace curvewall {

GpuSource uploadSource(const ImageSource& source, const PixelRays& rays, double distanceM) {
    GpuSource gpu;
    gpu.faceSizePx = source.faceSizePx;
    gpu.sizePx = source.faces.empty() ? glm::ivec2(1) : source.faces.front().sizePx;
    for (const SourceFace& face : source.faces) {
        const PieceMesh mesh = faceMesh(face, distanceM);
        gpu.faces.push_back(uploadPieces(mesh));
        gpu.facesForStrokes.push_back(uploadStrokePieces(mesh));
    }
    gpu.places = uploadPlaces(sourcePlaces(source, rays), rays.sizePx());
    return gpu;
}

ImageBasedRenderer::ImageBasedRenderer(const std::shared_ptr<const ScenePrograms>& programs,
                                       const GpuScene& scene, const GpuSource& source)
    : programs_(programs), source_(source) {
    std::shared_ptr<const StrokePrograms> forStrokes;
    if (scene.strokes)
        forStrokes = std::make_shared<const StrokePrograms>(*scene.scene, programs->look(), false);
    for (size_t i = 0; i < source.faces.size(); ++i) {
        PiecewiseRenderer& face =
            faces_.emplace_back(programs, scene, source.faces[i], nullptr, PieceOwners{});
        if (scene.strokes)
            face.addStrokes(std::make_unique<StrokeRenderer>(forStrokes, scene, *scene.strokes,
                                                             source.facesForStrokes[i], nullptr));
    }
}

void ImageBasedRenderer::record(const SceneView& view, const FacePictures& pictures,
                                const Resampler& resampler, const FrameTarget& target, glm::vec3 background) {
    timer_.begin("faces");
    for (size_t i = 0; i < faces_.size(); ++i)
        pictures.draw(i, background, [&](const FramePass& pass) { faces_[i].record(view, pass); });
    timer_.begin("resample");
    resampler.record(pictures.texture(), source_.places, target, background);
    timer_.end();
}

FrameOutcome ImageBasedRenderer::finishFrame() {
    FrameOutcome outcome;
    for (PiecewiseRenderer& face : faces_) outcome += face.finishFrame();
    return outcome;
}

}  // namespace curvewall
