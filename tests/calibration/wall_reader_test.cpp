#include "calibration/wall_reader.h"

#include "calibration/errors.h"
#include "tests/support/temporary_folder.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <string>

namespace curvewall {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

json validWall() {
    return json::parse(R"({"wall": "lab", "eye": [0.1, 0, 0], "background": [0.1, 0.2, 0.3], "displays": [
        {"name": "front", "size": [640, 480],
         "projection": {"type": "cylinder", "radius": 2, "arc_deg": 180, "height": 3}},
        {"name": "side", "size": [320, 200],
         "projection": {"type": "planar", "lower_left": [1, -1, -1], "lower_right": [1, -1, 1], "upper_left": [1, 1, -1],
                        "center": [1, 0, 0], "yaw_deg": 90}}]})");
}

class WallReader : public ::testing::Test {
protected:
    Wall read(const std::string& text) {
        std::ofstream(path()) << text;
        return readWall(path());
    }
    std::string path() const { return folder_.path("wall.json"); }
    std::string complaintAbout(const std::string& text) {
        try {
            read(text);
        } catch (const InputError& error) {
            return error.what();
        }
        return "nothing";
    }

private:
    test::TemporaryFolder folder_;
};

TEST_F(WallReader, ReadsEveryField) {
    const Wall wall = read(validWall().dump());
    EXPECT_EQ(wall.name, "lab");
    EXPECT_EQ(wall.eyeM, glm::dvec3(0.1, 0, 0));
    EXPECT_EQ(wall.background, glm::vec3(0.1f, 0.2f, 0.3f));
    ASSERT_EQ(wall.displays.size(), 2u);
    EXPECT_EQ(wall.displays[0].projectionType, "cylinder");
    EXPECT_EQ(wall.displays[0].sizePx, glm::ivec2(640, 480));
    // Half a turn: the left border looks to the left. The ray starts at the eye.
    EXPECT_NEAR(glm::distance(*wall.displays[0].projection->unproject({0, 240}), glm::dvec3(-2.1, 0, 0)), 0,
                1e-12);
    // Turned to the right by 90 degrees about the origin, then moved to the centre.
    EXPECT_NEAR(glm::distance(*wall.displays[1].projection->unproject({0, 0}), glm::dvec3(1.9, 1, 1)), 0,
                1e-12);
}

TEST_F(WallReader, EveryShippedWallLoads) {
    int walls = 0;
    for (const auto& entry : std::filesystem::directory_iterator(CURVEWALL_SOURCE_DIR "/configs")) {
        if (entry.path().extension() != ".json" || entry.path().filename() == "daemon.json") continue;
        EXPECT_NO_THROW(readWall(entry.path().string())) << entry.path();
        ++walls;
    }
    EXPECT_GE(walls, 11);
}

TEST_F(WallReader, ErrorsNameTheFileTheFieldAndWhatWasExpected) {
    struct Case {
        std::string pointer, value, field, expected;
    };
    const std::vector<Case> cases{
        {"/wall", "3", "wall", "a string"},
        {"/wall", "\"\"", "wall", "a name"},
        {"/eye", "[0, 0]", "eye", "a list of 3 numbers"},
        {"/eye/1", "\"x\"", "eye[1]", "a number"},
        {"/background/0", "2", "background[0]", "a number from 0 to 1"},
        {"/displays", "[]", "displays", "one entry at least"},
        {"/displays", "{}", "displays", "one entry at least"},
        {"/displays/0", "7", "displays[0]", "an object"},
        {"/displays/0/name", "\"\"", "displays[0].name", "a name"},
        {"/displays/0/name", "\"../front\"", "displays[0].name", "without slashes"},
        {"/displays/1/name", "\"front\"", "displays[1].name", "a name of its own"},
        {"/displays/0/size", "[640]", "displays[0].size", "a list of 2 numbers"},
        {"/displays/0/size/1", "0", "displays[0].size[1]", "a whole number from 1 to 16384"},
        {"/displays/0/size/0", "640.5", "displays[0].size[0]", "a whole number"},
        {"/displays/0/projection", "[]", "displays[0].projection", "an object"},
        {"/displays/0/projection/type", "\"cone\"", "displays[0].projection.type", "one of camera, camera_texture, curvilinear"},
        {"/displays/0/projection/radius", "-1", "displays[0].projection.radius", "above 0"},
        {"/displays/0/projection/radius", "0", "displays[0].projection.radius", "above 0"},
        {"/displays/0/projection/radius", "1e999", "", "JSON"},
        {"/displays/0/projection/arc_deg", "1440.1", "displays[0].projection.arc_deg", "at most 1440"},
        {"/displays/0/projection/height", "null", "displays[0].projection.height", "a number"},
        {"/displays/0/projection/yaw_deg", "true", "displays[0].projection.yaw_deg", "a number"},
        {"/eye/0", "2.5", "displays[0].projection", "the eye is not inside the cylinder"},
        {"/displays/1/projection/lower_right", "[1, -1, -1]", "displays[1].projection", "span an area"},
    };
    for (const Case& c : cases) {
        json changed = validWall();
        changed[json::json_pointer(c.pointer)] = "@";
        std::string text = changed.dump();
        text.replace(text.find("\"@\""), 3, c.value);
        const std::string complaint = complaintAbout(text);
        EXPECT_THAT(complaint, HasSubstr(path() + ": " + c.field));
        EXPECT_THAT(complaint, HasSubstr(c.expected));
    }
}

TEST_F(WallReader, MissingFieldsAreNamed) {
    for (const char* pointer :
         {"/wall", "/displays", "/displays/0/name", "/displays/0/size", "/displays/0/projection",
          "/displays/0/projection/type", "/displays/0/projection/radius", "/displays/0/projection/arc_deg",
          "/displays/0/projection/height", "/displays/1/projection/upper_left"}) {
        const json::json_pointer place(pointer);
        json changed = validWall();
        changed[place.parent_pointer()].erase(place.back());
        EXPECT_THAT(complaintAbout(changed.dump()), HasSubstr(place.back() + ": expected")) << pointer;
    }
}

TEST_F(WallReader, UnknownAndRepeatedKeysAreErrors) {
    for (const char* pointer : {"/gamma", "/displays/0/blending", "/displays/0/projection/arc"}) {
        json changed = validWall();
        changed[json::json_pointer(pointer)] = 1;
        EXPECT_THAT(complaintAbout(changed.dump()), HasSubstr("only the keys")) << pointer;
    }
    EXPECT_THAT(complaintAbout(R"({"wall": "a", "wall": "b"})"), HasSubstr("wall"));
}

TEST_F(WallReader, WhatIsNotJsonIsSaidToBeSo) {
    for (const char* text : {"", "{", "[1, 2", "{\"wall\": }", "\x89PNG\r\n", "{\"wall\": \"\xff\"}"})
        EXPECT_THAT(complaintAbout(text), HasSubstr("expected JSON")) << text;
    EXPECT_THAT(complaintAbout("[]"), HasSubstr("expected an object"));
    EXPECT_THROW(readWall(path() + ".none"), InputError);
    EXPECT_THROW(readWall("/"), InputError);
}

}  // namespace
}  // namespace curvewall
