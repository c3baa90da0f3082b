// Round trips: every shipped wall in every format that can hold it, measured by a second ruler.

#include "calibration/writers/conversion.h"

#include "calibration/errors.h"
#include "calibration/files/map_file.h"
#include "calibration/projections/pose.h"
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
#include <pugixml.hpp>
#include <random>
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

ConversionRequest requestFor(const Wall& wall, const std::string& stem, ConvertedKind kind) {
    ConversionRequest request;
    request.kind = kind;
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
        EXPECT_LE(std::max(stated.meanPx, stated.p99Px), stated.maxPx);
        // A hole takes the pixels that touch it along; it must not take more.
        const glm::ivec2 size = wall.displays[i].sizePx;
        EXPECT_LT(stated.holesGained, 2 * (size.x + size.y));
    }
}

class ShippedWalls : public ::testing::TestWithParam<std::string> {
protected:
    ConversionRequest request(ConvertedKind kind) const {
        return requestFor(wall_, folder_.path("out"), kind);
    }
    test::TemporaryFolder folder_;
    std::string input_ = smallWall(folder_, GetParam(), 8);
    Wall wall_ = readWall(input_);
};

TEST_P(ShippedWalls, ComeBackFromSurfaceMaps) {
    expectStatedErrors(wall_, roundTrip(wall_, request(ConvertedKind::surfaceMap)), 0.01);
}

TEST_P(ShippedWalls, ComeBackFromPfm) {
    expectStatedErrors(wall_, roundTrip(wall_, request(ConvertedKind::pfm)), 0.01);
}

// The widest angle between what two pixels see: a cone around them is at least as wide.
double widestDeg(const Display& display) {
    std::vector<glm::dvec3> rays;
    const int step = std::max(1, display.sizePx.x / 40);
    for (int y = 0; y < display.sizePx.y; y += step)
        for (int x = 0; x < display.sizePx.x; x += step)
            if (const auto ray = display.projection->unproject({x + 0.5, y + 0.5}))
                rays.push_back(glm::normalize(*ray));
    double least = 1;
    for (const glm::dvec3& a : rays)
        for (const glm::dvec3& b : rays) least = std::min(least, glm::dot(a, b));
    return glm::degrees(std::acos(least));
}

TEST_P(ShippedWalls, ComeBackFromCameraTexturesUnlessTheySeeTooMuch) {
    for (const Display& display : wall_.displays) {
        SCOPED_TRACE(display.name);
        Wall one = wall_;
        one.displays = {display};
        const ConversionRequest request = requestFor(one, folder_.path("out"), ConvertedKind::cameraTexture);
        constexpr double kMostDeg = 170, kCertainlyLessDeg = 166;
        if (widestDeg(display) < kCertainlyLessDeg) expectStatedErrors(one, roundTrip(one, request), 0.01);
        if (widestDeg(display) < kMostDeg) continue;
        try {
            convertWall(one, request);
            FAIL() << "it was converted";
        } catch (const UsageError& error) {
            EXPECT_THAT(error.what(), HasSubstr("surface-map"));
        }
        EXPECT_FALSE(fs::exists(request.paths.front()));
    }
}

TEST_P(ShippedWalls, ComeBackFromMpcdiArchives) {
    expectStatedErrors(wall_, roundTrip(wall_, request(ConvertedKind::mpcdi)), 0.01);
}

TEST_P(ShippedWalls, ComeBackFromBourkeMeshes) {
    const Trip trip = roundTrip(wall_, request(ConvertedKind::bourke));
    // What is straight behind a fisheye that shows everything cannot be reached; offsets of as many pixels as
    // on a picture eight times as wide fold it, and a mesh has triangles across the folds.
    const bool isTooMuch = GetParam() == "equirectangular" || GetParam() == "view-deformation";
    expectStatedErrors(wall_, trip, isTooMuch ? kInfinity : 1.0);
    for (const ConvertedDisplay& display : trip.stated)
        EXPECT_TRUE(display.error.maxPx < 0.25 ||
                    display.nodes.x >= std::min(512, findDisplay(wall_, display.name).sizePx.x))
            << display.name;
}

