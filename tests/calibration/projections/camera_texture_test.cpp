#include "calibration/projections/camera_texture.h"

#include "calibration/errors.h"
#include "calibration/projections/pose.h"
#include "calibration/readers/grid_reader.h"
#include "tests/support/map_writer.h"
#include "tests/support/random_numbers.h"
#include "tests/support/temporary_folder.h"

#include <glm/glm.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace curvewall {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr glm::ivec2 kSizePx(800, 600);
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// A warp is the offset in pixels at a position in fractions of the display, y down.
using Warp = std::function<glm::dvec2(glm::dvec2)>;

glm::dvec2 smoothWarp(glm::dvec2 p) {
    const glm::dvec2 c = p - 0.5;
    return -90.0 * c * glm::dot(c, c) + glm::dvec2(12 * std::sin(5 * p.y), 9 * std::cos(4 * p.x + 1));
}

// Turns back on itself between a quarter and half of the way.
glm::dvec2 foldedWarp(glm::dvec2 p) {
    return {150 * std::sin(2.5 * std::numbers::pi * p.x) + 20 * p.y, 30 * std::sin(3 * p.x)};
}

// One camera texture file as a program might write it, and what the file means.
struct Variant {
    std::string semantics = "offset", direction = "forward", alignment = "corners", origin = "top_left",
                units = "px";
    glm::ivec2 nodes{33, 25};
    Warp warp = smoothWarp;
    std::function<bool(glm::ivec2)> isHole = [](glm::ivec2) { return false; };

    glm::dvec2 nodeAt(glm::dvec2 index) const {
        return alignment == "corners" ? index / glm::dvec2(nodes - 1) : (index + 0.5) / glm::dvec2(nodes);
    }

    // Row 0 is the first row of the file.
    NumberMap numbers() const {
        NumberMap map{nodes, 3, false, {}};
        for (int row = 0; row < nodes.y; ++row)
            for (int x = 0; x < nodes.x; ++x) {
                const int y = origin == "top_left" ? row : nodes.y - 1 - row;
                const glm::dvec2 value = valueOfNode({x, y});
                map.values.insert(map.values.end(),
                                  {static_cast<float>(value.x), static_cast<float>(value.y), kNan});
            }
        return map;
    }

    glm::dvec2 valueOfNode(glm::ivec2 node) const {
        if (isHole(node)) return glm::dvec2(kNan);
        const glm::dvec2 p = nodeAt(node);
        glm::dvec2 value = warp(p) + (semantics == "absolute" ? p * glm::dvec2(kSizePx) : glm::dvec2(0));
        if (origin == "bottom_left") value.y = (semantics == "absolute" ? kSizePx.y : 0) - value.y;
        return units == "px" ? value : value / glm::dvec2(kSizePx);
    }

    json keys() const {
        return {{"offsets", "map.pfm"},
                {"semantics", semantics},
                {"direction", direction},
                {"alignment", alignment},
                {"origin", origin},
                {"units", units},
                {"yaw_deg", 20},
                {"pitch_deg", -10},
                {"roll_deg", 5},
                {"base", {{"left_deg", -40}, {"right_deg", 45}, {"down_deg", -35}, {"up_deg", 30}}}};
    }
};

void PrintTo(const Variant& v, std::ostream* out) {
    *out << v.semantics << ' ' << v.direction << ' ' << v.alignment << ' ' << v.origin << ' ' << v.units
         << ' ' << v.nodes.x << 'x' << v.nodes.y;
}

ProjectionPtr readKeys(const json& keys, const test::TemporaryFolder& folder) {
    JsonFields fields(keys, "projection");
    std::vector<std::string> files;
    ProjectionPtr projection = readCameraTexture(fields, {{folder.path(), files}, {}, kSizePx});
    fields.refuseUnknownKeys();
    return projection;
}

ProjectionPtr projectionOf(const Variant& variant) {
    const test::TemporaryFolder folder;
    folder.write("map.pfm", test::pfmBytes(variant.numbers()));
    return readKeys(variant.keys(), folder);
}

double nearest(const std::vector<glm::dvec2>& positions, glm::dvec2 px) {
    double best = std::numeric_limits<double>::infinity();
    for (const glm::dvec2 p : positions) best = std::min(best, glm::distance(p, px));
    return best;
}

