#pragma once
// What the image-based method keeps between renders.

#include "renderer/image_based.h"
#include "renderer/recently_used.h"

namespace curvewall {

struct PreparedSource {
    GpuSource gpu;
    Certificate error;
};

class PreparedImages {
public:
    // `display` is one of that wall. `faceSizePx` is 0 where the display decides. Throws UsageError where a
    // planar source cannot hold the display.
    std::shared_ptr<const PreparedSource> source(const WallPtr& wall, const Display& display, SourceKind kind,
                                                 int faceSizePx);
    std::shared_ptr<const FacePictures> pictures(const GpuSource& source, TargetFormat format, int samples);
    std::shared_ptr<const Resampler> resampler(SourceFilter filter);

private:
    struct SourceKey {
        WallPtr wall;
        const Display* display;
        SourceKind kind;
        int faceSizePx;
        bool operator==(const SourceKey&) const = default;
    };
    struct PicturesKey {
        glm::ivec2 sizePx;
        size_t count;
        TargetFormat format;
        int samples;
        bool operator==(const PicturesKey&) const = default;
    };
    RecentlyUsed<SourceKey, const PreparedSource> sources_{8};
    // Six faces of 4096 px are 400 MB, and more with samples.
    RecentlyUsed<PicturesKey, const FacePictures> smallPictures_{8}, largePictures_{1};
    RecentlyUsed<SourceFilter, const Resampler> resamplers_{3};
};

}  // namespace curvewall