INSTANTIATE_TEST_SUITE_P(Walls, ShippedWalls, ::testing::ValuesIn(test::shippedWallNames()),
                         [](const auto& wall) {
                             std::string name = wall.param;
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
        return roundTrip(wall_, requestFor(wall_, folder_.path(stem), kind));
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
    ConversionRequest request = requestFor(wall_, folder_.path("out"), ConvertedKind::bourke);
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

// Members of an archive by libzip alone.
std::string memberOf(const std::string& path, const std::string& name) {
    zip_t* archive = zip_open(path.c_str(), ZIP_RDONLY, nullptr);
    zip_stat_t stat;
    std::string bytes;
    if (archive && zip_stat(archive, name.c_str(), 0, &stat) == 0) {
        bytes.resize(stat.size);
        zip_file_t* file = zip_fopen(archive, name.c_str(), 0);
        zip_fread(file, bytes.data(), stat.size);
        zip_fclose(file);
    }
    zip_discard(archive);
    return bytes;
}

std::vector<float> pfmNumbers(const std::string& bytes, const std::string& head) {
    EXPECT_EQ(bytes.substr(0, head.size()), head);
    std::vector<float> numbers((bytes.size() - head.size()) / 4);
    std::memcpy(numbers.data(), bytes.data() + head.size(), 4 * numbers.size());
    return numbers;
}

TEST_F(Conversion, ArchivesOfSurfacesHoldPointsRelativeToTheEye) {
    trip(ConvertedKind::mpcdi);
    const std::string manifest = memberOf(folder_.path("out.mpcdi"), "mpcdi.xml");
    for (const char* part :
         {"profile=\"a3d\"", "version=\"1.0\"", "<region id=\"a\"", "xsize=\"1\"", "Xresolution=\"6\"",
          "<geometricUnit>m</geometricUnit>", "<originOf3DData>idealEyePoint</originOf3DData>",
          "<path>region1-warp.pfm</path>", "<gammaEmbedded>1.0</gammaEmbedded>", "<bitDepth>16</bitDepth>"})
        EXPECT_THAT(manifest, HasSubstr(part));
    const std::vector<float> numbers =
        pfmNumbers(memberOf(folder_.path("out.mpcdi"), "region1-warp.pfm"), "PF\n6 4\n-1.0\n");
    ASSERT_EQ(numbers.size(), 6U * 4 * 3);
    const glm::dvec3 bottomLeft = ray(0.5, 3.5);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(numbers[static_cast<size_t>(c)], bottomLeft[c], 1e-6);
}

TEST_F(Conversion, ArchivesOfFlatViewsHoldAFrustumAndPlacesInItsPicture) {
    input_ = folder_.write("in/flat.json", R"({"wall": "flat", "displays": [
        {"name": "l<&>", "size": [4, 4], "projection": {"type": "frustum", "left_deg": -45, "right_deg": 45,
         "down_deg": -45, "up_deg": 45, "yaw_deg": 30}},
        {"name": "r", "size": [8, 2], "projection": {"type": "frustum", "left_deg": -45, "right_deg": 45,
         "down_deg": -20, "up_deg": 20}}]})");
    wall_ = readWall(input_);
    expectStatedErrors(wall_, trip(ConvertedKind::mpcdi), 1e-4);
    const std::string manifest = memberOf(folder_.path("out.mpcdi"), "mpcdi.xml");
    EXPECT_THAT(manifest, HasSubstr("profile=\"3d\""));
    EXPECT_THAT(manifest, HasSubstr("x=\"0.3333333333333333\""));  // 4 of 12 pixels
    EXPECT_THAT(manifest, HasSubstr("ysize=\"0.5\""));
    // The picture just holds the pixel centres, whose tangents go from -0.75 to 0.75 here.
    const std::vector<float> numbers =
        pfmNumbers(memberOf(folder_.path("out.mpcdi"), "region1-warp.pfm"), "PF\n4 4\n-1.0\n");
    EXPECT_NEAR(numbers[0], 0, 1e-5);  // the bottom left node first, v downwards
    EXPECT_NEAR(numbers[1], 1, 1e-5);
    EXPECT_NEAR(numbers[3], 1.0 / 3, 1e-5);
}

