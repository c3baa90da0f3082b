#include "calibration/formats/sgct_file.h"

#include "calibration/errors.h"
#include "calibration/files/map_file.h"
#include "tests/support/temporary_folder.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace curvewall {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// A 90 degree view ahead on one window of 64 x 32 pixels, with what is given added to the viewport.
std::string viewportOf(const std::string& more = "") {
    return R"({"projection": {"type": "PlanarProjection", "fov": {"hfov": 90, "vfov": 90}})" + more + "}";
}
std::string windowOf(const std::string& viewports, const std::string& more = "") {
    return R"({"size": {"x": 64, "y": 32}, "viewports": [)" + viewports + "]" + more + "}";
}
std::string configuration(const std::string& windows, const std::string& more = "") {
    return R"({"version": 1, "masteraddress": "a", "nodes": [{"address": "a", "port": 1, "windows": [)" +
           windows + "]}]" + more + "}";
}

class SgctFile : public ::testing::Test {
protected:
    Wall read(const std::string& text) {
        const FileBytes file{"dome.json", text};
        const FindFile find = [this](const std::string& name) -> std::optional<FileBytes> {
            const auto found = files_.find(bareName(name));
            if (found == files_.end()) return std::nullopt;
            return FileBytes{bareName(name), found->second};
        };
        return readSgctFile(file, find, request_, decisions_);
    }
    std::string complaintAbout(const std::string& text) {
        try {
            read(text);
        } catch (const InputError& error) {
            return error.what();
        }
        return "nothing";
    }
    std::vector<std::string> namesOf(const std::string& text) {
        std::vector<std::string> names;
        for (const Display& display : read(text).displays) names.push_back(display.name);
        return names;
    }
    std::string png(glm::ivec2 sizePx, const std::vector<float>& grey) {
        const std::string path = folder_.path("picture.png");
        writePng16(path, {sizePx, 1, true, grey});
        return readFile(path, "a picture").bytes;
    }

    test::TemporaryFolder folder_;
    std::map<std::string, std::string> files_;
    CalibrationRequest request_;
    Decisions decisions_;
};

void expectRay(const Display& display, glm::dvec2 px, glm::dvec3 truth, double tolerance = 1e-9) {
    const auto ray = display.projection->unproject(px);
    ASSERT_TRUE(ray) << px.x << ", " << px.y;
    EXPECT_LT(glm::distance(glm::normalize(*ray), glm::normalize(truth)), tolerance)
        << ray->x << ", " << ray->y << ", " << ray->z;
}

TEST_F(SgctFile, NamesDisplaysAfterWhatTellsThemApart) {
    const std::string one = viewportOf();
    EXPECT_THAT(namesOf(configuration(windowOf(one))), ElementsAre("dome"));
    EXPECT_THAT(namesOf(configuration(windowOf(one) + "," + windowOf(one, R"(, "name": "up/there")"))),
                ElementsAre("window1", "up_there"));
    EXPECT_THAT(namesOf(configuration(windowOf(one + "," + one))), ElementsAre("viewport1", "viewport2"));
    EXPECT_THAT(namesOf(configuration(windowOf(one + "," + one) + "," + windowOf(one))),
                ElementsAre("window1-viewport1", "window1-viewport2", "window2"));
    EXPECT_THAT(namesOf(R"({"nodes": [{"address": "10.0.0.1", "windows": [)" + windowOf(one) +
                        R"(]}, {"address": "10.0.0.2", "windows": [)" + windowOf(one) + "]}]}"),
                ElementsAre("10.0.0.1", "10.0.0.2"));
}

TEST_F(SgctFile, GivesNoNameTwice) {
    EXPECT_THAT(namesOf(configuration(windowOf(viewportOf(), R"(, "name": "a/b")") + "," +
                                      windowOf(viewportOf(), R"(, "name": "a_b")"))),
                ElementsAre("a_b", "a_b-2"));
}

