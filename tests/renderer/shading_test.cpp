// The lighting formula is one file for two languages: here both run it.

#include "renderer/shading.h"

#include "tests/support/gl_fixture.h"
#include "tests/support/random_numbers.h"
#include "tests/support/rendering.h"
#include "tests/support/test_scenes.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

namespace curvewall {
namespace {

class Shading : public test::GlTest {};

TEST_F(Shading, ShadersLightASurfaceAsCppDoes) {
    test::Random random(1);
    for (int i = 0; i < 20; ++i) {
        // A large square ahead with a normal of its own.
        Scene scene;
        startMaterial(scene, plainMaterial({0.7, 0.8, 0.9}));
        addFrontalSquare(scene, {0, 0, -1}, 10);
        const glm::vec3 normal = random.direction();
        scene.normals.assign(scene.normals.size(), normal);
        RenderRequest request = test::requestFor(test::planarWall({8, 8}, 60), scene);
        request.linearOutput = true;
        const Frame frame = Renderer().render(request).frame;
        const glm::vec3 expected = glm::vec3(0.7, 0.8, 0.9) * shading::lightOnSurface(normal);
        // Normals travel as 10-bit integers.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(frame.at(4, 4)[c], expected[c], 2.0 / 511);
    }
}

}  // namespace
}  // namespace curvewall
