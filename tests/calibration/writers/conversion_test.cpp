// Round trips: every shipped wall in every format that can hold it, measured by a second ruler.

#include "calibration/writers/conversion.h"

#include "calibration/errors.h"
#include "calibration/files/map_file.h"
#include "calibration/readers/wall_reader.h"
#include "tests/support/shipped_walls.h"
#include "tests/support/temporary_folder.h"

#include <OpenImageIO/imageio.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <zip.h>

namespace curvewall {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

constexpr double kRoundingPx = 1e-3;  // of single precision, at a border
constexpr double kInfinity = std::numeric_limits<double>::infinity();

const char* extensionOf(ConvertedKind kind) {
    switch (kind) {
        case ConvertedKind::pfm:
            return ".pfm";
        case ConvertedKind::bourke:
            return ".data";
        case ConvertedKind::mpcdi:
            return ".mpcdi";
        default:
            return ".exr";
    }
}

std::string textOf(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

// The shipped wall with fewer pixels, in a folder of its own beside its maps.
std::string smallWall(const test::TemporaryFolder& folder, const std::string& stem, int divisor) {
    const fs::path configs = CURVEWALL_SOURCE_DIR "/configs";
    json wall = json::parse(textOf((configs / (stem + ".json")).string()));
    for (json& display : wall["displays"])
        for (json& side : display["size"]) side = side.get<int>() / divisor;
    fs::create_directories(folder.path("in"));
    fs::copy(configs / "maps", folder.path("in/maps"), fs::copy_options::recursive);
    return folder.write("in/" + stem + ".json", wall.dump());
}

ConversionRequest requestFor(const Wall& wall, const std::string& input, const std::string& stem,
                             ConvertedKind kind) {
    ConversionRequest request;
    request.kind = kind;
    request.inputPath = input;
    for (const Display& display : wall.displays) {
        request.displays.push_back(&display);
        request.paths.push_back(stem + "-" + display.name + extensionOf(kind));
    }
    if (kind == ConvertedKind::mpcdi)
        request.paths = {stem + ".mpcdi"};
    else
        request.wallPath = stem + ".json";
    return request;
}

struct Ruler {
    double maxPx = 0;
    int64_t holesGained = 0, holesLost = 0;
};

// Where the original shows what the copy sees at a pixel, against the pixel; the straight way, one by one.
Ruler measured(const Display& original, const Display& copy) {
    Ruler ruler;
    for (int y = 0; y < original.sizePx.y; ++y)
        for (int x = 0; x < original.sizePx.x; ++x) {
            const glm::dvec2 px(x + 0.5, y + 0.5);
            const auto before = original.projection->unproject(px), after = copy.projection->unproject(px);
            ruler.holesGained += before && !after;
            ruler.holesLost += after && !before;
            if (!before || !after) continue;
            double nearest = kInfinity;
            for (const glm::dvec2 at : original.projection->project(*after))
                for (const int turn : {-1, 0, 1})
                    if (turn == 0 || closesOnItself(original))
                        nearest = std::min(nearest,
                                           glm::distance(at + glm::dvec2(turn * original.sizePx.x, 0), px));
            // A rounded ray may cross the border of a grid, beyond which there is no answer.
            if (nearest < kInfinity) ruler.maxPx = std::max(ruler.maxPx, nearest);
        }
    return ruler;
}

struct Trip {
    std::vector<ConvertedDisplay> stated;
    Wall read;
};

Trip roundTrip(const Wall& wall, const ConversionRequest& request) {
    Trip trip{convertWall(wall, request), {}};
    trip.read = readWall(request.wallPath.empty() ? request.paths.front() : request.wallPath);
    return trip;
}

void expectStatedErrors(const Wall& wall, const Trip& trip, double boundPx) {
    for (size_t i = 0; i < wall.displays.size(); ++i) {
        SCOPED_TRACE(wall.displays[i].name);
        const ConversionError& stated = trip.stated.at(i).error;
        const Ruler ruler = measured(wall.displays[i], findDisplay(trip.read, wall.displays[i].name));
        EXPECT_GE(stated.maxPx, ruler.maxPx - 1e-9);
        EXPECT_LE(stated.maxPx, std::max(ruler.maxPx + 1e-9, kRoundingPx));
        EXPECT_EQ(stated.holesGained, ruler.holesGained);
        EXPECT_EQ(stated.holesLost, ruler.holesLost);
        EXPECT_LT(stated.maxPx, boundPx);
        EXPECT_LE(stated.meanPx, stated.p99Px + 1e-12);
        EXPECT_LE(stated.p99Px, stated.maxPx);
        // A hole takes the pixels that touch it along; it must not take more.
        const glm::ivec2 size = wall.displays[i].sizePx;
        EXPECT_LT(stated.holesGained, 2 * (size.x + size.y));
    }
}

class ShippedWalls : public ::testing::TestWithParam<std::string> {
protected:
    std::string input_ = smallWall(folder_, GetParam(), 8);
    Wall wall_ = readWall(input_);
    ConversionRequest request(ConvertedKind kind) const {
        return requestFor(wall_, input_, folder_.path("out"), kind);
    }
    test::TemporaryFolder folder_;
};

TEST_P(ShippedWalls, ComeBackFromSurfaceMaps) {
    expectStatedErrors(wall_, roundTrip(wall_, request(ConvertedKind::surfaceMap)), 0.01);
}

TEST_P(ShippedWalls, ComeBackFromPfm) {
    expectStatedErrors(wall_, roundTrip(wall_, request(ConvertedKind::pfm)), 0.01);
}

// The widest angle between what two pixels see: half of it is the least that a cone around them has.
bool seesTooMuch(const Display& display) {
    std::vector<glm::dvec3> rays;
    const int step = std::max(1, display.sizePx.x / 40);
    for (int y = 0; y < display.sizePx.y; y += step)
        for (int x = 0; x < display.sizePx.x; x += step)
            if (const auto ray = display.projection->unproject({x + 0.5, y + 0.5}))
                rays.push_back(glm::normalize(*ray));
    double least = 1;
    for (const glm::dvec3& a : rays)
        for (const glm::dvec3& b : rays) least = std::min(least, glm::dot(a, b));
    return least < std::cos(glm::radians(170.0));
}

TEST_P(ShippedWalls, ComeBackFromCameraTexturesUnlessTheySeeTooMuch) {
    for (const Display& display : wall_.displays) {
        SCOPED_TRACE(display.name);
        Wall one = wall_;
        one.displays = {display};
        const ConversionRequest request =
            requestFor(one, input_, folder_.path("out"), ConvertedKind::cameraTexture);
        if (!seesTooMuch(display)) {
            expectStatedErrors(one, roundTrip(one, request), 0.01);
            continue;
        }
        try {
            convertWall(one, request);
            FAIL() << "it was converted";
        } catch (const UsageError& error) {
            EXPECT_THAT(error.what(), HasSubstr("surface-map"));
        }
        EXPECT_FALSE(fs::exists(request.paths.front()));
    }
}

TEST_P(ShippedWalls, ComeBackFromBourkeMeshes) {
    const Trip trip = roundTrip(wall_, request(ConvertedKind::bourke));
    // What is straight behind a fisheye that shows everything cannot be reached.
    const bool isEverything = GetParam() == "equirectangular";
    expectStatedErrors(wall_, trip, isEverything ? kInfinity : 1.0);
    for (const ConvertedDisplay& display : trip.stated)
        EXPECT_TRUE(display.error.maxPx < 0.25 || display.nodes.x == 512) << display.name;
}

INSTANTIATE_TEST_SUITE_P(Walls, ShippedWalls, ::testing::ValuesIn(test::shippedWallNames()),
                         [](const auto& info) {
                             std::string name = info.param;
                             std::ranges::replace(name, '-', '_');
                             return name;
                         });

// --- What the files say, by the documents of their formats ---

class Conversion : public ::testing::Test {
protected:
    // A cylinder of 6 x 4 pixels whose left column of pixels is masked to a half and that is never black.
    void SetUp() override {
        input_ = folder_.write("in/wall.json", R"({"wall": "small", "eye": [0.25, 0.5, 0], "displays": [
            {"name": "a", "size": [6, 4], "projection": {"type": "cylinder", "radius": 2, "arc_deg": 90,
             "height": 2}}]})");
        wall_ = readWall(input_);
    }
    Trip trip(ConvertedKind kind, const std::string& stem = "out") const {
        return roundTrip(wall_, requestFor(wall_, input_, folder_.path(stem), kind));
    }
    glm::dvec3 ray(double x, double y) const {
        return wall_.displays.front().projection->unproject({x, y}).value();
    }
    test::TemporaryFolder folder_;
    std::string input_;
    Wall wall_;
};