TEST_F(SgctFile, GivesNamesInUtf8) {
    const std::string xml =
        "<Cluster><Node address=\"a\"><Window name=\"K\xFCppel\"><Size x=\"64\" y=\"32\"/>"
        "<Viewport/></Window><Window name=\"b\x7F\"><Size x=\"64\" y=\"32\"/><Viewport/>"
        "</Window></Node></Cluster>";
    EXPECT_THAT(namesOf(xml), ElementsAre("K\xC3\xBCppel", "b_"));
}

TEST_F(SgctFile, CutsWindowsIntoViewportsFromTheBottomLeftWithoutLosingAPixel) {
    std::string viewports;
    for (const char* place :
         {R"({"x": 0, "y": 0})", R"({"x": 0.33333, "y": 0})", R"({"x": 0.66666, "y": 0.5})"})
        viewports += std::string(viewports.empty() ? "" : ",") +
                     viewportOf(std::string(R"(, "size": {"x": 0.33333, "y": 0.5}, "pos": )") + place);
    const Wall wall =
        read(configuration(R"({"size": {"x": 192, "y": 80}, "viewports": [)" + viewports + "]}"));
    for (const Display& display : wall.displays) EXPECT_EQ(display.sizePx, glm::ivec2(64, 40));
}

TEST_F(SgctFile, TakesTheFramebufferForTheSizeOfAWindow) {
    const Wall wall = read(configuration(windowOf(viewportOf(), R"(, "res": {"x": 4096, "y": 1024})")));
    EXPECT_EQ(wall.displays[0].sizePx, glm::ivec2(4096, 1024));
}

TEST_F(SgctFile, LeavesOutWhatShowsNothing) {
    const std::string window = windowOf(viewportOf() + "," + viewportOf(R"(, "size": {"x": 0, "y": 1})"));
    const Wall wall = read(configuration(window + "," + windowOf(viewportOf(), R"(, "draw3d": false)")));
    EXPECT_EQ(wall.displays.size(), 1U);
    EXPECT_THAT(wall.displays[0].warnings, Contains(HasSubstr("nodes[0].windows[1].draw3d")));
    EXPECT_THAT(complaintAbout(R"({"nodes": []})"), HasSubstr("a viewport that shows something, found none"));
}

TEST_F(SgctFile, PutsTheEyeWhereTheUserIsUnlessAskedOtherwise) {
    const std::string text = configuration(
        R"({"size": {"x": 64, "y": 32}, "viewports": [{"projection": {"type": "ProjectionPlane",
            "lowerleft": {"x": -2, "y": -1, "z": 0}, "upperleft": {"x": -2, "y": 1, "z": 0},
            "upperright": {"x": 2, "y": 1, "z": 0}}}]})",
        R"(, "users": [{"name": "other", "pos": {"x": 9, "y": 9, "z": 9}}, {"pos": {"x": 0, "y": 0, "z": 4}}])");
    Wall wall = read(text);
    EXPECT_EQ(wall.eyeM, glm::dvec3(0, 0, 4));
    EXPECT_THAT(wall.displays[0].warnings, IsEmpty());
    expectRay(wall.displays[0], {64, 0}, {2, 1, -4});
    request_.eyeM = {1, 0, 2};
    wall = read(text);
    EXPECT_EQ(wall.eyeM, glm::dvec3(1, 0, 2));
    EXPECT_THAT(wall.displays[0].warnings, Contains(HasSubstr("the eye (1, 0, 2) was asked for")));
    expectRay(wall.displays[0], {64, 0}, {1, 1, -2});
}

TEST_F(SgctFile, TakesOneEyeOfStereoWindows) {
    const std::string text =
        configuration(windowOf(viewportOf(R"(, "eye": "left")"), R"(, "stereo": "side_by_side")"),
                      R"(, "users": [{"eyeseparation": 0.5}])");
    Wall wall = read(text);
    EXPECT_EQ(wall.displays[0].sizePx, glm::ivec2(32, 32));
    EXPECT_EQ(wall.eyeM, glm::dvec3(0));
    EXPECT_THAT(wall.displays[0].warnings, Contains(HasSubstr("side_by_side is for two eyes")));
    EXPECT_THAT(wall.displays[0].warnings, Contains(HasSubstr("for the left eye")));
    decisions_ = Decisions(json{{"stereo_eye", "right"}, {"distance_m", 2}});
    wall = read(text);
    EXPECT_EQ(wall.eyeM, glm::dvec3(0.25, 0, 0));
    expectRay(wall.displays[0], {32, 16}, {2 - 0.25, 0, -2});
    decisions_.refuseUnusedKeys();
}

