// Where the shaders of vertex-warp have a ray, in single precision, against the projection itself.

#include "renderer/screen_map.h"

#include "calibration/errors.h"
#include "tests/support/gpu_formulas.h"
#include "tests/support/lens_walls.h"
#include "tests/support/shipped_walls.h"
#include "tests/support/test_projections.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>
#include <string>
#include <vector>

namespace curvewall {
namespace {

struct Shown {
    std::string name;
    Wall wall;
    size_t display = 0;
};

void PrintTo(const Shown& shown, std::ostream* out) { *out << shown.name; }

// Every display of configs/, and round lenses wider than those.
std::vector<Shown> shownDisplays() {
    std::vector<Shown> all;
    for (const std::string& stem : test::shippedWallNames()) {
        const Wall wall = test::shippedWall(stem);
        for (size_t i = 0; i < wall.displays.size(); ++i)
            all.push_back({stem + "_" + wall.displays[i].name, wall, i});
    }
    for (const test::LensKind& kind : test::lensKinds())
        all.push_back({kind.name, test::lensWall(kind, {640, 480}, test::kTurned)});
    for (Shown& shown : all) std::ranges::replace(shown.name, '-', '_');
    return all;
}

std::string withoutIncludes(const std::string& text) {
    return std::regex_replace(text, std::regex("#include[^\n]*"), "");
}

// screenPosition() for the rays of a buffer.
GlProgram positionsProgram(const std::vector<std::string>& defines) {
    std::string text =
        "#version 450 core\n#define SHARED_FN\n#define real float\n#define real2 vec2\n"
        "#define real3 vec3\n#define real4 vec4\n#define real3x3 mat3\n";
    for (const std::string& define : defines) text += "#define " + define + "\n";
    for (const char* name : {"projections/root_ahead", "projections/cylinder", "projections/equirectangular",
                             "projections/pinhole", "projections/radial", "projections/sphere",
                             "projections/sphere_slices", "screen_map", "screen_position"})
        text += withoutIncludes(test::shaderText(name));
    return test::computeProgramOf(text + R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Rays { vec4 rays[]; };
layout(std430, binding = 1) writeonly buffer Found { vec4 found[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < rays.length()) found[i] = vec4(screenPosition(rays[i].xyz), 0.0);
}
)");
}

class ScreenMapOf : public test::GlTest, public testing::WithParamInterface<Shown> {
protected:
    void SetUp() override {
        GlTest::SetUp();
        if (!IsSkipped() && !HasFatalFailure()) context_.emplace();
    }

    const Display& display() const { return GetParam().wall.displays.at(GetParam().display); }

