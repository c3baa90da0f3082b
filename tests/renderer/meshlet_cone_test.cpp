// The shaders leave out the meshlets that C++ leaves out.

#include "renderer/meshlets.h"
#include "tests/support/gpu_formulas.h"

#include <gtest/gtest.h>

namespace curvewall {
namespace {

class MeshletCone : public test::GpuFormulas {
protected:
    MeshletCone() : GpuFormulas({"meshlet_cone"}) {}
};

TEST_F(MeshletCone, ShadersAgreeWithCpp) {
    Meshlet meshlet;
    meshlet.coneAxis = {0.48f, 0.6f, 0.64f};
    meshlet.coneSine = 0.28f;
    meshlet.coneCosine = 0.96f;
    meshlet.coneReachM = 0.5f;
    const Results results =
        run("return vec4(isMeshletBehind(-v.xyz, vec3(0.48, 0.6, 0.64), 0.28, 0.96, 0.5) ? 1.0 : 0.0, 0.0, "
            "0.0, 0.0);",
            [](test::Random& random) { return glm::vec4(glm::vec3(random.inBox(5)), 0); });
    size_t behind = 0, different = 0;
    for (size_t i = 0; i < results.given.size(); ++i) {
        const bool expected = isBehind(meshlet, glm::vec3(results.given[i]));
        behind += expected;
        different += expected != (results.found[i].x > 0.5f);
    }
    EXPECT_GT(behind, results.given.size() / 5);
    EXPECT_LE(different, 2u);  // rounding decides on the border
}

}  // namespace
}  // namespace curvewall
