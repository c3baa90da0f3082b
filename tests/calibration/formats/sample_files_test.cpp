// docs/sample-files.md says what becomes of every real file; the readers have to agree.

#include "calibration/errors.h"
#include "calibration/readers/wall_reader.h"
#include "tests/support/sample_paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>

namespace curvewall {
namespace {

namespace fs = std::filesystem;

constexpr size_t kFewest = 100;

// "| file | outcome |" by file.
std::map<std::string, std::string> tableRows() {
    std::map<std::string, std::string> rows;
    std::ifstream in(CURVEWALL_SOURCE_DIR "/docs/sample-files.md");
    for (std::string line; std::getline(in, line);) {
        const size_t middle = line.find(" | ");
        if (!line.starts_with("| ") || middle == std::string::npos || !line.ends_with(" |")) continue;
        rows[line.substr(2, middle - 2)] = line.substr(middle + 3, line.size() - middle - 5);
    }
    std::erase_if(rows, [](const auto& row) {
        return !row.second.starts_with("read: ") && !row.second.starts_with("refused: ");
    });
    return rows;
}

// As scripts/sample-files writes it: without the folder that the file is in, bars escaped.
std::string outcomeOf(const fs::path& path) {
    try {
        return "read: " + std::to_string(readWall(path.string()).displays.size());
    } catch (const InputError& error) {
        std::string message = error.what();
        for (const std::string& prefix : {path.string() + ": ", test::samplesFolder().string() + "/"})
            for (size_t at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
                message.erase(at, prefix.size());
        return "refused: " + message;
    }
}

TEST(SampleFiles, AreReadOrRefusedAsTheTableSays) {
    if (!fs::is_directory(test::samplesFolder()))
        GTEST_SKIP() << test::samplesFolder() << " is not here; set CURVEWALL_SAMPLES to the samples folder";
    const auto rows = tableRows();
    ASSERT_GT(rows.size(), kFewest);
    for (const auto& [file, expected] : rows) {
        const std::string outcome = outcomeOf(test::samplesFolder() / file);
        if (expected.starts_with("read: ")) {
            EXPECT_THAT(outcome, testing::StartsWith("read: ")) << file;
        } else {
            EXPECT_EQ(outcome, expected) << file;
        }
    }
}

TEST(SampleFiles, AreAllInTheTable) {
    if (!fs::is_directory(test::samplesFolder()))
        GTEST_SKIP() << test::samplesFolder() << " is not here; set CURVEWALL_SAMPLES to the samples folder";
    const auto rows = tableRows();
    const std::set<std::string> noCalibration{".md", ".png", ".bat"};
    for (const auto& entry : fs::recursive_directory_iterator(test::samplesFolder())) {
        const fs::path file = fs::relative(entry.path(), test::samplesFolder());
        if (!entry.is_regular_file() || noCalibration.contains(file.extension().string()) ||
            file.filename() == "sgct.schema.json")
            continue;
        EXPECT_TRUE(rows.contains(file.string())) << file;
    }
}

}  // namespace
}  // namespace curvewall
