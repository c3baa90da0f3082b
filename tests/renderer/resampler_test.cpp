#include "renderer/resampler.h"

#include "calibration/projections/lens_projection.h"
#include "calibration/projections/radial_lens.h"
#include "renderer/cube_source.h"
#include "renderer/face_pictures.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/test_projections.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace curvewall {
namespace {

constexpr std::array kFilters{SourceFilter::nearest, SourceFilter::linear, SourceFilter::bicubic,
                              SourceFilter::mipmap, SourceFilter::anisotropic};

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

// The same filling everywhere, and whatever a texel of which level and picture should have.
using TexelAt = std::function<double(size_t face, int level, glm::ivec2 at)>;

GlTexture picturesOf(const ImageSource& source, const TexelAt& texelAt) {
    const glm::ivec2 sizePx = layerSizeOf(source);
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &id);
    GlTexture texture(id);
    glTextureStorage3D(id, 1 + source.levels, GL_RGBA32F, sizePx.x, sizePx.y,
                       static_cast<GLsizei>(source.faces.size()));
    for (size_t i = 0; i < source.faces.size(); ++i) {
        for (int level = 0; level <= source.levels; ++level) {
            const glm::ivec2 levelPx = sizePx >> level;
            std::vector<glm::vec4> texels;
            for (int y = 0; y < levelPx.y; ++y)
                for (int x = 0; x < levelPx.x; ++x)
                    texels.emplace_back(static_cast<float>(texelAt(i, level, {x, y})));
            glTextureSubImage3D(id, level, 0, 0, static_cast<GLint>(i), levelPx.x, levelPx.y, 1, GL_RGBA,
                                GL_FLOAT, texels.data());
        }
    }
    return texture;
}

// A function of the direction at every texel's centre.
TexelAt texelsOf(const ImageSource& source, double (*value)(glm::dvec3)) {
    return [&source, value](size_t face, int, glm::ivec2 at) {
        return value(source.faces[face].ray(glm::dvec2(at) + 0.5));
    };
}

GpuLookup lookupOf(const ImageSource& source, const PixelRays& rays) {
    return uploadLookup(sourcePlaces(source, rays), sourceGradients(source, rays), rays.sizePx());
}

Frame resampled(const GlTexture& pictures, const GpuLookup& lookup, glm::ivec2 sizePx, SourceFilter filter,
                SourceLookup kind = SourceLookup::pixel) {
    const FrameTarget target(sizePx, {OutputKind::color, true}, 1);
    Resampler(filter, kind).record(pictures, lookup, target, {7, 7, 7});
    return target.read();
}