TEST_F(Conversion, BlendingComesAlong) {
    NumberMap alpha{{6, 4}, 1, true, {}}, beta{{6, 4}, 3, true, {}};
    for (int i = 0; i < 24; ++i) {
        alpha.values.push_back(static_cast<float>(i) / 24);
        for (int c = 0; c < 3; ++c) beta.values.push_back(0.01F * static_cast<float>(c + i % 3));
    }
    writePng16(folder_.path("in/alpha.png"), alpha);
    writePng16(folder_.path("in/beta.png"), beta);
    input_ = folder_.write("in/blended.json", R"({"wall": "small", "displays": [
        {"name": "a", "size": [6, 4], "projection": {"type": "cylinder", "radius": 2, "arc_deg": 90,
         "height": 2}, "blend": {"alpha": "alpha.png", "beta": "beta.png", "gamma": 2.2}}]})");
    wall_ = readWall(input_);
    for (const ConvertedKind kind : {ConvertedKind::surfaceMap, ConvertedKind::cameraTexture,
                                     ConvertedKind::pfm, ConvertedKind::mpcdi}) {
        const Trip read = trip(kind);
        const BlendMaps &before = *wall_.displays[0].blend, &after = *read.read.displays[0].blend;
        float off = 0;
        for (size_t i = 0; i < 24; ++i)
            for (int c = 0; c < 3; ++c)
                off = std::max({off, std::abs(before.alpha[i][c] - after.alpha[i][c]),
                                std::abs(before.beta[i][c] - after.beta[i][c])});
        EXPECT_LE(off, kind == ConvertedKind::mpcdi ? 1.0 / 65535 : 0);
        EXPECT_NEAR(read.stated[0].error.blendDifference, off, 1e-7);
    }
    // A mesh keeps the alpha alone, encoded. Its border nodes have the alpha of the border pixels, so that
    // these get a quarter of the 6 / 24 to their neighbours; the slope of x^2.2 at 1 is 2.2.
    ConversionRequest request = requestFor(wall_, folder_.path("out"), ConvertedKind::bourke);
    request.grid = {7, 5};
    const Trip read = roundTrip(wall_, request);
    EXPECT_NEAR(read.stated[0].error.blendDifference, 2.2 * 6 / 24 / 4, 0.01);
    std::istringstream mesh(textOf(folder_.path("out-a.data")));
    double number = 0;
    for (int i = 0; i < 3 + 5; ++i) mesh >> number;  // the head and the bottom left node
    EXPECT_NEAR(number, 18.0 / 24, 1e-4);            // of pixel (0, 3), which was encoded likewise
}

TEST_F(Conversion, HolesStayHolesAndAreCounted) {
    input_ = folder_.write("in/dome.json", R"({"wall": "dome", "displays": [
        {"name": "a", "size": [64, 64], "projection": {"type": "radial", "model": "equidistant",
         "fov_deg": 160}}]})");
    wall_ = readWall(input_);
    for (const ConvertedKind kind :
         {ConvertedKind::surfaceMap, ConvertedKind::cameraTexture, ConvertedKind::mpcdi}) {
        const Trip read = trip(kind);
        expectStatedErrors(wall_, read, 0.01);
        EXPECT_FALSE(read.read.displays[0].projection->unproject({1, 1}));
        EXPECT_EQ(read.stated[0].error.holesLost, 0);
        EXPECT_LT(read.stated[0].error.holesGained, 20);
    }
    const Trip mesh = trip(ConvertedKind::bourke);
    EXPECT_GT(mesh.stated[0].error.holesGained, 0);
    EXPECT_EQ(mesh.stated[0].error.holesLost, 0);
}

TEST_F(Conversion, CoarseGridsCostWhatIsStated) {
    ConversionRequest request = requestFor(wall_, folder_.path("out"), ConvertedKind::surfaceMap);
    request.grid = {3, 2};
    const Trip trip = roundTrip(wall_, request);
    EXPECT_EQ(trip.stated[0].nodes, glm::ivec2(3, 2));
    expectStatedErrors(wall_, trip, 1);
    EXPECT_GT(trip.stated[0].error.maxPx, 0.01);  // a chord of 45 degrees for an arc
    request = requestFor(wall_, folder_.path("out"), ConvertedKind::mpcdi);
    request.grid = {3, 2};
    EXPECT_THROW(convertWall(wall_, request), UsageError);
}

// Everything in the folder, hidden files included.
std::set<std::string> filesIn(const std::string& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
    return names;
}

