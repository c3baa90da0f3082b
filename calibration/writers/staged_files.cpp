#include "calibration/writers/staged_files.h"

#include <cstdlib>
#include <stdexcept>
#include <system_error>

namespace curvewall {

namespace fs = std::filesystem;

StagedFiles::StagedFiles(const fs::path& folder) : folder_(folder.empty() ? fs::path(".") : folder) {
    std::string pattern = (folder_ / ".curvewall-XXXXXX").string();
    if (!mkdtemp(pattern.data()))
        throw std::runtime_error(folder_.string() + ": nothing can be written there");
    staging_ = pattern;
}

StagedFiles::~StagedFiles() {
    std::error_code ignored;
    fs::remove_all(staging_, ignored);
}

void StagedFiles::publish(const std::vector<std::string>& names) const {
    for (const std::string& name : names) {
        std::error_code error;
        fs::rename(staging_ / name, folder_ / name, error);
        if (error)
            throw std::runtime_error((folder_ / name).string() + ": cannot be written: " + error.message());
    }
}

}  // namespace curvewall
