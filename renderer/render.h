#pragma once
// One render, whoever asks for it: the command line and the daemon both come through here.

#include "calibration/wall.h"
#include "renderer/bounding_shape.h"
#include "renderer/camera.h"
#include "renderer/engine.h"
#include "renderer/face_pass.h"
#include "renderer/frame.h"
#include "renderer/image_source.h"
#include "renderer/look.h"
#include "renderer/request_limits.h"
#include "renderer/scene/scene.h"
#include "renderer/source_lookup.h"
#include "renderer/stats.h"

#include <memory>
#include <optional>
#include <string>

namespace curvewall {

struct FittedPieces;

enum class Method {
    piecewise,
    imageBased,
    boundedRaycast,
    vertexWarp,
    reference,
    automatic,  // the fastest of those that meet the tolerance, but for the reference
};

struct RenderRequest {
    WallPtr wall;
    std::string display;             // empty: the wall's first
    std::optional<glm::dvec3> eyeM;  // wall coordinates; without one the wall's own
    ScenePtr scene;
    Camera camera;
    Method method = Method::piecewise;
    Engine engine = Engine::compute;           // piecewise
    double tolerancePx = kDefaultTolerancePx;  // piecewise
    // Of this display, seen from this eye, at this tolerance; without them the render fits them.
    std::shared_ptr<const FittedPieces> pieces{};
    SourceKind source = SourceKind::cube;        // image-based, as are the next five
    int faceSizePx = 0;                          // 0: from the display's peak pixel density
    SourceFilter filter = SourceFilter::linear;  // of colour; other outputs take the nearest texel
    FacePass facePass = FacePass::separate;
    SourceLookup lookup = SourceLookup::pixel;
    int meshStepPx = kDefaultMeshStepPx;             // of SourceLookup::mesh
    BoundingShape bounds = BoundingShape::triangle;  // bounded-raycast
    // vertex-warp: how long edges may be on the screen, roughly; 0: triangles stay as they are.
    double tessellationPx = 0;
    int samples = 1;  // reference: rays per pixel; raster methods: MSAA samples
    // Of textures, raster methods: 1 to kMostAnisotropy. Without one what the GL at hand does well: as much
    // as it can on hardware, 1 on a software renderer.
    std::optional<int> anisotropy{};
    Style style = Style::textured;
    OutputKind output = OutputKind::color;
    bool linearOutput = false;   // colour at float precision (EXR) rather than 8-bit sRGB
    bool timesStages = false;    // for RenderStats::stageMs
    bool measuresError = false;  // of methods without a certificate: on the position output of frame 0
    int frames = 1;              // frame k turns the camera by 360 k / frames degrees
};

struct RenderResult {
    Frame frame;  // frame 0
    RenderStats stats;
};

// Owns the GL context and what is worth keeping between renders (scenes on the GPU, piece meshes, programs).
// Use it from one thread. The constructor does not touch OpenGL; the first raster render does, and throws
// GlUnavailable when there is none.
class Renderer {
public:
    // Keeps what belongs to the `mostScenes` scenes used last.
    explicit Renderer(size_t mostScenes = 4);
    ~Renderer();

    // Throws UsageError for what cannot be done.
    RenderResult render(const RenderRequest& request);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace curvewall
