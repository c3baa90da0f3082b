#include "calibration/files/zip_archive.h"

#include "calibration/errors.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <zip.h>

namespace curvewall {
namespace {

constexpr zip_int64_t kMostMembers = 4096;
constexpr uint64_t kAlwaysAllowedBytes = uint64_t{512} << 20;
constexpr uint64_t kMostPacked = 100;

struct CloseZip {
    void operator()(zip_t* zip) const { zip_discard(zip); }
};
using ZipPtr = std::unique_ptr<zip_t, CloseZip>;

struct CloseMember {
    void operator()(zip_file_t* member) const { zip_fclose(member); }
};

std::string described(zip_error_t& error) {
    std::string text = zip_error_strerror(&error);
    zip_error_fini(&error);
    return text;
}

// `bytes` must outlive the answer.
ZipPtr open(const std::string& path, std::string_view bytes) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    if (!source) throw InputError(path, "", "a ZIP archive", described(error));
    zip_t* zip = zip_open_from_source(source, ZIP_RDONLY, &error);
    if (!zip) {
        zip_source_free(source);
        throw InputError(path, "", "a ZIP archive", described(error));
    }
    zip_error_fini(&error);
    return ZipPtr(zip);
}

// On this system or another one.
bool leadsOut(std::string_view name) {
    const auto isSlash = [](char c) { return c == '/' || c == '\\'; };
    if (name.empty() || isSlash(name.front())) return true;
    if (name.size() > 1 && name[1] == ':') return true;  // C:\maps
    size_t begin = 0;
    while (begin <= name.size()) {
        const size_t end = std::min(name.find_first_of("/\\", begin), name.size());
        if (name.substr(begin, end - begin) == "..") return true;
        begin = end + 1;
    }
    return false;
}

}  // namespace

bool isZip(std::string_view bytes) {
    return bytes.starts_with("PK\x03\x04") || bytes.starts_with("PK\x05\x06");
}

struct ZipArchive::Content {
    struct Member {
        std::string name;
        zip_uint64_t index;
    };
    std::string path;
    std::string bytes;  // the archive reads from here
    ZipPtr zip;
    std::vector<Member> members;

    std::optional<FileBytes> find(const std::string& name) const {
        if (name.empty()) return std::nullopt;
        if (leadsOut(name))
            throw InputError(path, "", "names of files inside of the archive", "\"" + name + "\"");
        auto found = std::ranges::find(members, name, &Member::name);
        if (found == members.end())
            found = std::ranges::find(members, lowerCase(bareName(name)),
                                      [](const Member& m) { return lowerCase(bareName(m.name)); });
        if (found == members.end()) return std::nullopt;
        return read(*found);
    }

    FileBytes read(const Member& member) const {
        FileBytes file{path + "!" + member.name, {}};
        zip_stat_t stat;
        zip_stat_init(&stat);
        if (zip_stat_index(zip.get(), member.index, 0, &stat) != 0)
            throw InputError(file.path, "", "a member of the archive", zip_strerror(zip.get()));
        if (stat.encryption_method != ZIP_EM_NONE)
            throw InputError(file.path, "", "a member that is not encrypted", "an encrypted one");
        if (stat.comp_method != ZIP_CM_STORE && stat.comp_method != ZIP_CM_DEFLATE)
            throw InputError(file.path, "", "a member packed by deflate",
                             "packing method " + std::to_string(stat.comp_method));
        const std::unique_ptr<zip_file_t, CloseMember> in(
            zip_fopen_index(zip.get(), member.index, ZIP_FL_UNCHANGED));
        if (!in) throw InputError(file.path, "", "a readable member", zip_strerror(zip.get()));
        // Piece by piece: memory is only taken for what is really there.
        std::string piece(size_t{1} << 20, '\0');
        for (zip_int64_t count = 0; (count = zip_fread(in.get(), piece.data(), piece.size())) != 0;) {
            if (count < 0)
                throw InputError(file.path, "", "a readable member",
                                 zip_error_strerror(zip_file_get_error(in.get())));
            file.bytes.append(piece, 0, static_cast<size_t>(count));
            if (file.bytes.size() > stat.size) break;
        }
        if (file.bytes.size() != stat.size)
            throw InputError(file.path, "", std::to_string(stat.size) + " bytes, as the archive states",
                             file.bytes.size() > stat.size ? "more" : std::to_string(file.bytes.size()));
        return file;
    }
};

ZipArchive::ZipArchive(const FileBytes& file) {
    auto content = std::make_shared<Content>();
    content->path = file.path;
    content->bytes = file.bytes;
    content->zip = open(file.path, content->bytes);
    const zip_int64_t count = zip_get_num_entries(content->zip.get(), 0);
    if (count < 0 || count > kMostMembers)
        throw InputError(file.path, "", "at most " + std::to_string(kMostMembers) + " members",
                         std::to_string(count));
    const uint64_t most = kAlwaysAllowedBytes + kMostPacked * file.bytes.size();
    uint64_t bytesLeft = most;
    for (zip_uint64_t index = 0; index < static_cast<zip_uint64_t>(count); ++index) {
        zip_stat_t stat;
        zip_stat_init(&stat);
        constexpr zip_uint64_t kNeeded = ZIP_STAT_NAME | ZIP_STAT_SIZE;
        if (zip_stat_index(content->zip.get(), index, 0, &stat) != 0 || (stat.valid & kNeeded) != kNeeded)
            throw InputError(file.path, "", "members with a name and a size",
                             "none in member " + std::to_string(index));
        const std::string name = stat.name;
        if (stat.size > bytesLeft)
            throw InputError(file.path, "", "members of at most " + std::to_string(most) + " bytes together",
                             "more, with " + std::to_string(stat.size) + " in " + name);
        bytesLeft -= stat.size;
        if (leadsOut(name) || name.ends_with('/')) continue;
        content->members.push_back({name, index});
        names_.push_back(name);
    }
    content_ = std::move(content);
}

FindFile ZipArchive::files() const {
    return [content = content_](const std::string& name) { return content->find(name); };
}

}  // namespace curvewall
