#include "calibration/files/file_bytes.h"

#include "calibration/errors.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace curvewall {
namespace {

namespace fs = std::filesystem;

bool isInside(const fs::path& name) {
    return name.is_relative() && std::ranges::find(name, "..") == name.end();
}

bool isFile(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

// The first in the order of names, so that the answer does not depend on the file system.
std::optional<fs::path> fileOfName(const fs::path& folder, const std::string& name) {
    std::vector<fs::path> found;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        if (lowerCase(entry->path().filename().string()) == lowerCase(name) && isFile(entry->path()))
            found.push_back(entry->path());
    if (found.empty()) return std::nullopt;
    return *std::ranges::min_element(found);
}

}  // namespace

std::string FileBytes::name() const { return bareName(path.substr(path.rfind('!') + 1)); }

std::string FileBytes::stem() const { return fs::path(name()).stem().string(); }

std::string FileBytes::extension() const { return lowerCase(fs::path(name()).extension().string()); }

FileBytes readFile(const std::string& path, const std::string& expected, uint64_t most) {
    std::ifstream in(path, std::ios::binary);
    // A directory opens like a file and throws when it is read.
    if (!in || !isFile(path)) throw InputError(path, "", expected, "nothing readable");
    std::error_code error;
    const uint64_t size = fs::file_size(path, error);
    if (error || size > most)
        throw InputError(path, "", expected + " of at most " + std::to_string(most) + " bytes",
                         error ? error.message() : std::to_string(size) + " bytes");
    FileBytes file{path, std::string(size, '\0')};
    if (!in.read(file.bytes.data(), static_cast<std::streamsize>(size)))
        throw InputError(path, "", expected, "a file that cannot be read to its end");
    return file;
}

FindFile filesBeside(const std::string& path, std::vector<std::string>* opened) {
    const auto open = [opened](const fs::path& found, const std::string& what) {
        if (opened) opened->push_back(found.string());
        return readFile(found.string(), what);
    };
    return
        [folder = fs::path(path).parent_path(), open](const std::string& name) -> std::optional<FileBytes> {
            const std::string what = "a file that " + (folder / "").string() + " names";
            if (name.empty()) return std::nullopt;
            if (isInside(name) && isFile(folder / name)) return open(folder / name, what);
            const auto beside = fileOfName(folder.empty() ? fs::path(".") : folder, bareName(name));
            if (!beside) return std::nullopt;
            return open(*beside, what);
        };
}

std::string bareName(const std::string& path) { return path.substr(path.find_last_of("/\\") + 1); }

std::string lowerCase(std::string text) {
    std::ranges::transform(text, text.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return text;
}

}  // namespace curvewall
