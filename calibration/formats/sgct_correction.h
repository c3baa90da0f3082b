#pragma once
// The files that a viewport of SGCT names: meshes that bend its picture, masks that dim it.

#include "calibration/formats/calibration_file.h"
#include "calibration/formats/mesh_calibration.h"
#include "calibration/formats/sgct_projection.h"
#include "calibration/formats/texel_budget.h"

#include <functional>
#include <string>
#include <vector>

namespace curvewall {

// The file that the viewport's `key` names: "mesh", "blendmask". Throws InputError where there is none.
using SgctFindNamed = std::function<FileBytes(const std::string& key, const std::string& name)>;

struct SgctContext {
    const SgctWindow& window;
    const SgctViewport& viewport;
    glm::ivec2 sizePx{0};
    double aspect = 1;  // of the viewport on the window, width over height
    SgctEye eye{};
    SgctFindNamed find;
    TexelBudget& budget;  // of the wall
};

// What the viewport shows: its picture, bent by its mesh if it has one.
struct SgctShown {
    MeshDisplay display;
    std::string type;  // as wall files name it
};
SgctShown sgctShown(const SgctContext& context, Decisions& decisions);

// The blend and black level masks, on top of the mesh's intensity.
BlendMaps sgctBlend(const SgctContext& context, bool isXml, const std::vector<float>& intensity,
                    Decisions& decisions);

}  // namespace curvewall