// A share of the positions lies right on lines between cells, and beside them.
glm::dvec2 awkwardPixel(test::Random& random, const Variant& v) {
    glm::dvec2 px = random.pixel(kSizePx);
    if (random.uniform(0, 1) < 0.5) return px;
    const glm::dvec2 index(std::floor(random.uniform(0, v.nodes.x)),
                           std::floor(random.uniform(0, v.nodes.y)));
    const glm::dvec2 node = v.nodeAt(index) * glm::dvec2(kSizePx);
    const double beside = random.uniform(0, 1) < 0.5 ? 0 : random.uniform(-1, 1) * 1e-9;
    const double which = random.uniform(0, 1);
    if (which < 0.6) px.x = node.x + beside;
    if (which > 0.4) px.y = node.y + beside;
    return glm::clamp(px, glm::dvec2(0), glm::dvec2(kSizePx));
}

// The share of positions that see something; every one of them must come back.
double roundTrip(const Variant& variant, int count, uint64_t seed) {
    const ProjectionPtr projection = projectionOf(variant);
    test::Random random(seed);
    int seen = 0;
    for (int i = 0; i < count; ++i) {
        const glm::dvec2 px = awkwardPixel(random, variant);
        const auto ray = projection->unproject(px);
        if (!ray) continue;
        ++seen;
        const double off = nearest(projection->project(*ray * random.uniform(0.1, 10)), px);
        if (!(off < 1e-6)) {
            ADD_FAILURE() << ::testing::PrintToString(variant) << ": off by " << off << " at " << px.x << ", "
                          << px.y;
            break;
        }
    }
    return static_cast<double>(seen) / count;
}

std::vector<Variant> everyVariant() {
    std::vector<Variant> variants;
    for (const char* semantics : {"offset", "absolute"})
        for (const char* direction : {"forward", "inverse"})
            for (const char* alignment : {"centers", "corners"})
                for (const char* origin : {"top_left", "bottom_left"})
                    for (const char* units : {"px", "normalized"})
                        variants.push_back({semantics, direction, alignment, origin, units});
    return variants;
}