TEST_F(SgctFile, MirrorsThePictureAndTheMaskOfAWindow) {
    files_["mask.png"] = png({2, 2}, {0, 0.25f, 0.5f, 1});
    decisions_ = Decisions(json{{"blend_gamma", 1}});
    const Wall wall = read(configuration(
        R"({"size": {"x": 2, "y": 2}, "mirrorx": true, "mirrory": true, "viewports": [{"projection":
            {"type": "PlanarProjection", "fov": {"left": 45, "right": 0, "up": 45, "down": 0}},
            "blendmask": "mask.png"}]})"));
    expectRay(wall.displays[0], {0, 0}, {0, 0, -1});
    expectRay(wall.displays[0], {2, 2}, {-1, 1, -1});
    const auto& alpha = wall.displays[0].blend->alpha;
    EXPECT_NEAR(alpha[0].r, 1, 1e-4);
    EXPECT_NEAR(alpha[1].r, 0.5, 1e-4);
    EXPECT_NEAR(alpha[2].r, 0.25, 1e-4);
    EXPECT_NEAR(alpha[3].r, 0, 1e-4);
}

TEST_F(SgctFile, MultipliesBlendAndBlackLevelMasks) {
    files_["mask.png"] = png({2, 1}, {0.5f, 1});
    const std::string text = configuration(
        R"({"size": {"x": 2, "y": 1}, "viewports": [)" +
        viewportOf(
            R"(, "blendmask": "D:\\masks\\mask.png", "blacklevelmask": "mask.png", "overlay": "logo.png")") +
        "]}");
    Wall wall = read(text);
    const float half = static_cast<float>(std::pow(0.5, 2.2));
    ASSERT_TRUE(wall.displays[0].blend);
    EXPECT_NEAR(wall.displays[0].blend->alpha[0].r, half * half, 1e-4);
    EXPECT_EQ(wall.displays[0].blend->alpha[1], glm::vec3(1));
    EXPECT_THAT(wall.displays[0].blend->beta, IsEmpty());
    EXPECT_THAT(wall.displays[0].warnings, ElementsAre(HasSubstr("overlay: logo.png is not drawn")));
    decisions_ = Decisions(json{{"black_level", "add"}, {"blend_gamma", 1}});
    wall = read(text);
    EXPECT_NEAR(wall.displays[0].blend->alpha[0].r, 0.5, 1e-4);
    EXPECT_NEAR(wall.displays[0].blend->beta[0].r, 0.5, 1e-4);
}

TEST_F(SgctFile, TellsWhichDisplayMissesWhichFile) {
    const std::string text = configuration(windowOf(viewportOf(R"(, "mesh": "C:/there/left.sgc")")) + "," +
                                           windowOf(viewportOf()));
    EXPECT_THAT(complaintAbout(text),
                HasSubstr("dome.json: nodes[0].windows[0].viewports[0].mesh: expected the file "
                          "\"C:/there/left.sgc\" of display \"window1\""));
    request_.display = "window2";
    EXPECT_EQ(read(text).displays.size(), 1U);
    request_.display = "window3";
    EXPECT_THAT(complaintAbout(text),
                HasSubstr(R"(a display of "window1", "window2", found "window3" asked for)"));
}

// A square mesh on the whole screen, the picture turned upside down.
constexpr const char* kUpsideDown =
    "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 1\nvt 1 1\nvt 1 0\nvt 0 0\n"
    "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";

TEST_F(SgctFile, BendsThePictureByItsMesh) {
    files_["flip.obj"] = kUpsideDown;
    const Wall wall = read(configuration(windowOf(viewportOf(R"(, "mesh": "meshes/flip.obj")"))));
    EXPECT_EQ(wall.displays[0].projectionType, "warp_mesh");
    expectRay(wall.displays[0], {64, 8}, {1, -0.5, -1});
}

