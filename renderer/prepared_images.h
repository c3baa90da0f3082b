#pragma once
// What the image-based method keeps between renders.

#include "renderer/image_based.h"
#include "renderer/recently_used.h"

namespace curvewall {

// All that a source depends on beside its display.
struct SourceSettings {
    SourceKind kind = SourceKind::cube;
    int faceSizePx = 0;  // 0 where the display decides
    bool hasLevels = false;
    FacePass pass = FacePass::separate;
    SourceLookup lookup = SourceLookup::pixel;
    int meshStepPx = 0;  // of SourceLookup::mesh

    bool operator==(const SourceSettings&) const = default;
};

struct PreparedSource {
    GpuSource gpu;
    Certificate error;        // of the nearest texels
    Certificate lookupError;  // of the places where they are looked up; none where these are exact
};

class PreparedImages {
public:
    // `display` is one of that wall. Throws UsageError where the source cannot hold the display.
    std::shared_ptr<const PreparedSource> source(const WallPtr& wall, const Display& display,
                                                 const SourceSettings& settings);
    std::shared_ptr<const FacePictures> pictures(const GpuSource& source, TargetFormat format, int samples);
    std::shared_ptr<const Resampler> resampler(SourceFilter filter, SourceLookup lookup);

private:
    struct SourceKey {
        WallPtr wall;
        const Display* display;
        SourceSettings settings;
        bool operator==(const SourceKey&) const = default;
    };
    struct PicturesKey {
        PicturesLayout layout;
        TargetFormat format;
        int samples;
        bool operator==(const PicturesKey&) const = default;
    };
    struct ResamplerKey {
        SourceFilter filter;
        SourceLookup lookup;
        bool operator==(const ResamplerKey&) const = default;
    };
    RecentlyUsed<SourceKey, const PreparedSource> sources_{8};
    // Six faces of 4096 px are 400 MB, and more with samples.
    RecentlyUsed<PicturesKey, const FacePictures> smallPictures_{8}, largePictures_{1};
    RecentlyUsed<ResamplerKey, const Resampler> resamplers_{10};
};

}  // namespace curvewall
