#include "calibration/formats/display_names.h"

#include "calibration/formats/calibration_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <random>
#include <set>
#include <string>
#include <vector>

namespace curvewall {
namespace {

using testing::ElementsAre;

const std::string kKitchen =
    "K\xC3\xBC"
    "che";

TEST(DisplayNames, BytesThatAreNoUtf8AreLatin1) {
    EXPECT_EQ(validUtf8("plain\n"), "plain\n");
    EXPECT_EQ(validUtf8("K\xFC"
                        "che"),
              kKitchen);
    EXPECT_EQ(validUtf8(kKitchen), kKitchen);
    EXPECT_EQ(validUtf8("\xE5\xA3\x81 \xF0\x9F\x8C\x8D"), "\xE5\xA3\x81 \xF0\x9F\x8C\x8D");
    EXPECT_EQ(validUtf8("\xC0\xAF"), "\xC3\x80\xC2\xAF") << "overlong";
    EXPECT_EQ(validUtf8("\xED\xA0\x80"), "\xC3\xAD\xC2\xA0\xC2\x80") << "a surrogate";
    EXPECT_EQ(validUtf8("\xE5\xA3"), "\xC3\xA5\xC2\xA3") << "cut";
}

TEST(DisplayNames, WhateverTheBytesTheTextIsJson) {
    std::mt19937 random(7);
    for (int round = 0; round < 20000; ++round) {
        std::string bytes(random() % 8, '\0');
        // Mostly beyond ASCII, where sequences begin and go on.
        for (char& byte : bytes)
            byte = static_cast<char>(random() % 4 == 0 ? random() : 0x80 + random() % 128);
        const std::string valid = validUtf8(bytes);
        ASSERT_NO_THROW((void)nlohmann::json(valid).dump());
        ASSERT_EQ(validUtf8(valid), valid);
        const std::string name = safeDisplayName(bytes);
        ASSERT_NO_THROW((void)nlohmann::json(name).dump());
        ASSERT_FALSE(name.empty());
        ASSERT_EQ(name.find_first_of("/\\\n\x7F"), std::string::npos);
    }
}

TEST(DisplayNames, NamesArePartsOfFileNames) {
    EXPECT_EQ(safeDisplayName("a/b\\c\n\x7F"), "a_b_c__");
    EXPECT_EQ(safeDisplayName("a\x85"
                              "b"),
              "a_b")
        << "next line in Latin-1, a control character";
    EXPECT_EQ(safeDisplayName(""), "display");
    std::set<std::string> taken;
    std::vector<std::string> names;
    for (const char* name : {"a", "a-2", "a", "a", "b"}) names.push_back(uniqueName(name, taken));
    EXPECT_THAT(names, ElementsAre("a", "a-2", "a-3", "a-4", "b"));
}

Wall read(const FileBytes& file, CalibrationRequest request = {}) {
    Decisions decisions;
    return readCalibration(
        file, [](const std::string&) { return std::nullopt; }, request, decisions);
}

TEST(DisplayNames, OfFilesInLatin1AreUtf8) {
    const FileBytes region{"w\xE4nde.mpcdi.xml",
                           "<MPCDI profile='3d'><display><buffer><region id='K\xFC"
                           "che' xResolution='8' yResolution='8'><frustum><rightAngle>30</rightAngle>"
                           "<leftAngle>-30</leftAngle><upAngle>20</upAngle><downAngle>-20</downAngle>"
                           "</frustum></region></buffer></display></MPCDI>"};
    EXPECT_EQ(read(region).displays.at(0).name, kKitchen);
    EXPECT_EQ(read(region, {.display = kKitchen}).displays.size(), 1U) << "asked for by its name";
    EXPECT_EQ(read(region).name, "w\xC3\xA4nde.mpcdi");
    const FileBytes camera{
        "K\xFC"
        "che.yml",
        "K: [100, 0, 50, 0, 100, 50, 0, 0, 1]\nsize: [100, 100]\n"};
    EXPECT_EQ(read(camera).displays.at(0).name, kKitchen);
    const FileBytes mesh{
        "K\xFC"
        "che.obj",
        "v -1 -1\nv 1 -1\nv 1 1\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n"};
    EXPECT_EQ(read(mesh).displays.at(0).name, kKitchen);
    EXPECT_EQ(read(mesh).name, kKitchen);
}

TEST(DisplayNames, WhatDecisionsListIsUtf8) {
    Decisions decisions;
    decisions.text("file",
                   "K\xFC"
                   "che",
                   "\xFC");
    decisions.warn("\xFC");
    EXPECT_EQ(decisions.taken().at(0).value, kKitchen);
    EXPECT_EQ(decisions.taken().at(0).evidence, "\xC3\xBC");
    EXPECT_EQ(decisions.warnings().at(0), "\xC3\xBC");
}

}  // namespace
}  // namespace curvewall
