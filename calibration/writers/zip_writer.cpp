#include "calibration/writers/zip_writer.h"

#include <memory>
#include <stdexcept>
#include <zip.h>

namespace curvewall {
namespace {

struct Discard {
    void operator()(zip_t* archive) const { zip_discard(archive); }
};

}  // namespace

void writeZip(const std::string& path, const std::vector<ZipMember>& members) {
    const auto fail = [&path](const std::string& why) {
        return std::runtime_error(path + ": cannot be written: " + why);
    };
    int code = 0;
    std::unique_ptr<zip_t, Discard> archive(zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code));
    if (!archive) throw fail("error " + std::to_string(code));
    for (const ZipMember& member : members) {
        zip_source_t* source = zip_source_buffer(archive.get(), member.bytes.data(), member.bytes.size(), 0);
        if (source && zip_file_add(archive.get(), member.name.c_str(), source, ZIP_FL_ENC_UTF_8) >= 0)
            continue;
        zip_source_free(source);
        throw fail(zip_strerror(archive.get()));
    }
    if (zip_close(archive.get()) != 0) throw fail(zip_strerror(archive.get()));
    static_cast<void>(archive.release());  // closing has freed it
}

}  // namespace curvewall