TEST_F(Conversion, NothingIsOverwrittenThatTheInputNeeds) {
    trip(ConvertedKind::pfm, "in/map");
    const std::string before = textOf(folder_.path("in/map-a.pfm"));
    input_ = folder_.path("in/map.json");
    wall_ = readWall(input_);
    const auto files = filesIn(folder_.path("in"));
    for (const char* name : {"map", "map-a"}) {
        ConversionRequest request = requestFor(wall_, folder_.path("in/other"), ConvertedKind::pfm);
        request.paths = {folder_.path("in/" + std::string(name) + ".pfm")};
        request.wallPath = folder_.path("in/" + std::string(name) + ".json");
        EXPECT_THROW(convertWall(wall_, request), UsageError) << name;
    }
    EXPECT_EQ(filesIn(folder_.path("in")), files);
    EXPECT_EQ(textOf(folder_.path("in/map-a.pfm")), before);
}

TEST_F(Conversion, NoFileOfTheInputIsOverwrittenHoweverItIsNamed) {
    trip(ConvertedKind::bourke, "in/left");
    fs::rename(folder_.path("in/left-a.data"), folder_.path("in/left.data"));
    // The name of the mesh is in no file but the second, as it was on another machine.
    folder_.write("in/c.json", R"({"version": 1, "masteraddress": "a", "nodes": [{"address": "a", "windows": [
        {"size": {"x": 16, "y": 16}, "viewports": [{"mesh": "C:\\dome\\LEFT.data",
         "projection": {"type": "FisheyeProjection"}}]}]}]})");
    input_ =
        folder_.write("in/w.json", R"({"wall": "w", "displays": [{"calibration": {"file": "c.json"}}]})");
    fs::create_directory_symlink(folder_.path("in"), folder_.path("elsewhere"));
    fs::create_symlink("left.data", folder_.path("in/linked.data"));
    wall_ = readWall(input_);
    const auto files = filesIn(folder_.path("in"));
    const std::string before = textOf(folder_.path("in/left.data"));
    for (const char* name : {"in/left", "elsewhere/left", "in/linked", "in/c", "in/w"}) {
        ConversionRequest request = requestFor(wall_, folder_.path("out"), ConvertedKind::bourke);
        request.paths = {folder_.path(std::string(name) + ".data")};
        request.wallPath = folder_.path(std::string(name) + ".json");
        EXPECT_THROW(convertWall(wall_, request), UsageError) << name;
    }
    EXPECT_EQ(filesIn(folder_.path("in")), files);
    EXPECT_EQ(textOf(folder_.path("in/left.data")), before);
}

TEST_F(Conversion, WhatTheInputOnlySeemsToNameIsOverwritten) {
    folder_.write("in/small.pfm", "of another wall");
    json named = json::parse(textOf(input_));
    named["wall"] = "small.pfm";
    wall_ = readWall(folder_.write("in/wall.json", named.dump()));
    ConversionRequest request = requestFor(wall_, folder_.path("in/other"), ConvertedKind::pfm);
    request.paths = {folder_.path("in/small.pfm")};
    EXPECT_NO_THROW(convertWall(wall_, request));
    EXPECT_THAT(textOf(folder_.path("in/small.pfm")), HasSubstr("PF"));
}

