#pragma once
// The variants of scene.vert and scene.frag that a look needs, compiled before the first frame.

#include "renderer/gl/program.h"
#include "renderer/gpu_pieces.h"
#include "renderer/look.h"
#include "renderer/scene/scene.h"
#include "renderer/scene_view.h"

#include <compare>
#include <map>
#include <string>

namespace curvewall {

struct SceneLook {
    Style style = Style::textured;
    OutputKind output = OutputKind::color;
};

// What tells a fragment shader the output.
std::string outputDefine(OutputKind output);

// Who may draw a pixel.
enum class PixelRight {
    all,       // every piece that reaches it
    notHoles,  // nobody where it has no owner
    owner,     // its owner alone: where each pixel must be covered once
};

// How the corners reach the shader.
struct GeometryPath {
    bool pairs = false;  // (triangle, piece) pairs; otherwise one piece, plain vertices
    int clipPlanes = 0;
    PixelRight right = PixelRight::all;

    bool operator==(const GeometryPath&) const = default;
};

// Only what the look reads is fetched: a flat material has no texture coordinates, depth has no normals.
class ScenePrograms {
public:
    ScenePrograms(const Scene& scene, SceneLook look, GeometryPath path);

    // Makes the material's program current with its constants set. Textures are the caller's.
    struct Chosen {
        GLuint program = 0;
        bool textured = false;
    };
    Chosen choose(const Material& material) const;

    // Sets what is the same for all materials of a frame.
    void setFrame(const SceneView& view, bool frontIsClockwise, glm::vec2 shiftInClipSpace) const;

private:
    struct Variant {
        bool lit = false, textured = false, masked = false, singleSided = false;
        // clang-tidy 14 takes the 0 of the comparisons made from it for a pointer.
        auto operator<=>(const Variant&) const = default;  // NOLINT(modernize-use-nullptr)
    };
    struct Entry {
        GlProgram program;
        bool checksFacing = false;
    };
    Variant variantFor(const Material& material) const;

    SceneLook look_;
    std::map<Variant, Entry> programs_;
};

}  // namespace curvewall
