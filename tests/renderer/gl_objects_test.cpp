#include "renderer/gl/gl_objects.h"

#include "renderer/gl/program.h"
#include "tests/support/gl_fixture.h"

#include <gtest/gtest.h>

#include <optional>
#include <type_traits>

namespace curvewall {
namespace {

static_assert(std::is_nothrow_move_constructible_v<GlBuffer> && std::is_nothrow_move_assignable_v<GlBuffer>);
static_assert(!std::is_copy_constructible_v<GlBuffer>);

class GlObjects : public test::GlTest {
protected:
    void SetUp() override {
        test::GlTest::SetUp();
        if (!IsSkipped() && !HasFatalFailure()) context_.emplace();
    }
    std::optional<EglContext> context_;
};

TEST_F(GlObjects, MovingHandsTheNameOverAndAssigningKeepsBothAlive) {
    GlBuffer first = makeBuffer("abc", 3), second = makeBuffer("defg", 4);
    const GLuint firstId = first.id(), secondId = second.id();
    const GlBuffer moved(std::move(first));
    EXPECT_EQ(moved.id(), firstId);
    EXPECT_EQ(first.id(), 0u);  // NOLINT(bugprone-use-after-move): what is left is part of the contract
    first = std::move(second);
    EXPECT_EQ(first.id(), secondId);
    EXPECT_TRUE(glIsBuffer(firstId) && glIsBuffer(secondId));
}

TEST_F(GlObjects, TheEndOfAHandleDeletesItsObject) {
    GLuint id = 0;
    {
        const GlBuffer buffer = makeBuffer("abc", 3);
        id = buffer.id();
        EXPECT_TRUE(glIsBuffer(id));
    }
    EXPECT_FALSE(glIsBuffer(id));
}

TEST_F(GlObjects, ShaderErrorsNameTheFileAndTheLine) {
    try {
        makeProgram({{GL_FRAGMENT_SHADER, "holes.frag"}}, {"texelFetch undeclaredFunction"});
        FAIL() << "compiled";
    } catch (const std::runtime_error& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("shaders/holes.frag"), std::string::npos) << message;
        EXPECT_NE(message.find(":6("), std::string::npos) << "the line of the call: " << message;
    }
}

TEST_F(GlObjects, FilesThatAreNotThereAreOurOwnMistake) {
    EXPECT_THROW(shaderText("none.glsl"), std::logic_error);
}

}  // namespace
}  // namespace curvewall