std::string littleEndian(const std::vector<uint32_t>& words) {
    std::string bytes;
    for (const uint32_t word : words)
        for (int i = 0; i < 4; ++i) bytes += static_cast<char>(word >> (8 * i) & 0xff);
    return bytes;
}
uint32_t wordOf(double number) { return std::bit_cast<uint32_t>(static_cast<float>(number)); }

// One square that covers the screen with the whole of a picture.
std::string sgc(double upDeg, double downDeg, double leftDeg, double rightDeg) {
    std::vector<uint32_t> words{0};
    for (const double number : {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, upDeg, downDeg, leftDeg, rightDeg})
        words.push_back(wordOf(number));
    words.insert(words.end(), {2, 2});
    for (const glm::dvec2 at : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1, 1)})
        for (const double number : {at.x, at.y, 0.0, at.x, 1 - at.y, 0.0}) words.push_back(wordOf(number));
    words.insert(words.end(), {4, 0, 2, 1, 3});
    return "SGC\x01" + littleEndian(words);
}

TEST_F(SgctFile, TakesTheFrustumOfAnSgcMeshAndTellsWhereTheConfigurationDiffers) {
    files_["wall.sgc"] = sgc(30, -10, -45.02, 45.005);
    const Wall wall = read(configuration(windowOf(viewportOf(R"(, "mesh": "wall.sgc")"))));
    const Display& display = wall.displays[0];
    expectRay(display, {0, 0}, {-std::tan(glm::radians(45.02)), std::tan(glm::radians(30.0)), -1}, 1e-6);
    ASSERT_THAT(
        display.warnings,
        Contains(HasSubstr(
            "nodes[0].windows[0].viewports[0].projection: wall.sgc is "
            "made for another frustum, which is taken: left -45.020 instead of -45.000 degrees, down -10.000 "
            "instead of -45.000 degrees, up 30.000 instead of 45.000 "
            "degrees")));
    EXPECT_THAT(display.warnings, Not(Contains(HasSubstr("right 45"))));  // 0.005 degrees are the same
    EXPECT_THAT(display.warnings, Not(Contains(HasSubstr("turned"))));
}

TEST_F(SgctFile, NeedsNoProjectionBesideAnSgcMesh) {
    files_["wall.sgc"] = sgc(30, -10, -45, 45);
    const Wall wall = read(configuration(windowOf(R"({"mesh": "wall.sgc"})")));
    EXPECT_THAT(wall.displays[0].warnings, IsEmpty());
    expectRay(wall.displays[0], {64, 32}, {1, -std::tan(glm::radians(10.0)), -1}, 1e-6);
}

TEST_F(SgctFile, ShowsSgctsUsualViewWithoutAProjection) {
    expectRay(read(configuration(windowOf("{}"))).displays[0], {64, 0}, {1, 1, -2});
}

// 2 x 2 nodes; the first row of the file comes first.
std::string pfm(glm::ivec2 nodes, const std::vector<glm::dvec2>& values) {
    std::vector<uint32_t> words;
    for (const glm::dvec2 value : values)
        for (const double number : {value.x, value.y, 0.0}) words.push_back(wordOf(number));
    return fmt::format("PF\n{} {}\n-1.0\n", nodes.x, nodes.y) + littleEndian(words);
}

TEST_F(SgctFile, ReadsTheLeftHalfOfAPfmMeshAsPositionsOnTheScreen) {
    // Two eyes of 2 x 2 nodes each. Those of the left eye lie where a picture without a mesh has the centres
    // of its four quarters, shifted up by an eighth.
    const std::vector<glm::dvec2> values{{0.25, 0.875}, {0.75, 0.875}, {0, 0}, {0, 0},
                                         {0.25, 0.375}, {0.75, 0.375}, {0, 0}, {0, 0}};
    files_["warp.pfm"] = pfm({4, 2}, values);
    const Wall wall = read(configuration(windowOf(viewportOf(R"(, "mesh": "warp.pfm")"))));
    EXPECT_EQ(wall.displays[0].projectionType, "warp_mesh");
    expectRay(wall.displays[0], {16, 4}, {-0.5, 0.5, -1}, 1e-6);   // the first node
    expectRay(wall.displays[0], {48, 20}, {0.5, -0.5, -1}, 1e-6);  // the last one
    expectRay(wall.displays[0], {32, 12}, {0, 0, -1}, 1e-6);
}