TEST(CameraTexture, EveryPixelComesBackWhateverTheConventions) {
    uint64_t seed = 1;
    for (Variant variant : everyVariant())
        for (const glm::ivec2 nodes : {glm::ivec2(33, 33), glm::ivec2(257, 129)}) {
            variant.nodes = nodes;
            // Forward, what the warp leaves free at the edge of the display sees nothing.
            EXPECT_GT(roundTrip(variant, 100'000, seed++), variant.direction == "forward" ? 0.8 : 0.999);
        }
}

TEST(CameraTexture, EveryPixelComesBackFromCoarseFoldedAndHollowMaps) {
    uint64_t seed = 100;
    for (const char* direction : {"forward", "inverse"})
        for (const char* alignment : {"centers", "corners"}) {
            for (const glm::ivec2 nodes : {glm::ivec2(2), glm::ivec2(2, 9), glm::ivec2(5, 3)}) {
                Variant variant{.direction = direction, .alignment = alignment, .nodes = nodes};
                EXPECT_GT(roundTrip(variant, 100'000, seed++), 0.4);
            }
            Variant variant{.direction = direction, .alignment = alignment, .nodes = {65, 49}};
            variant.warp = foldedWarp;
            EXPECT_GT(roundTrip(variant, 100'000, seed++), 0.6);
            variant.warp = smoothWarp;
            variant.isHole = [](glm::ivec2 node) { return (node.x / 7 + node.y / 5) % 5 == 1; };
            const double seen = roundTrip(variant, 100'000, seed++);
            EXPECT_GT(seen, 0.4);
            EXPECT_LT(seen, 0.8);
        }
}

TEST(CameraTexture, OneNodeIsAConstantShift) {
    for (const char* direction : {"forward", "inverse"}) {
        Variant shift{.direction = direction, .alignment = "centers", .nodes = {1, 1}};
        shift.warp = [](glm::dvec2) { return glm::dvec2(17.25, -8.5); };
        Variant none = shift;
        none.warp = [](glm::dvec2) { return glm::dvec2(0); };
        const ProjectionPtr shifted = projectionOf(shift), plain = projectionOf(none);
        const double sign = direction == std::string("forward") ? -1 : 1;
        for (const glm::dvec2 px : {glm::dvec2(400, 300), glm::dvec2(30, 590), glm::dvec2(700, 11.5)}) {
            const auto ray = shifted->unproject(px);
            const auto expected = plain->unproject(px + sign * glm::dvec2(17.25, -8.5));
            ASSERT_EQ(ray.has_value(), expected.has_value());
            if (ray) {
                EXPECT_LT(glm::distance(*ray, *expected), 1e-12);
            }
        }
        EXPECT_GT(roundTrip(shift, 100'000, 7), 0.9);
    }
}

// The bilinear interpolant of a file that has its top row first, written by the definition.
glm::dvec2 interpolated(const Variant& v, const NumberMap& numbers, glm::dvec2 px) {
    glm::dvec2 g = px / glm::dvec2(kSizePx);
    g = v.alignment == "corners"
            ? g * glm::dvec2(v.nodes - 1)
            : glm::clamp(g * glm::dvec2(v.nodes) - 0.5, glm::dvec2(0), glm::dvec2(v.nodes - 1));
    const auto node = [&](int x, int y) {
        const float* number = numbers.at(std::min(x, v.nodes.x - 1), std::min(y, v.nodes.y - 1));
        return glm::dvec2(number[0], number[1]);
    };
    const int x = static_cast<int>(g.x), y = static_cast<int>(g.y);
    const double s = g.x - x, t = g.y - y;
    return (1 - t) * ((1 - s) * node(x, y) + s * node(x + 1, y)) +
           t * ((1 - s) * node(x, y + 1) + s * node(x + 1, y + 1));
}

TEST(CameraTexture, InverseMapsShowTheBaseImageWhereTheInterpolantPoints) {
    for (const char* alignment : {"centers", "corners"}) {
        Variant variant{.direction = "inverse", .alignment = alignment, .nodes = {9, 7}};
        const test::TemporaryFolder folder;
        const NumberMap numbers = variant.numbers();
        folder.write("map.pfm", test::pfmBytes(numbers));
        json keys = variant.keys();
        keys.erase("yaw_deg"), keys.erase("pitch_deg"), keys.erase("roll_deg");
        const ProjectionPtr projection = readKeys(keys, folder);
        const double degree = std::numbers::pi / 180;
        const double left = std::tan(-40 * degree), right = std::tan(45 * degree);
        const double down = std::tan(-35 * degree), up = std::tan(30 * degree);
        test::Random random(8);
        for (int i = 0; i < 20'000; ++i) {
            const glm::dvec2 px = random.pixel(kSizePx);
            const glm::dvec2 base = (px + interpolated(variant, numbers, px)) / glm::dvec2(kSizePx);
            const glm::dvec3 expected(left + base.x * (right - left), up + base.y * (down - up), -1);
            ASSERT_LT(glm::distance(*projection->unproject(px), expected), 1e-12);
        }
    }
}

TEST(CameraTexture, ForwardMapsLandTheBaseImageWhereTheInterpolantPoints) {
    Variant forward{.alignment = "corners", .nodes = {9, 7}};
    const NumberMap numbers = forward.numbers();
    const ProjectionPtr map = projectionOf(forward);
    Variant identity = forward;
    identity.warp = [](glm::dvec2) { return glm::dvec2(0); };
    const ProjectionPtr base = projectionOf(identity);
    test::Random random(9);
    for (int i = 0; i < 20'000; ++i) {
        const glm::dvec2 px = random.pixel(kSizePx);
        const auto landed = map->project(*base->unproject(px));
        ASSERT_EQ(landed.size(), 1u);
        ASSERT_LT(glm::distance(landed[0], px + interpolated(forward, numbers, px)), 1e-9);
    }
}

TEST(CameraTexture, RaysEndOnTheBasePlaneAndNotBehindIt) {
    const ProjectionPtr projection = projectionOf({.direction = "inverse"});
    const glm::dvec3 ahead =
        rotationFromOrientation({glm::radians(20.0), glm::radians(-10.0), glm::radians(5.0)}) *
        glm::dvec3(0, 0, -1);
    test::Random random(10);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 ray = *projection->unproject(random.pixel(kSizePx));
        EXPECT_NEAR(glm::dot(ray, ahead), 1, 1e-12);
        EXPECT_THAT(projection->project(-ray), IsEmpty());
    }
    EXPECT_THAT(projection->project({0, 0, 0}), IsEmpty());
}

TEST(CameraTexture, EveryEyeSeesTheSame) {
    const ProjectionPtr projection = projectionOf({});
    EXPECT_EQ(projection->seenFrom({5, 6, 7})->unproject({400, 300}), projection->unproject({400, 300}));
}

TEST(CameraTexture, FoldsHaveSeveralAnswersAndShowTheSideThatMostCellsShow) {
    // Base columns 0 to 4 land at 0, 600, 200, 800, 1000: x from 200 to 600 is reached three times.
    const double landsAt[] = {0, 600, 200, 800, 1000};
    Variant variant{.semantics = "absolute", .nodes = {5, 2}};
    variant.warp = [&](glm::dvec2 p) {
        return glm::dvec2(landsAt[std::lround(4 * p.x)], 600 * p.y) - p * glm::dvec2(kSizePx);
    };
    const ProjectionPtr forward = projectionOf(variant);
    const auto columnOf = [&](glm::dvec3 ray) {  // of the base image, by its own perspective
        const glm::dvec3 local = glm::transpose(rotationFromOrientation(
                                     {glm::radians(20.0), glm::radians(-10.0), glm::radians(5.0)})) *
                                 ray;
        const double left = std::tan(glm::radians(-40.0)), right = 1;
        return 4 * (local.x / -local.z - left) / (right - left);
    };
    // Of 0.5, 1.75 and 2.17 the first is the leftmost that faces as three of four columns do.
    EXPECT_NEAR(columnOf(*forward->unproject({300, 200})), 0.5, 1e-9);
    EXPECT_NEAR(columnOf(*forward->unproject({700, 200})), 2 + 5.0 / 6, 1e-9);

    variant.direction = "inverse";
    const ProjectionPtr inverse = projectionOf(variant);
    const auto seenBy = inverse->project(*inverse->unproject({100, 200}));  // shows base column x = 300
    ASSERT_EQ(seenBy.size(), 3u);
    EXPECT_LT(nearest(seenBy, {100, 200}), 1e-9);
    EXPECT_LT(nearest(seenBy, {350, 200}), 1e-9);
    EXPECT_LT(nearest(seenBy, {400 + 200.0 / 6, 200}), 1e-9);
}

TEST(CameraTexture, PixelsThatNothingLandsOnAreHoles) {
    Variant variant{.nodes = {3, 3}};
    variant.warp = [](glm::dvec2 p) { return -0.5 * (p - 0.5) * glm::dvec2(kSizePx); };  // half the size
    const ProjectionPtr projection = projectionOf(variant);
    EXPECT_FALSE(projection->unproject({199.9, 300}));
    EXPECT_TRUE(projection->unproject({200.1, 300}));
    EXPECT_FALSE(projection->unproject({400, 450.1}));
    EXPECT_FALSE(projection->unproject({std::numeric_limits<double>::infinity(), 0}));
}

TEST(CameraTexture, NodesWithoutSampleAndCollapsedCellsAreHoles) {
    for (const double bad :
         {static_cast<double>(kNan), std::numeric_limits<double>::infinity(), 1e30, -1e30}) {
        Variant variant{.direction = "inverse", .nodes = {5, 4}};
        variant.warp = [&](glm::dvec2 p) {
            return glm::distance(p, glm::dvec2(0.5, 1.0 / 3)) < 1e-9 ? glm::dvec2(0, bad) : glm::dvec2(3, 4);
        };
        const ProjectionPtr projection = projectionOf(variant);
        EXPECT_FALSE(projection->unproject({201, 1}));
        EXPECT_FALSE(projection->unproject({599, 399}));
        EXPECT_TRUE(projection->unproject({199, 1}));
        EXPECT_TRUE(projection->unproject({601, 399}));
        EXPECT_TRUE(projection->unproject({401, 401}));
    }
    // The second of four columns shows one single column of the base image.
    Variant variant{.semantics = "absolute", .direction = "inverse", .nodes = {5, 2}};
    variant.warp = [](glm::dvec2 p) { return glm::dvec2(p.x > 0.4 && p.x < 0.6 ? -200 : 0, 0); };
    const ProjectionPtr projection = projectionOf(variant);
    EXPECT_FALSE(projection->unproject({300, 300}));
    EXPECT_TRUE(projection->unproject({100, 300}));
    EXPECT_TRUE(projection->unproject({500, 300}));
}

// All positions of a value by cutting cells in four until they are points.
void cutCells(const std::array<glm::dvec2, 4>& px, const std::array<glm::dvec2, 4>& v, glm::dvec2 value,
              int depth, std::vector<glm::dvec2>& found) {
    const glm::dvec2 low = glm::min(glm::min(v[0], v[1]), glm::min(v[2], v[3]));
    const glm::dvec2 high = glm::max(glm::max(v[0], v[1]), glm::max(v[2], v[3]));
    if (glm::any(glm::lessThan(value, low)) || glm::any(glm::greaterThan(value, high))) return;
    if (depth == 0) {
        found.push_back(0.25 * (px[0] + px[1] + px[2] + px[3]));
        return;
    }
    const auto quarter = [](const std::array<glm::dvec2, 4>& c, int x, int y) {
        const auto at = [&](double s, double t) {
            return glm::mix(glm::mix(c[0], c[1], s), glm::mix(c[2], c[3], s), t);
        };
        return std::array<glm::dvec2, 4>{at(x / 2.0, y / 2.0), at(x / 2.0 + 0.5, y / 2.0),
                                         at(x / 2.0, y / 2.0 + 0.5), at(x / 2.0 + 0.5, y / 2.0 + 0.5)};
    };
    for (int i = 0; i < 4; ++i)
        cutCells(quarter(px, i % 2, i / 2), quarter(v, i % 2, i / 2), value, depth - 1, found);
}

TEST(CameraTexture, AnswersAreThoseOfAllCellsCutToPieces) {
    Variant variant{.semantics = "absolute", .direction = "inverse", .nodes = {23, 18}};
    variant.warp = [](glm::dvec2 p) { return 1.5 * foldedWarp(p) + 0.4 * smoothWarp(p); };
    variant.isHole = [](glm::ivec2 node) { return node == glm::ivec2(5, 6) || node == glm::ivec2(12, 3); };
    const NumberMap numbers = variant.numbers();
    const GridMap map(numbers, {}, kSizePx, Alignment::corners);
    test::Random random(11);
    int answers = 0;
    for (int i = 0; i < 2'000; ++i) {
        const glm::dvec2 value = random.pixel(kSizePx);
        std::vector<glm::dvec2> expected;
        for (int y = 0; y + 1 < variant.nodes.y; ++y)
            for (int x = 0; x + 1 < variant.nodes.x; ++x) {
                std::array<glm::dvec2, 4> px, v;
                bool hole = false;
                for (int k = 0; k < 4; ++k) {
                    const glm::ivec2 node(x + k % 2, y + k / 2);
                    px[static_cast<size_t>(k)] = variant.nodeAt(node) * glm::dvec2(kSizePx);
                    v[static_cast<size_t>(k)] = {numbers.at(node.x, node.y)[0],
                                                 numbers.at(node.x, node.y)[1]};
                    hole = hole || variant.isHole(node);
                }
                if (!hole) cutCells(px, v, value, 22, expected);
            }
        const std::vector<glm::dvec2> found = map.positions(value);
        for (const glm::dvec2 p : expected) ASSERT_LT(nearest(found, p), 1e-3) << value.x << ", " << value.y;
        for (const glm::dvec2 p : found) ASSERT_LT(nearest(expected, p), 1e-3) << value.x << ", " << value.y;
        answers += static_cast<int>(found.size());
    }
    EXPECT_GT(answers, 2'300);  // it does fold
}

TEST(CameraTexture, AnEdgeThatCellsShareGivesOneAnswer) {
    const Variant variant{.direction = "inverse", .nodes = {33, 25}};
    const GridMap map(variant.numbers(), {.isOffset = true}, kSizePx, Alignment::corners);
    test::Random random(12);
    for (int i = 0; i < 100'000; ++i) {
        const glm::dvec2 px = awkwardPixel(random, variant);
        const auto positions = map.positions(*map.at(px));
        ASSERT_EQ(positions.size(), 1u) << px.x << ", " << px.y;
        ASSERT_LT(glm::distance(positions[0], px), 1e-8);
    }
}

TEST(CameraTexture, IntegersNeedAScaleAndAreCentredByDefault) {
    const test::TemporaryFolder folder;
    const NumberMap map{{1, 1}, 3, false, {0.75f, 0.5f, 0}};
    test::writeMap(folder.path("map.png"), map, OIIO::TypeDesc::UINT16);
    Variant variant{.direction = "inverse", .alignment = "centers", .nodes = {1, 1}};
    json keys = variant.keys();
    keys["offsets"] = "map.png";
    try {
        readKeys(keys, folder);
        ADD_FAILURE() << "no scale";
    } catch (const FieldError& error) {
        EXPECT_EQ(error.field, "projection.scale");
    }
    keys["scale"] = 100;
    variant.warp = [](glm::dvec2) {
        return glm::dvec2(100 * (49151 / 65535.0 - 0.5), 100 * (32768 / 65535.0 - 0.5));
    };
    const ProjectionPtr expected = projectionOf(variant), centred = readKeys(keys, folder);
    EXPECT_LT(glm::distance(*centred->unproject({400, 300}), *expected->unproject({400, 300})), 1e-7);
    keys["zero"] = 0.25;
    const ProjectionPtr shifted = readKeys(keys, folder);
    EXPECT_LT(glm::distance(*shifted->unproject({375, 275}), *expected->unproject({400, 300})), 1e-7);
}

TEST(CameraTexture, ErrorsNameTheFieldAndWhatItMayBe) {
    const test::TemporaryFolder folder;
    folder.write("map.pfm", test::pfmBytes(Variant().numbers()));
    const auto complaint = [&](const json& keys) -> std::string {
        try {
            readKeys(keys, folder);
        } catch (const FieldError& error) {
            return error.what();
        }
        return "nothing";
    };
    for (const char* key : {"offsets", "semantics", "direction", "alignment", "origin", "units", "base"}) {
        json keys = Variant().keys();
        keys.erase(key);
        EXPECT_THAT(complaint(keys), HasSubstr("projection." + std::string(key) + ": expected"));
        EXPECT_THAT(complaint(keys), HasSubstr("found nothing"));
        keys[key] = "sideways";
        if (key != std::string("offsets")) {
            EXPECT_THAT(complaint(keys), HasSubstr("sideways"));
        }
    }
    const auto changed = [](const char* pointer, const json& value) {
        json keys = Variant().keys();
        keys[json::json_pointer(pointer)] = value;
        return keys;
    };
    EXPECT_THAT(complaint(changed("/direction", "back")), HasSubstr("forward (where positions"));
    EXPECT_THAT(complaint(changed("/center", {0, 0, 1})), HasSubstr("what has no surface is at infinity"));
    EXPECT_THAT(complaint(changed("/base/left_deg", 50)), HasSubstr("left_deg below right_deg"));
    EXPECT_THAT(complaint(changed("/base/up_deg", -35)), HasSubstr("down_deg below up_deg"));
    EXPECT_THAT(complaint(changed("/base/up_deg", 90)), HasSubstr("projection.base.up_deg"));
    EXPECT_THAT(complaint(changed("/base/fov", 90)), HasSubstr("\"fov\""));
    EXPECT_THAT(complaint(changed("/scale", "x")), HasSubstr("projection.scale"));
}

TEST(CameraTexture, FilesThatCannotBeUsedAreRefusedByName) {
    const test::TemporaryFolder folder;
    const auto complaint = [&](const NumberMap& map, const json& keys = Variant().keys()) -> std::string {
        folder.write("map.pfm", test::pfmBytes(map));
        try {
            readKeys(keys, folder);
        } catch (const InputError& error) {
            return error.what();
        } catch (const FieldError& error) {
            return error.what();
        }
        return "nothing";
    };
    const auto filled = [](glm::ivec2 size, int channels, float value) {
        return NumberMap{size, channels, false,
                         std::vector<float>(static_cast<size_t>(size.x * size.y * channels), value)};
    };
    EXPECT_THAT(complaint(filled({3, 3}, 1, 0)), HasSubstr("map.pfm: expected at least 2 channels, found 1"));
    EXPECT_THAT(complaint(filled({3, 1}, 3, 0)), HasSubstr("at least 2 x 2 nodes, found 3 x 1"));
    EXPECT_THAT(complaint(filled({3, 3}, 3, kNan)), HasSubstr("no valid sample anywhere"));
    json absolute = Variant().keys();
    absolute["semantics"] = "absolute";
    EXPECT_THAT(complaint(filled({3, 3}, 3, 7), absolute), HasSubstr("collapses everywhere"));
    EXPECT_EQ(complaint(filled({3, 3}, 3, 7)), "nothing");
    // Every pixel shows the same column: offsets take all of the width back.
    NumberMap columns = filled({9, 9}, 3, 0);
    for (int i = 0; i < 81; ++i)
        columns.values[static_cast<size_t>(3 * i)] = -100.0f * static_cast<float>(i % 9);
    EXPECT_THAT(complaint(columns), HasSubstr("collapses everywhere"));
    json keys = Variant().keys();
    keys["offsets"] = "absent.exr";
    EXPECT_THAT(complaint(filled({3, 3}, 3, 0), keys),
                HasSubstr("offsets: expected the name of a file that is there, found \"absent.exr\""));
}

}  // namespace
}  // namespace curvewall