TEST_F(Conversion, SurfaceMapsHoldPointsOfTheWallTopRowFirst) {
    trip(ConvertedKind::surfaceMap);
    const auto in = OIIO::ImageInput::open(folder_.path("out-a.exr"));
    ASSERT_TRUE(in);
    EXPECT_EQ(in->spec().nchannels, 3);
    EXPECT_EQ(in->spec().format, OIIO::TypeDesc::FLOAT);
    std::vector<float> numbers(6 * 4 * 3);
    ASSERT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, numbers.data()));
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 6; ++x) {
            // The wall stands 2 m around the origin, whatever the eye; columns by angle and rows by height.
            const double angle = glm::radians(90.0) * ((x + 0.5) / 6 - 0.5);
            const glm::dvec3 point(2 * std::sin(angle), 1 - 2 * (y + 0.5) / 4, -2 * std::cos(angle));
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(numbers[static_cast<size_t>((y * 6 + x) * 3 + c)], point[c], 1e-6);
        }
}

TEST_F(Conversion, PfmHasTheBottomRowFirstAndLittleEndianNumbers) {
    trip(ConvertedKind::pfm);
    const std::string bytes = textOf(folder_.path("out-a.pfm"));
    const std::string head = "PF\n6 4\n-1.0\n";
    ASSERT_EQ(bytes.size(), head.size() + 6 * 4 * 3 * 4);
    EXPECT_EQ(bytes.substr(0, head.size()), head);
    float first[3];
    std::memcpy(first, bytes.data() + head.size(), sizeof first);
    const double angle = glm::radians(-37.5);
    EXPECT_NEAR(first[0], 2 * std::sin(angle), 1e-6);
    EXPECT_NEAR(first[1], -0.75, 1e-6);
    EXPECT_NEAR(first[2], -2 * std::cos(angle), 1e-6);
}