TEST_F(SgctFile, ReadsThePfmOfATextureMappedProjectionAsPositionsInThePicture) {
    // The screen's corners, from the top left one, show the picture's left half.
    files_["map.pfm"] = pfm({2, 2}, {{0, 1}, {0.5, 1}, {0, 0}, {0.5, 0}});
    const std::string viewport =
        R"({"projection": {"type": "TextureMappedProjection", "fov": {"hfov": 90, "vfov": 90}})";
    const Wall wall = read(configuration(windowOf(viewport + R"(, "mesh": "map.pfm"})")));
    expectRay(wall.displays[0], {0, 0}, {-1, 1, -1}, 1e-6);
    expectRay(wall.displays[0], {64, 0}, {0, 1, -1}, 1e-6);
    expectRay(wall.displays[0], {0, 32}, {-1, -1, -1}, 1e-6);
    EXPECT_THAT(complaintAbout(configuration(windowOf(viewport + "}"))),
                HasSubstr("mesh: expected the map of a TextureMappedProjection"));
}

std::map<std::string, std::string> assumed(const Display& display) {
    std::map<std::string, std::string> values;
    for (const Assumption& a : display.assumptions) values[a.key] = a.value;
    return values;
}

std::string evidenceOf(const Display& display, const std::string& key) {
    for (const Assumption& a : display.assumptions)
        if (a.key == key) return a.evidence;
    return "nothing";
}

TEST_F(SgctFile, ListsWhatSgctTakesForGrantedInPfmMaps) {
    const std::vector<glm::dvec2> values{{0.25, 0.875}, {0.75, 0.875}, {0, 0}, {0, 0},
                                         {0.25, 0.375}, {0.75, 0.375}, {0, 0}, {0, 0}};
    files_["warp.pfm"] = pfm({4, 2}, values);
    const std::string forward = configuration(windowOf(viewportOf(R"(, "mesh": "warp.pfm")")));
    Wall wall = read(forward);
    using Words = std::map<std::string, std::string>;
    EXPECT_EQ(assumed(wall.displays[0]), (Words{{"map_direction", "forward"},
                                                {"stereo_half", "left"},
                                                {"map_values", "absolute"},
                                                {"screen_y", "up"},
                                                {"row_order", "top_first"},
                                                {"node_alignment", "centers"},
                                                {"interpolation", "triangles_alternating"}}));
    EXPECT_THAT(evidenceOf(wall.displays[0], "row_order"), HasSubstr("0.875 on the average of the file's"));
    EXPECT_THAT(wall.displays[0].warnings, IsEmpty());

    decisions_ = Decisions(json{{"row_order", "bottom_first"}, {"screen_y", "down"}});
    wall = read(forward);
    expectRay(wall.displays[0], {16, 28}, {-0.5, -0.5, -1}, 1e-6);  // the first node
    EXPECT_THAT(wall.displays[0].warnings, IsEmpty());
    decisions_ = Decisions(json{{"row_order", "bottom_first"}});
    EXPECT_THAT(read(forward).displays[0].warnings, ElementsAre(HasSubstr("upside down")));

    decisions_ = Decisions(json{{"map_direction", "inverse"}, {"stereo_half", "left"}});
    wall = read(forward);
    EXPECT_EQ(wall.displays[0].projectionType, "camera_texture");
    expectRay(wall.displays[0], {0, 0}, {-0.5, 0.75, -1}, 1e-6);
    EXPECT_EQ(assumed(wall.displays[0]), (Words{{"map_direction", "inverse"},
                                                {"stereo_half", "left"},
                                                {"map_values", "absolute"},
                                                {"source_v", "up"},
                                                {"row_order", "top_first"},
                                                {"node_alignment", "corners"},
                                                {"interpolation", "bilinear"}}));
}

