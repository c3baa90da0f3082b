#pragma once
// What installations run today: render a cube map or one wide picture, then resample it through the exact
// map, pixel by pixel. In Lorenz and Doellner (2009), section 1.1, this is the image-based approach; SGCT
// renders fisheyes this way.

#include "renderer/face_pictures.h"
#include "renderer/image_source.h"
#include "renderer/piecewise.h"
#include "renderer/resampler.h"

#include <memory>
#include <vector>

namespace curvewall {

// A source for one display, on the GPU.
struct GpuSource {
    int faceSizePx = 0;
    uint64_t texelCount = 0;  // of all pictures
    PicturesLayout layout;
    std::vector<GpuPieces> faces;               // each one piece; none of layered ones
    std::vector<StrokePieces> facesForStrokes;  // none of layered ones
    GpuPieces layers;                           // all of layered ones
    GpuLookup lookup;
};

// The facets are `distanceM` from the eye, which places the near cut. A source without a face is never
// layered.
GpuSource uploadSource(const ImageSource& source, FacePass pass, double distanceM, GpuLookup lookup);

// Of its lookup and its faces, without what these are drawn into.
size_t memoryBytesOf(const GpuSource& source);

// How the corners of a scene get into the pictures of the source.
GeometryPath pathThrough(const GpuSource& source);

class ImageBasedRenderer {
public:
    // The programs must be those of pathThrough() the source. The scene and the source must outlive it.
    // Throws UsageError for points and lines in layered pictures.
    ImageBasedRenderer(const std::shared_ptr<const ScenePrograms>& programs, const GpuScene& scene,
                       const GpuSource& source);

    // Draws the faces, then the display into `target`. Records GL work only.
    void record(const SceneView& view, const FacePictures& pictures, const Resampler& resampler,
                const FrameTarget& target, glm::vec3 background);

    // What the frame just finished took, over all faces. Call it after the GPU has finished; where it
    // overflowed, record the frame once more.
    FrameOutcome finishFrame();

    const ScenePrograms& programs() const { return *programs_; }

    // Of the frames since it was asked last, where stages are timed.
    void timeStages(bool on) { timer_.turn(on); }
    std::vector<StageTime> takeStageTimes() { return timer_.take(); }

private:
    std::shared_ptr<const ScenePrograms> programs_;
    const GpuSource& source_;
    std::vector<PiecewiseRenderer> faces_;  // one for all where they are layered
    StageTimer timer_;
};

}  // namespace curvewall
