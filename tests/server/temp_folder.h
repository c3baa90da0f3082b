#pragma once
// A folder of the test's own that goes away with it.

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <unistd.h>

namespace curvewall {

class TempFolder {
public:
    TempFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "curvewall-XXXXXX").string();
        path_ = mkdtemp(pattern.data());
    }
    ~TempFolder() { std::filesystem::remove_all(path_); }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    std::string path(const std::string& name = "") const { return (path_ / name).string(); }

    std::string write(const std::string& name, std::string_view text) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << text;
        return path(name);
    }

private:
    std::filesystem::path path_;
};

// A wall file of one cylinder that is quick to render.
inline constexpr std::string_view kSmallWall = R"({
    "wall": "small cylinder", "eye": [0, 0, 0],
    "displays": [ { "name": "front", "size": [320, 240],
                    "projection": { "type": "cylinder", "radius": 2.0, "arc_deg": 180, "height": 4.0 } } ] })";

}  // namespace curvewall