TEST_F(Conversion, DisplaysThatShowNothingAreRefused) {
    // Between the centres of two pixels there is something, so that it is read.
    input_ = folder_.write("in/h.obj",
                           "v 0.001 0.001\nv 0.0012 0.001\nv 0.001 0.0012\n"
                           "vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    wall_ = readWall(input_, glm::ivec2(64, 48));
    for (const ConvertedKind kind : {ConvertedKind::surfaceMap, ConvertedKind::cameraTexture,
                                     ConvertedKind::pfm, ConvertedKind::bourke, ConvertedKind::mpcdi})
        try {
            trip(kind);
            ADD_FAILURE() << extensionOf(kind);
        } catch (const UsageError& error) {
            EXPECT_THAT(error.what(), HasSubstr("shows nothing"));
        }
}

TEST_F(Conversion, ArchivesOfWideWallsHoldEveryDisplayApart) {
    json displays;
    const auto add = [&](int width, int height) {
        displays.push_back({{"name", std::to_string(displays.size())},
                            {"size", {width, height}},
                            {"projection",
                             {{"type", "frustum"},
                              {"left_deg", -30},
                              {"right_deg", 30},
                              {"down_deg", -20},
                              {"up_deg", 20}}}});
    };
    const auto write = [&] {
        input_ = folder_.write("in/wide.json", json{{"wall", "wide"}, {"displays", displays}}.dump());
        wall_ = readWall(input_);
    };
    for (int i = 0; i < 5; ++i) add(3840, 4 + i);
    add(16384, 2);
    write();
    expectStatedErrors(wall_, trip(ConvertedKind::mpcdi), 0.01);
    // Regions of a buffer within the limits of what reads them, none over another.
    pugi::xml_document manifest;
    ASSERT_TRUE(manifest.load_string(memberOf(folder_.path("out.mpcdi"), "mpcdi.xml").c_str()));
    const pugi::xml_node buffer = manifest.child("MPCDI").child("display").child("buffer");
    const glm::ivec2 bufferPx(buffer.attribute("Xresolution").as_int(),
                              buffer.attribute("Yresolution").as_int());
    EXPECT_EQ(bufferPx, glm::ivec2(16384, 7 + 8 + 2));
    struct Rectangle {
        glm::dvec2 low, high;
    };
    std::vector<Rectangle> regions;
    for (const pugi::xml_node region : buffer.children("region")) {
        const auto pixels = [&](const char* x, const char* y) {
            return glm::dvec2(bufferPx) *
                   glm::dvec2(region.attribute(x).as_double(), region.attribute(y).as_double());
        };
        const Rectangle placed{pixels("x", "y"), pixels("x", "y") + pixels("xsize", "ysize")};
        const glm::dvec2 size = placed.high - placed.low;
        EXPECT_NEAR(size.x, region.attribute("Xresolution").as_int(), 1e-6);
        EXPECT_NEAR(size.y, region.attribute("Yresolution").as_int(), 1e-6);
        EXPECT_LE(placed.high.x, bufferPx.x + 1e-6);
        EXPECT_LE(placed.high.y, bufferPx.y + 1e-6);
        for (const Rectangle& other : regions)
            EXPECT_TRUE(placed.low.x > other.high.x - 1e-6 || placed.low.y > other.high.y - 1e-6 ||
                        other.low.x > placed.high.x - 1e-6 || other.low.y > placed.high.y - 1e-6);
        regions.push_back(placed);
    }
    EXPECT_EQ(regions.size(), wall_.displays.size());

    displays.clear();
    add(2, 16000);
    add(16384, 385);
    write();
    EXPECT_THROW(trip(ConvertedKind::mpcdi), UsageError);  // 16385 rows
}

TEST_F(Conversion, WallFilesWriteTheBackgroundAsItWasWritten) {
    std::mt19937 random(5);
    std::uniform_int_distribution<int> thousandths(0, 1000);
    for (int i = 0; i < 20; ++i) {
        std::vector<double> background;
        for (int c = 0; c < 3; ++c) background.push_back(thousandths(random) / 1000.0);
        json wall = json::parse(textOf(input_));
        wall["background"] = background;
        input_ = folder_.write("in/wall.json", wall.dump());
        wall_ = readWall(input_);
        EXPECT_EQ(trip(ConvertedKind::pfm).read.background, wall_.background);
        EXPECT_EQ(json::parse(textOf(folder_.path("out.json")))["background"].dump(),
                  json(background).dump());
    }
}

TEST_F(Conversion, WhatFailsLeavesNothingBehind) {
    fs::create_directories(folder_.path("out/wall.json"));  // no file can be moved there
    ConversionRequest request = requestFor(wall_, folder_.path("out/wall"), ConvertedKind::pfm);
    EXPECT_THROW(convertWall(wall_, request), std::runtime_error);
    for (const std::string& name : filesIn(folder_.path("out"))) EXPECT_FALSE(name.starts_with(".")) << name;
    request = requestFor(wall_, folder_.path("missing/out"), ConvertedKind::pfm);
    EXPECT_THROW(convertWall(wall_, request), std::runtime_error);
    EXPECT_FALSE(fs::exists(folder_.path("missing")));
}

}  // namespace
}  // namespace curvewall
