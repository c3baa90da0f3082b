#pragma once
// A scene's points and lines through the pieces of a display, as wide as renderer/strokes.h says and whole
// where they cross from piece to piece. For one piece, too.

#include "renderer/coverage.h"
#include "renderer/frame_pass.h"
#include "renderer/scene_programs.h"

#include <cstdint>
#include <map>
#include <memory>

namespace curvewall {

bool hasStrokes(const Scene& scene);

// The strokes of a scene as flat triangles, (a, a, a) and (a, b, b): the same planes tell which pieces hold
// them.
struct StrokeScene {
    explicit StrokeScene(const Scene& scene);

    GpuScene gpu;  // without textures
    Coverage coverage;
};

struct StrokePieces {
    GpuPieces
        found;  // what coverage looks through: wider at the edges, by what a stroke reaches over the border
    GlBuffer pieces;  // for stroke.vert
};

StrokePieces uploadStrokePieces(const PieceMesh& mesh);
size_t memoryBytesOf(const StrokePieces& pieces);

// The variants of stroke.vert and stroke.frag that a look needs.
class StrokePrograms {
public:
    // Where there are `holes`, strokes keep out of them.
    StrokePrograms(const Scene& scene, SceneLook look, bool holes);

    struct Chosen {
        GLuint program = 0;
        bool textured = false, masked = false;
    };
    Chosen choose(const Material& material) const;
    SceneLook look() const { return look_; }

private:
    struct Variant {
        bool lit = false, textured = false, masked = false, singleCover = false;
        // clang-tidy 14 takes the 0 of the comparisons made from it for a pointer.
        auto operator<=>(const Variant&) const = default;  // NOLINT(modernize-use-nullptr)
    };
    Variant variantFor(const Material& material) const;
    GlProgram makeVariant(Variant variant, bool holes) const;

    SceneLook look_;
    std::map<Variant, GlProgram> programs_;
};

// Draws into the bound framebuffer, tested against its depth. What it was made from must outlive it. `owners`
// is needed where the display has holes.
//
// Each part of a stroke within a piece is drawn whole: nothing is clipped to the piece but the middle of the
// stroke. Where several pieces hold a place their drawings lie on each other, which shows only where
// fragments are blended or counted. There the middle is cut at the very edge, which neighbours share, and the
// ends that this makes are flat; where a line bends at an edge, a wedge of half its width is left out on one
// side and covered twice on the other, at a tolerance of 0.25 px a few hundredths of a pixel wide.
class StrokeRenderer {
public:
    // `scene` has the textures; the programs are for its look and for whether `owners` has holes.
    StrokeRenderer(std::shared_ptr<const StrokePrograms> programs, const GpuScene& scene,
                   StrokeScene& strokes, const StrokePieces& pieces, const GpuOwners* owners);

    // Those that hide what is behind them, before anything that blends, and the others after all surfaces, in
    // the order of the scene. Record GL work only, and leave blending and depth as setSceneState has them.
    void recordSolid(const SceneView& view, const FramePass& pass = {});
    void recordBlended(const SceneView& view, const FramePass& pass = {});

    // After the GPU has finished.
    FrameOutcome finishFrame() { return strokes_.coverage.finishFrame(); }

private:
    bool isDrawn(const Material& material, bool blended) const;
    void record(const SceneView& view, const FramePass& pass, bool blended);
    void drawRange(const ScenePart& part, size_t range, const SceneView& view, const FramePass& pass);

    const GpuScene& scene_;
    StrokeScene& strokes_;
    const StrokePieces& pieces_;
    const GpuOwners* owners_;
    std::shared_ptr<const StrokePrograms> programs_;
    GlVertexArray emptyVertexArray_;
};

}  // namespace curvewall
