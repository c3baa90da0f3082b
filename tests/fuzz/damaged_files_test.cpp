// Every conformance file and every regression, whole, cut off, and with bytes changed, through the reader of
// every format: each is read or refused, and nothing else.

#include "tests/fuzz/read_and_look.h"
#include "tests/support/random_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace curvewall::test {
namespace {

namespace fs = std::filesystem;

constexpr int kCuts = 20, kChanges = 60;
constexpr size_t kLargestSeed = 100'000;

struct Seed {
    std::string name;
    std::string bytes;
};

std::vector<std::string> fuzzedFiles() {
    std::vector<std::string> files;
    std::stringstream list(CURVEWALL_FUZZED_FILES);
    for (std::string file; std::getline(list, file, ',');) files.push_back(file);
    return files;
}

// Of the kind of file that `name` is, by its extension.
std::vector<Seed> seedsFor(const std::string& name) {
    std::vector<Seed> seeds;
    for (const char* folder : {"tests/data/conformance", "tests/fuzz/regressions", "configs"}) {
        const fs::path root = fs::path(CURVEWALL_SOURCE_DIR) / folder;
        if (!fs::is_directory(root)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(root)) {
            if (!entry.is_regular_file() || entry.file_size() > kLargestSeed) continue;
            const bool isRegression = entry.path().parent_path().filename() == name;
            if (!isRegression && entry.path().extension() != fs::path(name).extension()) continue;
            std::ifstream in(entry.path(), std::ios::binary);
            seeds.push_back({entry.path().string(), {std::istreambuf_iterator<char>(in), {}}});
        }
    }
    std::ranges::sort(seeds, {}, &Seed::name);
    return seeds;
}

std::string nameOf(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::ranges::replace(name, '.', '_');
    return name;
}

class DamagedFiles : public testing::TestWithParam<std::string> {};

TEST_P(DamagedFiles, AreReadOrRefusedAndNothingElse) {
    const std::vector<Seed> seeds = seedsFor(GetParam());
    ASSERT_FALSE(seeds.empty()) << "there is no conformance file of this kind";
    Random random(6);
    const auto anyBelow = [&](size_t count) {
        return static_cast<size_t>(random.uniform(0, static_cast<double>(count)));
    };
    for (const Seed& seed : seeds) {
        SCOPED_TRACE(seed.name);
        readAndLook(GetParam(), seed.bytes);
        if (seed.bytes.empty()) continue;
        for (int i = 0; i < kCuts; ++i)
            readAndLook(GetParam(), seed.bytes.substr(0, anyBelow(seed.bytes.size())));
        for (int i = 0; i < kChanges; ++i) {
            std::string changed = seed.bytes;
            for (size_t j = 0; j <= anyBelow(4); ++j)
                changed[anyBelow(changed.size())] = static_cast<char>(anyBelow(256));
            readAndLook(GetParam(), changed);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Readers, DamagedFiles, testing::ValuesIn(fuzzedFiles()), nameOf);

}  // namespace
}  // namespace curvewall::test
