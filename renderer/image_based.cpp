#include "renderer/image_based.h"

#include "calibration/errors.h"

namespace curvewall {

GpuSource uploadSource(const ImageSource& source, FacePass pass, double distanceM, GpuLookup lookup) {
    GpuSource gpu;
    gpu.faceSizePx = source.faceSizePx;
    gpu.texelCount = texelCountOf(source);
    gpu.layout = {layerSizeOf(source), {}, source.levels, source.faces.empty() ? FacePass::separate : pass};
    gpu.lookup = std::move(lookup);
    std::vector<PieceMesh> meshes;
    for (const SourceFace& face : source.faces) {
        gpu.layout.sizesPx.push_back(face.sizePx);
        meshes.push_back(faceMesh(face, distanceM));
    }
    if (gpu.layout.pass == FacePass::layered) {
        gpu.layers = uploadLayers(meshes);
        return gpu;
    }
    for (const PieceMesh& mesh : meshes) {
        gpu.faces.push_back(uploadPieces(mesh));
        gpu.facesForStrokes.push_back(uploadStrokePieces(mesh));
    }
    return gpu;
}

size_t memoryBytesOf(const GpuSource& source) {
    size_t bytes = sizeOf(source.lookup.places) + sizeOf(source.lookup.gradients) +
                   sizeOf(source.lookup.cells) + memoryBytesOf(source.layers);
    for (const GpuPieces& face : source.faces) bytes += memoryBytesOf(face);
    for (const StrokePieces& face : source.facesForStrokes) bytes += memoryBytesOf(face);
    return bytes;
}

GeometryPath pathThrough(const GpuSource& source) {
    if (source.layout.pass == FacePass::separate) return {};
    return {.source = CornerSource::layered, .layers = source.layers.pieceCount};
}

ImageBasedRenderer::ImageBasedRenderer(const std::shared_ptr<const ScenePrograms>& programs,
                                       const GpuScene& scene, const GpuSource& source)
    : programs_(programs), source_(source) {
    if (source.layout.pass == FacePass::layered) {
        if (scene.strokes)
            throw UsageError(
                "layered faces hold surfaces only, and this scene has points or lines; separate "
                "faces hold them");
        faces_.emplace_back(programs, scene, source.layers, nullptr, PieceOwners{});
        return;
    }
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
    if (source_.layout.pass == FacePass::layered)
        pictures.drawAll(background, [&](const FramePass& pass) { faces_.front().record(view, pass); });
    else
        for (size_t i = 0; i < faces_.size(); ++i)
            pictures.draw(i, background, [&](const FramePass& pass) { faces_[i].record(view, pass); });
    if (source_.layout.levels > 0) {
        timer_.begin("levels");
        pictures.makeLevels();
    }
    timer_.begin("resample");
    resampler.record(pictures.texture(), source_.lookup, target, background);
    timer_.end();
}

FrameOutcome ImageBasedRenderer::finishFrame() {
    FrameOutcome outcome;
    for (PiecewiseRenderer& face : faces_) outcome += face.finishFrame();
    return outcome;
}

}  // namespace curvewall