TEST_F(SgctFile, TakesTheHalfOfAPfmMeshThatIsAskedFor) {
    const std::vector<glm::dvec2> values{{0, 0}, {0, 0}, {0.25, 0.875}, {0.75, 0.875},
                                         {0, 0}, {0, 0}, {0.25, 0.375}, {0.75, 0.375}};
    files_["warp.pfm"] = pfm({4, 2}, values);
    decisions_ = Decisions(json{{"stereo_half", "right"}});
    const Wall wall = read(configuration(windowOf(viewportOf(R"(, "mesh": "warp.pfm")"))));
    expectRay(wall.displays[0], {16, 4}, {-0.5, 0.5, -1}, 1e-6);
}

// x in units of the height, on a screen of 2:1.
std::string bourke(double aspect) {
    std::string text = "2\n2 2\n";
    for (const double y : {-1.0, 1.0})
        for (const double x : {-aspect, aspect})
            text += fmt::format("{} {} {} {} 1\n", x, y, x > 0 ? 1 : 0, y > 0 ? 1 : 0);
    return text;
}

TEST_F(SgctFile, FillsTheSquareOfAFisheyeByABourkeMeshWhateverTheWindowsShape) {
    files_["mirror.data"] = bourke(1);
    const std::string fisheye = R"({"projection": {"type": "FisheyeProjection"}, "mesh": "mirror.data"})";
    const Wall wall = read(configuration(windowOf(fisheye)));
    // The square mesh lies in the middle of the wide screen, and the fisheye's circle fills it.
    const Display& display = wall.displays[0];
    EXPECT_FALSE(display.projection->unproject({15, 16}));
    expectRay(display, {32, 16}, {0, 1, 0}, 1e-9);
    expectRay(display, {47.999999, 16}, {1, 0, 0}, 1e-6);
    expectRay(display, {32, 31.999999}, {0, 0, -1}, 1e-6);
    EXPECT_THAT(display.warnings, Contains(HasSubstr("made for a screen 1.0000 times as wide as high")));
}

TEST_F(SgctFile, LaysTheFourMeshesOfASphericalMirrorOverOneAnother) {
    // Each mesh is a square of half the height beside the next one; the top one lies on the bottom one too.
    const auto square = [](double left, double bottom) {
        std::string text;
        for (const glm::dvec2 at : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)})
            text += fmt::format("v {} {} 0\nvt {} {}\n", left + at.x, bottom + at.y, at.x, at.y);
        return text + "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
    };
    files_["b.obj"] = square(-0.5, -1);
    files_["l.obj"] = square(-1.5, -1);
    files_["r.obj"] = square(0.5, -1);
    files_["t.obj"] = square(-0.5, -0.25);
    const Wall wall = read(configuration(windowOf(
        R"({"projection": {"type": "SphericalMirrorProjection", "tilt": 45, "geometry":
            {"bottom": "b.obj", "left": "l.obj", "right": "r.obj", "top": "t.obj"}}})")));
    // The screen is 64 x 32, 4 x 2 units; with 45 degrees of tilt the bottom mesh looks ahead.
    const Display& display = wall.displays[0];
    expectRay(display, {32, 28}, {0, -0.5, -1});  // a quarter above the lower border of the bottom mesh
    expectRay(display, {16, 24}, {-1, 0, 0});     // the middle of the left one
    expectRay(display, {48, 24}, {1, 0, 0});
    expectRay(display, {32, 12}, {0, 1, 0});      // the middle of the top one
    expectRay(display, {32, 18}, {0, 1, -0.75});  // where the top one covers the bottom one
    EXPECT_FALSE(display.projection->unproject({4, 4}));
}