    std::vector<glm::vec4> positionsOf(const ScreenMap& map, const std::vector<glm::vec4>& rays) const {
        const GpuScreenMap gpu = uploadScreenMap(map);
        const GlBuffer numbers = makeBuffer(&gpu.numbers, sizeof gpu.numbers);
        std::vector<glm::vec4> found(rays.size());
        const GlBuffer in = makeBuffer(std::span<const glm::vec4>(rays));
        const GlBuffer out = makeBuffer(std::span<const glm::vec4>(found));
        const GlProgram program = positionsProgram(map.defines);
        glUseProgram(program.id());
        glBindBufferBase(GL_UNIFORM_BUFFER, 0, numbers.id());
        glBindTextureUnit(2, gpu.table.id());
        bindStorage(0, in);
        bindStorage(1, out);
        glDispatchCompute(static_cast<GLuint>(rays.size() / 64 + 1), 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        glGetNamedBufferSubData(out.id(), 0, static_cast<GLsizeiptr>(found.size() * sizeof(glm::vec4)),
                                found.data());
        return found;
    }

    std::optional<EglContext> context_;
};

INSTANTIATE_TEST_SUITE_P(Displays, ScreenMapOf, testing::ValuesIn(shownDisplays()),
                         [](const auto& shown) { return shown.param.name; });

TEST_P(ScreenMapOf, HasEveryRayWhereTheProjectionHasIt) {
    PixelRays rays(*display().projection, display().sizePx);
    rays.keep({});
    const ScreenMap map = screenMapOf(display(), rays);
    test::Random random(1);
    std::vector<glm::dvec2> pixels;
    std::vector<glm::vec4> given;
    while (given.size() < 5000) {
        const glm::dvec2 px = random.pixel(display().sizePx);
        const auto ray = display().projection->unproject(px);
        if (!ray) continue;
        pixels.push_back(px);
        given.emplace_back(random.uniform(0.1, 50) * *ray, 0);
    }
    const std::vector<glm::vec4> found = positionsOf(map, given);
    std::vector<double> offPx;
    for (size_t i = 0; i < given.size(); ++i) {
        ASSERT_GT(found[i].z, 0) << pixels[i].x << ", " << pixels[i].y;
        glm::dvec2 off = glm::dvec2(found[i]) / static_cast<double>(found[i].z) - pixels[i];
        if (map.numbers.size.z > 0) off.x -= map.numbers.size.z * std::round(off.x / map.numbers.size.z);
        if (map.numbers.size.w > 0) off.y -= map.numbers.size.w * std::round(off.y / map.numbers.size.w);
        offPx.push_back(glm::length(off));
    }
    std::ranges::sort(offPx);
    const double p99 = offPx[offPx.size() * 99 / 100], most = offPx.back();
    if (map.table.empty()) {
        // 24 bits of up to 2048 px, and sines of angles that are flat at the rim of an orthographic picture.
        EXPECT_LT(p99, 0.003);
        EXPECT_LT(most, 0.1);
    } else {
        // What is measured has kinks that the nodes of the table do not lie on.
        EXPECT_LT(p99, 0.05);
        EXPECT_LT(most, 1);
    }
}

TEST_P(ScreenMapOf, HoldsTheDisplayInItsCone) {
    PixelRays rays(*display().projection, display().sizePx);
    rays.keep({});
    const glm::vec4 cone = screenMapOf(display(), rays).numbers.seenCone;
    test::Random random(2);
    for (int i = 0; i < 5000; ++i)
        if (const auto ray = display().projection->unproject(random.pixel(display().sizePx))) {
            ASSERT_GT(glm::dot(glm::normalize(*ray), glm::dvec3(cone)), cone.w);
        }
}

Display displayOf(ProjectionPtr projection, glm::ivec2 sizePx) {
    return {"beamer", sizePx, "test", std::move(projection)};
}

std::string refusalOf(const Display& display) {
    const PixelRays rays(*display.projection, display.sizePx);
    try {
        screenMapOf(display, rays);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "none";
}

// Knows of every place that sees a ray ahead.
class SeenTwice : public PinholeProjection {
public:
    using PinholeProjection::PinholeProjection;
    std::vector<glm::dvec2> project(glm::dvec3 ray) const override {
        std::vector<glm::dvec2> places = PinholeProjection::project(ray);
        if (!places.empty()) places.push_back(places.front() + glm::dvec2(10, 0));
        return places;
    }
};

TEST(ScreenMap, RefusesDisplaysThatShowDirectionsAtSeveralPlaces) {
    const std::string why =
        refusalOf(displayOf(std::make_shared<SeenTwice>(glm::ivec2(64, 48), 40), {64, 48}));
    EXPECT_NE(why.find("\"beamer\""), std::string::npos) << why;
    EXPECT_NE(why.find("shows some directions at several"), std::string::npos) << why;
    EXPECT_NE(why.find("piecewise draws it"), std::string::npos) << why;
}

// Its right half goes to the left of its left half.
class Torn : public PinholeProjection {
public:
    explicit Torn(glm::ivec2 sizePx) : PinholeProjection(sizePx, 40), widthPx_(sizePx.x) {}
    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override {
        return PinholeProjection::unproject({swapped(px.x), px.y});
    }
    std::vector<glm::dvec2> project(glm::dvec3 ray) const override {
        std::vector<glm::dvec2> places = PinholeProjection::project(ray);
        for (glm::dvec2& place : places) place.x = swapped(place.x);
        return places;
    }

private:
    // Strips of a sixteenth change places two by two.
    double swapped(double x) const {
        const double strip = widthPx_ / 16;
        return static_cast<int>(std::floor(x / strip)) % 2 == 0 ? x + strip : x - strip;
    }

    double widthPx_;
};

TEST(ScreenMap, RefusesDisplaysThatTearTheirPicture) {
    const std::string why = refusalOf(displayOf(std::make_shared<Torn>(glm::ivec2(64, 48)), {64, 48}));
    EXPECT_NE(why.find("tears its picture"), std::string::npos) << why;
}

TEST(ScreenMap, RefusesDisplaysThatShowNothing) {
    const auto nothing =
        std::make_shared<RayFunctionProjection>([](glm::dvec2) { return std::optional<glm::dvec3>(); });
    EXPECT_NE(refusalOf(displayOf(nothing, {64, 48})).find("shows nothing"), std::string::npos);
}

}  // namespace
}  // namespace curvewall