TEST_F(Conversion, CameraTexturesHoldOffsetsIntoAFlatPicture) {
    trip(ConvertedKind::cameraTexture);
    const json base = json::parse(textOf(folder_.path("out.json")))["displays"][0]["projection"];
    EXPECT_EQ(base["direction"], "inverse");
    EXPECT_EQ(base["semantics"], "offset");
    const auto in = OIIO::ImageInput::open(folder_.path("out-a.exr"));
    ASSERT_TRUE(in);
    ASSERT_EQ(in->spec().nchannels, 2);
    std::vector<float> offsets(6 * 4 * 2);
    ASSERT_TRUE(in->read_image(0, 0, 0, 2, OIIO::TypeDesc::FLOAT, offsets.data()));
    const Orientation looks{glm::radians(base["yaw_deg"].get<double>()),
                            glm::radians(base["pitch_deg"].get<double>()),
                            glm::radians(base["roll_deg"].get<double>())};
    const auto tangent = [&](const char* key) {
        return std::tan(glm::radians(base["base"][key].get<double>()));
    };
    const double left = tangent("left_deg"), right = tangent("right_deg"), up = tangent("up_deg"),
                 down = tangent("down_deg");
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 6; ++x) {
            const glm::dvec2 px(x + 0.5, y + 0.5);
            const size_t at = static_cast<size_t>(y * 6 + x) * 2;
            const glm::dvec2 b = px + glm::dvec2(offsets[at], offsets[at + 1]);
            const glm::dvec3 seen =
                rotationFromOrientation(looks) *
                glm::dvec3(left + b.x / 6 * (right - left), up - b.y / 4 * (up - down), -1);
            EXPECT_LT(glm::distance(glm::normalize(seen), glm::normalize(ray(px.x, px.y))), 1e-6);
        }
}

TEST_F(Conversion, BourkeMeshesPointIntoTheFisheyeThatTheWallFileDescribes) {
    ConversionRequest request = requestFor(wall_, input_, folder_.path("out"), ConvertedKind::bourke);
    request.grid = {5, 3};
    roundTrip(wall_, request);
    std::istringstream mesh(textOf(folder_.path("out-a.data")));
    const json source =
        json::parse(textOf(folder_.path("out.json")))["displays"][0]["calibration"]["source"]["projection"];
    const glm::dmat3 world = rotationFromOrientation({glm::radians(source["yaw_deg"].get<double>()),
                                                      glm::radians(source["pitch_deg"].get<double>()),
                                                      glm::radians(source["roll_deg"].get<double>())});
    const double fovRad = glm::radians(source["fov_deg"].get<double>());
    int type = 0, columns = 0, rows = 0;
    mesh >> type >> columns >> rows;
    EXPECT_EQ(type, 2);
    ASSERT_EQ(columns, 5);
    ASSERT_EQ(rows, 3);
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            double x = 0, y = 0, u = 0, v = 0, i = 0;
            ASSERT_TRUE(mesh >> x >> y >> u >> v >> i);
            EXPECT_NEAR(x, 1.5 * (column / 2.0 - 1), 1e-9);
            EXPECT_NEAR(y, row - 1, 1e-9);  // the bottom row first
            EXPECT_EQ(i, 1);
            const glm::dvec2 off(2 * u - 1, 2 * v - 1);
            const double theta = glm::length(off) * fovRad / 2;
            const glm::dvec2 across = theta > 0 ? off / glm::length(off) * std::sin(theta) : glm::dvec2(0);
            const glm::dvec3 seen = world * glm::dvec3(across, -std::cos(theta));
            EXPECT_LT(glm::distance(seen, glm::normalize(ray(column * 1.5, 4 - row * 2))), 1e-8);
        }
}

}  // namespace
}  // namespace curvewall