TEST_F(SgctFile, ReadsXmlLikeJson) {
    const Wall wall = read(R"(<?xml version="1.0"?><Cluster masterAddress="a">
        <Scene><Orientation yaw="0" pitch="10" roll="0"/></Scene>
        <Node ip="10.0.0.9" port="1"><Window fullScreen="true"><Stereo type="none"/><Size x="200" y="100"/>
          <Viewport name="Channel 1"><Pos x="0" y="0"/><Size x="0.5" y="1"/>
            <PlanarProjection><FOV left="30" right="40" up="20" down="-5"/>
              <Orientation heading="90" pitch="0" roll="0"/></PlanarProjection></Viewport>
          <Viewport name="Channel 2"><Pos x="0.5" y="0"/><Size x="0.5" y="1"/>
            <Viewplane><Pos x="-1" y="-1" z="-1"/><Pos x="-1" y="1" z="-1"/><Pos x="1" y="1" z="-1"/></Viewplane>
          </Viewport></Window></Node>
        <User eyeSeparation="0.06"><Pos x="0" y="0" z="0"/></User></Cluster>)");
    ASSERT_EQ(wall.displays.size(), 2U);
    EXPECT_EQ(wall.displays[0].name, "Channel 1");
    EXPECT_EQ(wall.displays[0].sizePx, glm::ivec2(100, 100));
    // Down -5 is 5 degrees above the axis; a heading of 90 looks right.
    expectRay(wall.displays[0], {0, 100}, {1, std::tan(glm::radians(5.0)), -std::tan(glm::radians(30.0))});
    expectRay(wall.displays[1], {0, 0}, {-1, 1, -1});
    EXPECT_THAT(wall.displays[0].warnings, ElementsAre(HasSubstr("scene: ")));
}

TEST_F(SgctFile, PassesOverUnknownKeysAndSaysSo) {
    const Wall wall = read(configuration(
        R"({"size": {"x": 64, "y": 32}, "zoom": 2, "viewports": [{"projection": {"type": "FisheyeProjection",
            "fov": "180", "quality": "1k", "strength": 3}}]})",
        R"(, "externalcontrolport": 20500)"));
    EXPECT_THAT(
        wall.displays[0].warnings,
        ElementsAre("not known and passed over: nodes[0].windows[0].viewports[0].projection.strength, "
                    "nodes[0].windows[0].zoom"));
}

TEST_F(SgctFile, TakesTheFisheyesBackgroundForTheWalls) {
    const Wall wall = read(configuration(windowOf(
        R"({"projection": {"type": "FisheyeProjection", "background": {"r": 1, "g": 0.5, "b": 0, "a": 1}}})")));
    EXPECT_NEAR(wall.background.r, 1, 1e-6);
    EXPECT_NEAR(wall.background.g, 0.21404, 1e-5);
}

TEST_F(SgctFile, WarnsAtADisplayOnlyOfWhatConcernsIt) {
    const std::string copy = windowOf(viewportOf(), R"(, "blitwindowid": 1)");
    const Wall wall = read(configuration(windowOf(viewportOf()) + "," + copy + "," + copy + "," +
                                         windowOf(viewportOf(), R"(, "zoom": 2, "draw3d": false)")));
    ASSERT_EQ(wall.displays.size(), 3U);
    EXPECT_THAT(wall.displays[0].warnings,
                ElementsAre(HasSubstr("not known and passed over"), HasSubstr("windows[3].draw3d")));
    EXPECT_THAT(wall.displays[1].warnings, ElementsAre(HasSubstr("windows[1].blitwindowid")));
    EXPECT_THAT(wall.displays[2].warnings, ElementsAre(HasSubstr("windows[2].blitwindowid")));
}

TEST_F(SgctFile, TellsWhereAUserIsNotTheWalls) {
    const std::string viewports =
        viewportOf() + "," + viewportOf(R"(, "user": "guest")") + "," + viewportOf(R"(, "user": "nobody")");
    const Wall wall = read(configuration(
        windowOf(viewports), R"(, "users": [{}, {"name": "guest", "pos": {"x": 0, "y": 0, "z": 1}}])"));
    EXPECT_THAT(wall.displays[0].warnings, IsEmpty());
    EXPECT_THAT(wall.displays[1].warnings,
                ElementsAre(HasSubstr("viewports[1].user: \"guest\" is elsewhere")));
    EXPECT_THAT(wall.displays[2].warnings,
                ElementsAre(HasSubstr("viewports[2].user: no user is named \"nobody\"")));
}

