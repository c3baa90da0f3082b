#include "calibration/files/file_bytes.h"

#include "calibration/errors.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace curvewall {
namespace {

using testing::HasSubstr;

class FileBytesTest : public testing::Test {
protected:
    test::TemporaryFolder folder_;
};

TEST_F(FileBytesTest, ReadsEveryByteAndRefusesWhatIsNoFileOrTooLarge) {
    const std::string path = folder_.write("a.bin", std::string("x\0\ny", 4));
    EXPECT_EQ(readFile(path, "bytes").bytes, std::string("x\0\ny", 4));
    EXPECT_EQ(readFile(path, "bytes", 4).bytes.size(), 4U);
    EXPECT_THROW(readFile(path, "bytes", 3), InputError);
    EXPECT_THROW(readFile(path + ".none", "bytes"), InputError);
    EXPECT_THROW(readFile(std::filesystem::path(path).parent_path().string(), "bytes"), InputError);
}

TEST_F(FileBytesTest, NamesComeApartWhateverTheSystemThatWroteThem) {
    const FileBytes member{"walls/dome.mpcdi!Maps/Left.PFM", ""};
    EXPECT_EQ(member.name(), "Left.PFM");
    EXPECT_EQ(member.stem(), "Left");
    EXPECT_EQ(member.extension(), ".pfm");
    EXPECT_EQ(bareName("C:\\wall\\left.sgc"), "left.sgc");
}

TEST_F(FileBytesTest, FindsFilesBesideByPathThenByBareName) {
    std::filesystem::create_directory(folder_.path("mesh"));
    folder_.write("mesh/one.sgc", "one");
    folder_.write("Two.SGC", "two");
    const FindFile find = filesBeside(folder_.path("config.json"));
    EXPECT_EQ(find("mesh/one.sgc")->bytes, "one");
    EXPECT_EQ(find("C:/SGCT/config/two.sgc")->bytes, "two");
    EXPECT_EQ(find("C:\\SGCT\\config\\two.sgc")->bytes, "two");
    EXPECT_FALSE(find("three.sgc"));
    EXPECT_FALSE(find(""));
    EXPECT_FALSE(find("mesh"));
}

TEST_F(FileBytesTest, SaysWhichFilesItFound) {
    const std::string path = folder_.write("Two.SGC", "two");
    std::vector<std::string> opened;
    const FindFile find = filesBeside(folder_.path("config.json"), &opened);
    find("C:\\SGCT\\two.sgc");
    find("three.sgc");
    EXPECT_THAT(opened, testing::ElementsAre(path));
}

TEST_F(FileBytesTest, NeverLeavesTheFolder) {
    std::filesystem::create_directory(folder_.path("inner"));
    folder_.write("secret.txt", "outside");
    folder_.write("inner/config.json", "{}");
    const FindFile find = filesBeside(folder_.path("inner/config.json"));
    EXPECT_FALSE(find("../secret.txt"));
    EXPECT_FALSE(find(folder_.path("secret.txt")));
    EXPECT_FALSE(find("a/../../secret.txt"));
}

}  // namespace
}  // namespace curvewall
