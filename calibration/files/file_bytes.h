#pragma once
// Files as a whole, from a disk or out of an archive.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace curvewall {

struct FileBytes {
    std::string path;  // as messages name it; "archive.mpcdi!surface1.pfm" for a member of an archive
    std::string bytes;

    std::string name() const;       // without its folders
    std::string stem() const;       // the name without its extension
    std::string extension() const;  // in lower case, with the dot
};

// Nothing that we read is larger. A map of 16,384 x 8,192 points in float has 1.5 GiB.
inline constexpr uint64_t kMostFileBytes = uint64_t{2} << 30;

// Throws InputError, with what was `expected`, unless there is a regular file of at most `most` bytes.
FileBytes readFile(const std::string& path, const std::string& expected, uint64_t most = kMostFileBytes);

// Finds the files that a file names. Nothing where there is none of that name. Files were written on other
// machines, so that what is asked for may be "C:/wall/mesh/Left.sgc": the path as it is comes first, then
// the bare name in whatever letter case. Never answers with a file from outside the folder or archive.
using FindFile = std::function<std::optional<FileBytes>(const std::string& name)>;

// Files in the folder of `path` and below it. The paths of those that are found go to `opened`, which has to
// live as long as the answer is asked.
FindFile filesBeside(const std::string& path, std::vector<std::string>* opened = nullptr);

// What a path on any system ends in: "Left.sgc".
std::string bareName(const std::string& path);

std::string lowerCase(std::string text);  // ASCII only, whatever the locale

}  // namespace curvewall