Frame resampled(const ImageSource& source, const PixelRays& rays, SourceFilter filter,
                double (*value)(glm::dvec3)) {
    return resampled(picturesOf(source, texelsOf(source, value)), lookupOf(source, rays), rays.sizePx(),
                     filter);
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
        const ImageSource source = cubeSource(rays, faceSizePx);
        const Frame frame = resampled(source, rays, filter, smooth);
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

// At the centres of texels, at one texel a pixel, every filter shows the texels themselves.
TEST_F(ResamplerTest, EveryFilterInterpolates) {
    const Wall wall = test::planarWall({64, 64}, 90);
    const PixelRays rays(*wall.displays[0].projection, {64, 64});
    for (const SourceFilter filter : kFilters) {
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
    for (const SourceFilter filter : kFilters) {
        const Frame frame = resampled(cubeSource(rays, 16), rays, filter, smooth);
        EXPECT_EQ(*frame.at(3, 4), 7);
        EXPECT_LT(*frame.at(4, 4), 1);
    }
}

// Turned anyhow, so that borders of faces go across it.
Wall domeOf(glm::ivec2 sizePx, double fovRad) {
    const Orientation orientation{0.3, 0.5, 0.7};
    return wallOf(std::make_shared<LensProjection>(circularLens({}, fovRad, sizePx), orientation), sizePx);
}

// Every level has its number for a value, so that the picture tells the level that was read.
double levelItself(size_t, int level, glm::ivec2) { return level; }

// How many texels a pixel covers along the longer and the shorter axis, by derivatives of its own.
struct Footprint {
    double shorter, longestStep;  // the latter to the next pixel or row
};
Footprint footprintOn(const SourceFace& face, const Projection& projection, glm::dvec2 px) {
    const auto placeAt = [&](glm::dvec2 at) { return face.place(*projection.unproject(at)); };
    constexpr double kStepPx = 1e-4;
    const glm::dvec2 a = (placeAt(px + glm::dvec2(kStepPx, 0)) - placeAt(px)) / kStepPx;
    const glm::dvec2 b = (placeAt(px + glm::dvec2(0, kStepPx)) - placeAt(px)) / kStepPx;
    // The longest image of a unit vector, by trying.
    constexpr int kDirections = 180;
    double longer = 0;
    for (int i = 0; i < kDirections; ++i) {
        const double angleRad = i * test::kPi / kDirections;
        longer = std::max(longer, glm::length(std::cos(angleRad) * a + std::sin(angleRad) * b));
    }
    return {std::abs(a.x * b.y - a.y * b.x) / longer, std::max(glm::length(a), glm::length(b))};
}

// The level for what a pixel covers, with pictures and without end.
double levelAt(const SourceFace& face, const Projection& projection, glm::dvec2 px, SourceFilter filter) {
    const Footprint covered = footprintOn(face, projection, px);
    return std::log2(filter == SourceFilter::mipmap ? covered.longestStep : covered.shorter);
}

// Within a cell of a mesh the step is the same everywhere: that of some place in it.
std::array<double, 2> levelsInCell(const SourceFace& face, const Projection& projection, glm::ivec2 px,
                                   SourceFilter filter, int cellPx) {
    const glm::ivec2 fromPx = px / cellPx * cellPx;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (int y = 0; y <= 2; ++y) {
        for (int x = 0; x <= 2; ++x) {
            const glm::dvec2 at = glm::dvec2(fromPx) + glm::dvec2(x, y) * (cellPx / 2.0);
            const double level = levelAt(face, projection, at, filter);
            least = std::min(least, level);
            most = std::max(most, level);
        }
    }
    return {least, most};
}

TEST_F(ResamplerTest, LevelsAreThoseOfWhatAPixelCoversAcrossBordersOfFacesToo) {
    const glm::ivec2 sizePx(120, 120);
    const Wall wall = domeOf(sizePx, 5.5);
    const Projection& projection = *wall.displays[0].projection;
    const PixelRays rays(projection, sizePx);
    const ImageSource source = withLevels(cubeSource(rays, 300), rays);
    ASSERT_GE(source.levels, 3);
    const GlTexture pictures = picturesOf(source, levelItself);
    const GpuLookup pixels = lookupOf(source, rays);
    constexpr int kCellPx = 4;
    const GpuLookup mesh = uploadLookup(lookupMesh(source, rays, projection, kCellPx));
    const auto held = [&](double level) { return std::clamp(level, 0.0, 1.0 * source.levels); };
    for (const SourceFilter filter : {SourceFilter::mipmap, SourceFilter::anisotropic}) {
        const Frame byPixels = resampled(pictures, pixels, sizePx, filter);
        const Frame byMesh = resampled(pictures, mesh, sizePx, filter, SourceLookup::mesh);
        for (int y = 0; y < sizePx.y; ++y) {
            for (int x = 0; x < sizePx.x; ++x) {
                if (glm::distance(centreOf({x, y}), glm::dvec2(60)) > 55) continue;
                const SourceFace& face = source.faces[faceOf(source, rays.at({x, y}))];
                const double level = levelAt(face, projection, centreOf({x, y}), filter);
                ASSERT_NEAR(*byPixels.at(x, y), held(level), 0.06) << x << ' ' << y;
                const auto [least, most] = levelsInCell(face, projection, {x, y}, filter, kCellPx);
                ASSERT_GT(*byMesh.at(x, y), held(least) - 0.06) << x << ' ' << y;
                ASSERT_LT(*byMesh.at(x, y), held(most) + 0.06) << x << ' ' << y;
            }
        }
    }
}

// Beyond the pictures lies what must never be seen.
TEST_F(ResamplerTest, NoFilterReachesBeyondAPicture) {
    const glm::ivec2 sizePx(90, 90);
    for (const double fovRad : {1.2, 2.9, 5.0}) {
        const Wall wall = domeOf(sizePx, fovRad);
        const Projection& projection = *wall.displays[0].projection;
        const PixelRays rays(projection, sizePx);
        for (const int faceSizePx : {40, 200, 600, 1500}) {
            const ImageSource source = withLevels(cubeSource(rays, faceSizePx), rays);
            const auto inOrBeside = [&](size_t face, int level, glm::ivec2 at) {
                const glm::ivec2 endPx = (at + 1) * (1 << level);
                return glm::all(glm::lessThanEqual(endPx, source.faces[face].sizePx)) ? 1.0 : 1e6;
            };
            const GlTexture pictures = picturesOf(source, inOrBeside);
            const GpuLookup pixels = lookupOf(source, rays);
            const GpuLookup mesh = uploadLookup(lookupMesh(source, rays, projection, 8));
            for (const SourceFilter filter : kFilters) {
                for (const SourceLookup kind : {SourceLookup::pixel, SourceLookup::mesh}) {
                    const GpuLookup& lookup = kind == SourceLookup::mesh ? mesh : pixels;
                    const Frame frame = resampled(pictures, lookup, sizePx, filter, kind);
                    for (const float value : frame.texels)
                        ASSERT_TRUE(value == 7 || std::abs(value - 1) < 1e-3) << value;
                }
            }
        }
    }
}

// The same on the other side, which is that of the array's first texel.
TEST_F(ResamplerTest, NoFilterReachesTheFirstTexelsOfAPicture) {
    const glm::ivec2 sizePx(90, 90);
    const Wall wall = domeOf(sizePx, 2.9);
    const Projection& projection = *wall.displays[0].projection;
    const PixelRays rays(projection, sizePx);
    const ImageSource source = withLevels(cubeSource(rays, 600), rays);
    ASSERT_GE(source.levels, 3);
    // Clamping repeats the first texel of each row and column: one texel of the last level must do.
    const auto farFromBorder = [&](size_t, int level, glm::ivec2 at) {
        const int leastPx = source.apronPx - (3 << source.levels) / 2;
        return glm::all(glm::greaterThanEqual((at + 1) * (1 << level), glm::ivec2(leastPx))) ? 1.0 : 1e6;
    };
    const GlTexture pictures = picturesOf(source, farFromBorder);
    const Frame frame = resampled(pictures, lookupOf(source, rays), sizePx, SourceFilter::mipmap);
    for (const float value : frame.texels) ASSERT_TRUE(value == 7 || std::abs(value - 1) < 1e-3) << value;
}

TEST_F(ResamplerTest, AnisotropicAveragesAlongWhatAPixelCovers) {
    // Eight texels across and one down: columns in turns of four dark and four light ones average, rows stay.
    const glm::ivec2 sizePx(32, 256);
    const PlanarScreen screen{{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}};
    const PlanarProjection projection(screen, glm::dvec3(0), sizePx);
    const PixelRays rays(projection, sizePx);
    const ImageSource source = withLevels(cubeSource(rays, 256), rays);
    ASSERT_EQ(source.faces.size(), 1u);
    const auto stripes = [&](size_t, int level, glm::ivec2 at) {
        const glm::ivec2 inside = at * (1 << level) - source.apronPx;
        const bool light = level == 0 ? (inside.x & 4) != 0 : true;
        return (light ? 1.0 : 0.0) + (inside.y % 2 == 0 ? 10 : 0) + (level > 0 ? 100 : 0);
    };
    const Frame frame =
        resampled(picturesOf(source, stripes), lookupOf(source, rays), sizePx, SourceFilter::anisotropic);
    for (int y = 2; y < sizePx.y - 2; ++y)
        for (int x = 1; x < sizePx.x - 1; ++x)
            ASSERT_NEAR(*frame.at(x, y), 0.5 + (y % 2 == 0 ? 10 : 0), 1e-2) << x << ' ' << y;
}

TEST_F(ResamplerTest, LevelsAreAveragesOfLight) {
    const PicturesLayout layout{{8, 8}, {{8, 8}}, 1, FacePass::separate};
    const FacePictures pictures(layout, {}, 1);
    std::vector<glm::u8vec4> texels;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) texels.emplace_back(glm::u8vec3((x + y) % 2 ? 255 : 0), 255);
    const GLuint texture = pictures.texture().id();
    glTextureSubImage3D(texture, 0, 0, 0, 0, 8, 8, 1, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
    pictures.makeLevels();
    std::array<glm::u8vec4, 16> level{};
    glGetTextureImage(texture, 1, GL_RGBA, GL_UNSIGNED_BYTE, sizeof level, level.data());
    for (const glm::u8vec4& texel : level) EXPECT_NEAR(texel.r, 188, 1);  // sRGB of half the light
}

TEST_F(ResamplerTest, AMeshShowsWhatItsPlacesSay) {
    const glm::ivec2 sizePx(150, 150);
    const Wall wall = domeOf(sizePx, 4);
    const Projection& projection = *wall.displays[0].projection;
    const PixelRays rays(projection, sizePx);
    const ImageSource source = cubeSource(rays, 64);
    const auto cells = lookupMesh(source, rays, projection, 16);
    const auto places = meshPlaces(cells, sizePx);
    const GlTexture pictures = picturesOf(source, texelsOf(source, smooth));
    const Frame byPixels =
        resampled(pictures, uploadLookup(places, {}, sizePx), sizePx, SourceFilter::linear);
    const Frame byMesh =
        resampled(pictures, uploadLookup(cells), sizePx, SourceFilter::linear, SourceLookup::mesh);
    for (size_t i = 0; i < byMesh.texels.size(); ++i) ASSERT_NEAR(byMesh.texels[i], byPixels.texels[i], 1e-4);
}

}  // namespace
}  // namespace curvewall
