#include "calibration/files/zip_archive.h"

#include "calibration/errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>
#include <zip.h>

namespace curvewall {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Members = std::vector<std::pair<std::string, std::string>>;

// As another library writes it.
FileBytes archiveOf(const Members& members) {
    zip_error_t error;
    zip_source_t* target = zip_source_buffer_create(nullptr, 0, 0, &error);
    zip_source_keep(target);
    zip_t* zip = zip_open_from_source(target, ZIP_TRUNCATE, &error);
    for (const auto& [name, bytes] : members)
        zip_file_add(zip, name.c_str(), zip_source_buffer(zip, bytes.data(), bytes.size(), 0),
                     ZIP_FL_ENC_UTF_8);
    EXPECT_EQ(zip_close(zip), 0);
    zip_stat_t stat;
    zip_source_stat(target, &stat);
    FileBytes file{"wall.mpcdi", std::string(stat.size, '\0')};
    zip_source_open(target);
    zip_source_read(target, file.bytes.data(), file.bytes.size());
    zip_source_close(target);
    zip_source_free(target);
    return file;
}

std::string complaint(const std::function<void()>& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no complaint";
}

TEST(ZipArchive, MembersAreFoundByExactNameAndThenByBareNameInAnyCase) {
    const FileBytes file =
        archiveOf({{"maps/a.pfm", "first"}, {"A.pfm", "second"}, {"deep/er/Left.PNG", "third"}});
    ASSERT_TRUE(isZip(file.bytes));
    const FindFile find = ZipArchive(file).files();
    EXPECT_EQ(find("maps/a.pfm")->bytes, "first");
    EXPECT_EQ(find("A.pfm")->bytes, "second");
    EXPECT_EQ(find("elsewhere\\left.png")->bytes, "third");
    EXPECT_EQ(find("left.png")->path, "wall.mpcdi!deep/er/Left.PNG");
    EXPECT_FALSE(find("b.pfm"));
    EXPECT_FALSE(find(""));
}

TEST(ZipArchive, LargeMembersComeBackWhole) {
    std::mt19937 random(3);
    std::string bytes(5'000'001, '\0');
    for (char& c : bytes) c = static_cast<char>(random() & 0x3f);
    EXPECT_EQ(ZipArchive(archiveOf({{"x", bytes}})).files()("x")->bytes, bytes);
}

TEST(ZipArchive, NamesThatLeadOutMatchNothingAndAreRefused) {
    const ZipArchive archive(
        archiveOf({{"../evil", "x"}, {"a/../../evil", "y"}, {"/etc/evil", "z"}, {"in", "w"}}));
    EXPECT_THAT(archive.names(), ElementsAre("in"));
    for (const char* name : {"../evil", "a/../../evil", "/etc/evil", "..", "a\\..\\in", "C:\\in", "\\in"})
        EXPECT_THAT(complaint([&] { archive.files()(name); }), HasSubstr("inside of the archive")) << name;
    EXPECT_FALSE(archive.files()("evil"));
    EXPECT_EQ(archive.files()("..in/in")->bytes, "w") << "a name may begin with two dots";
}

TEST(ZipArchive, BombsAreRefusedBeforeTheyUnpack) {
    // 700 MiB of zeros in less than a megabyte.
    const std::string zeros(size_t{700} << 20, '\0');
    const FileBytes bomb = archiveOf({{"mpcdi.xml", zeros}});
    EXPECT_LT(bomb.bytes.size(), size_t{1} << 20);
    EXPECT_THAT(complaint([&] { ZipArchive archive(bomb); }), HasSubstr("together"));
    Members many;
    for (int i = 0; i < 4097; ++i) many.emplace_back(std::to_string(i), "");
    EXPECT_THAT(complaint([&] { ZipArchive archive(archiveOf(many)); }), HasSubstr("at most 4096 members"));
}

TEST(ZipArchive, DamagedArchivesAreRefusedOrRead) {
    const FileBytes whole = archiveOf({{"mpcdi.xml", "<MPCDI/>"}, {"a.pfm", std::string(300, 'a')}});
    for (size_t size = 1; size < whole.bytes.size(); ++size) {
        const FileBytes cut{whole.path, whole.bytes.substr(0, size)};
        EXPECT_THAT(complaint([&] { ZipArchive archive(cut); }), HasSubstr("a ZIP archive")) << size;
    }
    std::mt19937 random(5);
    for (int round = 0; round < 3000; ++round) {
        FileBytes damaged = whole;
        for (int i = 0; i < 3; ++i)
            damaged.bytes[random() % damaged.bytes.size()] = static_cast<char>(random());
        complaint([&] {
            const ZipArchive archive(damaged);
            for (const std::string& name : archive.names()) {
                const auto file = archive.files()(name);
                ASSERT_TRUE(file);
                EXPECT_LE(file->bytes.size(), 1000u);
            }
        });
    }
}

}  // namespace
}  // namespace curvewall
