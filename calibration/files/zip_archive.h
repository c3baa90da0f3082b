#pragma once
// ZIP archives in memory, as MPCDI packs calibrations. What an archive says of itself is not trusted.

#include "calibration/files/file_bytes.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace curvewall {

bool isZip(std::string_view bytes);

class ZipArchive {
public:
    // Throws InputError for what is no archive; for more than 4096 members; and where their sizes as the
    // archive states them are more than 512 MiB and 100 times the archive's, which no calibration needs.
    explicit ZipArchive(const FileBytes& file);

    // In the order of the archive, without folders and without names that lead out of it.
    const std::vector<std::string>& names() const { return names_; }

    // Members by exact name, and else by their bare name in any letter case. Nothing where there is none.
    // Throws InputError for a name that leads out of the archive, and for a member that is encrypted, packed
    // in another way than deflate, damaged, or of another size than the archive states.
    FindFile files() const;

private:
    struct Content;
    std::shared_ptr<const Content> content_;
    std::vector<std::string> names_;
};

}  // namespace curvewall