TEST_F(SgctFile, RefusesMoreViewportsThanAnyWallHas) {
    const auto viewports = [](int count) {
        std::string list = viewportOf();
        for (int i = 1; i < count; ++i) list += "," + viewportOf();
        return list;
    };
    EXPECT_EQ(read(configuration(windowOf(viewports(256)))).displays.size(), 256U);
    EXPECT_THAT(complaintAbout(configuration(windowOf(viewports(128)) + "," + windowOf(viewports(129)))),
                HasSubstr("nodes[0].windows[1].viewports: expected at most 256 viewports in a configuration, "
                          "found 257"));
}

// The first window's file takes all that a wall may; the masks are not made then.
TEST_F(SgctFile, RefusesToSpendMoreMemoryThanAWallMay) {
    files_["warp.data"] = bourke(1);
    files_["mask.png"] = png({1, 1}, {0.5F});
    const std::string text = configuration(windowOf("", R"(, "mpcdi": "warp.data")") + "," +
                                           windowOf(viewportOf(R"(, "blendmask": "mask.png")")));
    request_.sizePx = {64, 64};
    EXPECT_EQ(read(text).displays.size(), 2U);
    request_.sizePx = {16384, 16384};
    EXPECT_THAT(complaintAbout(text),
                HasSubstr("nodes[0].windows[1].viewports[0].blendmask: expected maps and "
                          "blended displays of at most"));
}

TEST_F(SgctFile, ChargesTheIntensitiesOfMeshes) {
    files_["warp.data"] = bourke(1);
    files_["dims.data"] = "2\n2 2\n-1 -1 0 0 0.5\n1 -1 1 0 0.5\n-1 1 0 1 0.5\n1 1 1 1 0.5\n";
    request_.sizePx = {16384, 16384};
    for (const char* mesh : {"warp.data", "dims.data"})
        EXPECT_THAT(
            complaintAbout(configuration(windowOf("", R"(, "mpcdi": "warp.data")") + "," +
                                         windowOf(viewportOf(fmt::format(R"(, "mesh": "{}")", mesh))))),
            mesh == std::string("warp.data") ? HasSubstr("nothing") : HasSubstr("viewports[0].mesh"));
}

TEST_F(SgctFile, RefusesWhatItCannotUseWithThePlace) {
    const auto planar = [](const std::string& fov) {
        return configuration(windowOf(R"({"projection": {"type": "PlanarProjection", "fov": )" + fov + "}}"));
    };
    EXPECT_THAT(complaintAbout(planar(R"({"hfov": 80})")),
                HasSubstr("projection.fov.down: expected a number, or vfov"));
    EXPECT_THAT(complaintAbout(planar(R"({"hfov": "wide", "vfov": 20})")),
                HasSubstr("fov.hfov: expected a number"));
    EXPECT_THAT(complaintAbout(planar(R"({"hfov": 180, "vfov": 20})")), HasSubstr("below 180"));
    EXPECT_THAT(complaintAbout(planar(R"({"hfov": -80, "vfov": 20})")),
                HasSubstr("a screen that the eye can see"));
    EXPECT_THAT(complaintAbout(configuration(windowOf(R"({"projection": {"type": "Holodeck"}})"))),
                HasSubstr("projection.type: expected a projection that SGCT has, found \"Holodeck\""));
    EXPECT_THAT(complaintAbout(configuration(windowOf(viewportOf(R"(, "size": {"x": 1e-4, "y": 1})")))),
                HasSubstr("a viewport of 1 to 16384 pixels"));
    EXPECT_THAT(complaintAbout("{\"nodes\": [}"), HasSubstr("expected JSON"));
    EXPECT_THAT(complaintAbout("<Cluster><Node>"), HasSubstr("XML"));
}

TEST_F(SgctFile, IsKnownByItsContent) {
    EXPECT_TRUE(isSgctFile({"a", R"( {"nodes": []})"}));
    EXPECT_TRUE(isSgctFile({"a", "\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<Cluster masterAddress=\"x\"/>"}));
    EXPECT_FALSE(isSgctFile({"a.json", R"({"wall": "w", "displays": []})"}));
    EXPECT_FALSE(isSgctFile({"a.xml", "<MPCDI/>"}));
    EXPECT_FALSE(isSgctFile({"a", ""}));
}

}  // namespace
}  // namespace curvewall
