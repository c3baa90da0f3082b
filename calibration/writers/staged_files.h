#pragma once
// Files that appear in their place all at once when everything is written, and never half.

#include <filesystem>
#include <string>
#include <vector>

namespace curvewall {

// Files are written into a folder beside the target first; what is not published goes with it.
class StagedFiles {
public:
    // Throws std::runtime_error where nothing can be written.
    explicit StagedFiles(const std::filesystem::path& folder);
    ~StagedFiles();
    StagedFiles(const StagedFiles&) = delete;
    StagedFiles& operator=(const StagedFiles&) = delete;

    // Where to write the file that will have the name.
    std::string path(const std::string& name) const { return (staging_ / name).string(); }

    // Moves the files, in this order.
    void publish(const std::vector<std::string>& names) const;

private:
    std::filesystem::path folder_;
    std::filesystem::path staging_;
};

}  // namespace curvewall
