#pragma once
// The variants of scene.vert and scene.frag that a look needs, compiled before the first frame.

#include "renderer/bounding_shape.h"
#include "renderer/frame_pass.h"
#include "renderer/gl/program.h"
#include "renderer/look.h"
#include "renderer/round_lens.h"
#include "renderer/scene/scene.h"
#include "renderer/scene_view.h"

#include <compare>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace curvewall {

struct SceneLook {
    Style style = Style::textured;
    OutputKind output = OutputKind::color;
};

// What tells a fragment shader the output.
std::string outputDefine(OutputKind output);

// How the corners reach the shader.
enum class CornerSource {
    plain,              // plain vertices, one piece for all
    loop,               // plain vertices, the piece is a uniform
    pairs,              // pulled by (triangle, piece) pairs
    tessellated,        // triangles by number, replicated on their way
    layered,            // plain vertices, each triangle into several pictures of one piece each
    bounded,            // plain triangles, which rays are cast at within bounding shapes
    warped,             // pulled by (triangle, part) pairs, each vertex moved to where the display shows it
    warpedTessellated,  // the same, with more vertices in between
};

// For CornerSource::bounded.
struct BoundedPath {
    // What fragments do: show the scene, or stand for what a query counts.
    enum class Fragments { shown, covered, hits };

    BoundingShape shape = BoundingShape::triangle;
    RadialModel lens = RadialModel::equidistant;
    bool isWide = false;     // more than half a turn
    bool perSample = false;  // each sample of a pass has a ray
    Fragments fragments = Fragments::shown;

    bool operator==(const BoundedPath&) const = default;
};

struct GeometryPath {
    CornerSource source = CornerSource::plain;
    int clipPlanes = 0;
    bool singleCover = false;  // each pixel is its owner's alone; blended materials have that anyway
    int ownerSamples = 1;      // owners that a pixel has in one pass
    bool closesHoles = false;  // pixels without an owner are closed before anything is drawn
    int layers = 0;            // pictures that are drawn at once, where they are layered
    BoundedPath bounded{};
    std::vector<std::string> screenMap{};  // of warped corners: see renderer/screen_map.h

    bool operator==(const GeometryPath&) const = default;
};

// Only what the look reads is fetched: a flat material has no texture coordinates, depth has no normals.
class ScenePrograms {
public:
    ScenePrograms(const Scene& scene, SceneLook look, GeometryPath path);

    SceneLook look() const { return look_; }
    const GlProgram& forHoles() const { return forHoles_; }  // where they are closed

    // What the programs fetch: position, and of normal, uv, texture and edges those that some material needs.
    std::vector<std::string> attributes() const;

    // Makes the material's program current with its constants set. Textures are the caller's.
    struct Chosen {
        GLuint program = 0;
        bool textured = false;
        bool blended = false;
    };
    Chosen choose(const Material& material) const;

    // Sets what is the same for all materials of a pass. A plain draw also needs setFacing().
    void setFrame(const SceneView& view, glm::ivec2 sizePx, const FramePass& pass) const;
    // For a lens; `view` is in its axes.
    void setFrame(const SceneView& view, const RoundLens& lens, const FramePass& pass) const;

    // How triangles seen from the front turn on the screen, for one of its programs or for all.
    void setFacing(GLuint program, bool frontIsClockwise) const;
    void setFacing(bool frontIsClockwise) const;

    // Corners are pulled from the scene's buffers, for a plain draw too: lines need to know whose they are.
    bool drawsEdges() const { return drawsEdges_; }

private:
    struct Variant {
        bool lit = false, textured = false, masked = false, singleSided = false, blended = false;
        // clang-tidy 14 takes the 0 of the comparisons made from it for a pointer.
        auto operator<=>(const Variant&) const = default;  // NOLINT(modernize-use-nullptr)
    };
    struct Entry {
        GlProgram program;
        bool checksFacing = false, owned = false;
    };
    Variant variantFor(const Material& material) const;

    SceneLook look_;
    bool drawsEdges_;
    GlProgram forHoles_;
    std::map<Variant, Entry> programs_;
};

}  // namespace curvewall
