#pragma once
// Tests that need OpenGL: they skip where there is none, and fail there when CURVEWALL_REQUIRE_GL is set, as
// in CI.

#include "renderer/gl/egl_context.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace curvewall::test {

class GlTest : public ::testing::Test {
protected:
    void SetUp() override {
        try {
            const EglContext probe;
        } catch (const GlUnavailable& error) {
            if (std::getenv("CURVEWALL_REQUIRE_GL")) FAIL() << error.what();
            GTEST_SKIP() << error.what();
        }
    }
};

}  // namespace curvewall::test
