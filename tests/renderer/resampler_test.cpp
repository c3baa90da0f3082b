#include "renderer/resampler.h"

#include "tests/support/gl_fixture.h"
#include "tests/support/test_projections.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace curvewall {
namespace {

// Smooth all around, and within [0, 1].
double smooth(glm::dvec3 ray) {
    const glm::dvec3 r = glm::normalize(ray);
    return 0.5 + 0.2 * std::sin(3 * r.x + r.z) + 0.2 * std::cos(2 * r.y - 3 * r.z * r.x);
}

// The whole sphere by longitude and latitude, so that every border and corner of a cube is seen.
const glm::ivec2 kSizePx(360, 180);
FunctionRays wholeSphere() {
    return {[](glm::dvec2 px) -> std::optional<glm::dvec3> {
                const double longitude = px.x * test::kPi / 180, latitude = px.y * test::kPi / 180;
                return glm::dvec3(std::sin(latitude) * std::sin(longitude), std::cos(latitude),
                                  -std::sin(latitude) * std::cos(longitude));
            },
            kSizePx};
}

// Pictures that hold a function of the direction at every texel's centre.
GlTexture picturesOf(const ImageSource& source, double (*value)(glm::dvec3)) {
    const glm::ivec2 sizePx = source.faces.front().sizePx;
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &id);
    GlTexture texture(id);
    glTextureStorage3D(id, 1, GL_RGBA32F, sizePx.x, sizePx.y, static_cast<GLsizei>(source.faces.size()));
    for (size_t i = 0; i < source.faces.size(); ++i) {
        std::vector<glm::vec4> texels;
        for (int y = 0; y < sizePx.y; ++y)
            for (int x = 0; x < sizePx.x; ++x)
                texels.emplace_back(static_cast<float>(value(source.faces[i].ray({x + 0.5, y + 0.5}))));
        glTextureSubImage3D(id, 0, 0, 0, static_cast<GLint>(i), sizePx.x, sizePx.y, 1, GL_RGBA, GL_FLOAT,
                            texels.data());
    }
    return texture;
}

Frame resampled(const ImageSource& source, const PixelRays& rays, SourceFilter filter,
                double (*value)(glm::dvec3)) {
    const GlTexture pictures = picturesOf(source, value);
    const GlTexture places = uploadPlaces(sourcePlaces(source, rays), rays.sizePx());
    const FrameTarget target(rays.sizePx(), {OutputKind::color, true}, 1);
    Resampler(filter).record(pictures, places, target, {7, 7, 7});
    return target.read();
}

class ResamplerTest : public test::GlTest {
protected:
    void SetUp() override {
        test::GlTest::SetUp();
        if (!IsSkipped() && !HasFailure()) context_.emplace();
    }

    // Mean and largest difference from the function.
    struct Error {
        double mean = 0, most = 0;
    };
    static Error errorOf(SourceFilter filter, int faceSizePx) {
        const FunctionRays rays = wholeSphere();
        const Frame frame = resampled(cubeSource(rays, faceSizePx), rays, filter, smooth);
        Error error;
        for (int y = 0; y < kSizePx.y; ++y) {
            for (int x = 0; x < kSizePx.x; ++x) {
                const double off = std::abs(*frame.at(x, y) - smooth(rays.at({x, y})));
                error.mean += off / (kSizePx.x * kSizePx.y);
                error.most = std::max(error.most, off);
            }
        }
        return error;
    }

    std::optional<EglContext> context_;
};

// Halving the texels divides the error by 2 to the order of the filter, borders of faces included: were they
// clamped, the largest error would fall by 2 whatever the filter.
TEST_F(ResamplerTest, FiltersHaveTheirOrderOnTheWholeSphere) {
    const auto falls = [&](SourceFilter filter) {
        const Error coarse = errorOf(filter, 32), fine = errorOf(filter, 64);
        return Error{coarse.mean / fine.mean, coarse.most / fine.most};
    };
    EXPECT_NEAR(falls(SourceFilter::nearest).mean, 2, 0.1);
    EXPECT_NEAR(falls(SourceFilter::linear).mean, 4, 0.3);
    EXPECT_GT(falls(SourceFilter::linear).most, 3.5);
    EXPECT_GT(falls(SourceFilter::bicubic).mean, 7);
    EXPECT_GT(falls(SourceFilter::bicubic).most, 6.5);
    EXPECT_LT(errorOf(SourceFilter::bicubic, 64).most, errorOf(SourceFilter::linear, 64).most / 5);
}

TEST_F(ResamplerTest, NearestGivesTexelsExactly) {
    const FunctionRays rays = wholeSphere();
    const ImageSource source = cubeSource(rays, 32);
    const Frame frame = resampled(source, rays, SourceFilter::nearest, smooth);
    for (int y = 0; y < kSizePx.y; ++y) {
        for (int x = 0; x < kSizePx.x; ++x) {
            const glm::dvec3 ray = rays.at({x, y});
            const SourceFace& face = source.faces[faceOf(source, ray)];
            // A ray on the line between two texels may get either.
            const glm::dvec2 place = face.place(ray), offset = glm::abs(place - glm::round(place));
            if (std::min(offset.x, offset.y) < 1e-4) continue;
            const double texel = smooth(face.ray(glm::floor(place) + 0.5));
            ASSERT_EQ(*frame.at(x, y), static_cast<float>(texel)) << x << ' ' << y;
        }
    }
}

// At the centres of texels linear and bicubic show the texels themselves.
TEST_F(ResamplerTest, EveryFilterInterpolates) {
    const Wall wall = test::planarWall({64, 64}, 90);
    const PixelRays rays(*wall.displays[0].projection, {64, 64});
    for (const SourceFilter filter : {SourceFilter::nearest, SourceFilter::linear, SourceFilter::bicubic}) {
        const Frame frame = resampled(cubeSource(rays, 64), rays, filter, smooth);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) ASSERT_NEAR(*frame.at(x, y), smooth(rays.at({x, y})), 1e-5);
    }
}

TEST_F(ResamplerTest, BicubicNeverGoesBelowBlack) {
    const FunctionRays rays = wholeSphere();
    const Frame frame = resampled(cubeSource(rays, 32), rays, SourceFilter::bicubic,
                                  [](glm::dvec3 ray) { return ray.x > 0 ? 1.0 : 0.0; });
    for (const float value : frame.texels) ASSERT_GE(value, 0);
}

TEST_F(ResamplerTest, PixelsWithoutARayShowTheBackground) {
    const FunctionRays rays(
        [](glm::dvec2 px) -> std::optional<glm::dvec3> {
            if (px.x < 4) return std::nullopt;
            return glm::dvec3(px.x - 4, px.y - 4, -9);
        },
        {8, 8});
    for (const SourceFilter filter : {SourceFilter::nearest, SourceFilter::linear, SourceFilter::bicubic}) {
        const Frame frame = resampled(cubeSource(rays, 16), rays, filter, smooth);
        EXPECT_EQ(*frame.at(3, 4), 7);
        EXPECT_LT(*frame.at(4, 4), 1);
    }
}

}  // namespace
}  // namespace curvewall
