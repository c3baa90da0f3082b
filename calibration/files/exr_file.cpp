#include "calibration/files/exr_file.h"

#include "calibration/errors.h"

#include <OpenEXR/openexr.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <libdeflate.h>
#include <memory>
#include <numeric>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace curvewall {
namespace {

constexpr int kPart = 0;  // of a file of several, the first

void require(exr_result_t result, const std::string& path) {
    if (result != EXR_ERR_SUCCESS)
        throw InputError(path, "", "a sound EXR", exr_get_default_error_message(result));
}

int64_t sizeOf(exr_const_context_t, void* bytes) {
    return static_cast<int64_t>(static_cast<const std::string_view*>(bytes)->size());
}

int64_t copyFrom(exr_const_context_t, void* bytes, void* target, uint64_t size, uint64_t offset,
                 exr_stream_error_func_ptr_t) {
    const auto& all = *static_cast<const std::string_view*>(bytes);
    if (offset > all.size()) return -1;
    return static_cast<int64_t>(all.copy(static_cast<char*>(target), size, offset));
}

class ExrFile {
public:
    // Throws InputError unless the header is a sound one.
    explicit ExrFile(const std::string& path) { open(path, EXR_DEFAULT_CONTEXT_INITIALIZER); }

    // The bytes have to live as long.
    explicit ExrFile(const FileBytes& file) : bytes_(file.bytes) {
        exr_context_initializer_t options = EXR_DEFAULT_CONTEXT_INITIALIZER;
        options.user_data = &bytes_;
        options.size_fn = sizeOf;
        options.read_fn = copyFrom;
        open(file.path, options);
    }

    ~ExrFile() { exr_finish(&file_); }
    ExrFile(const ExrFile&) = delete;
    ExrFile& operator=(const ExrFile&) = delete;

    exr_context_t get() const { return file_; }

private:
    void open(const std::string& path, exr_context_initializer_t options) {
        options.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};  // not to stderr
        require(exr_start_read(&file_, path.c_str(), &options), path);
    }

    std::string_view bytes_;
    exr_context_t file_{};
};

// Zlib as OpenEXR packs it: bytes as differences, and the even ones before the odd ones. OpenEXR's own
// unpacking takes four times as long.
class Unpacker {
public:
    bool unpack(const void* packed, size_t packedSize, uint8_t* bytes, size_t size) {
        differences_.resize(size);
        size_t found = 0;
        if (libdeflate_zlib_decompress(inflater_.get(), packed, packedSize, differences_.data(), size,
                                       &found) != LIBDEFLATE_SUCCESS ||
            found != size)
            return false;
        uint8_t value = 128;
        for (uint8_t& byte : differences_) byte = value = static_cast<uint8_t>(value + byte - 128);
        const uint8_t* even = differences_.data();
        const uint8_t* odd = even + (size + 1) / 2;
        for (size_t i = 0; i + 1 < size; i += 2) {
            bytes[i] = even[i / 2];
            bytes[i + 1] = odd[i / 2];
        }
        if (size % 2 == 1) bytes[size - 1] = even[size / 2];
        return true;
    }

private:
    struct Free {
        void operator()(libdeflate_decompressor* inflater) const { libdeflate_free_decompressor(inflater); }
    };
    std::unique_ptr<libdeflate_decompressor, Free> inflater_{libdeflate_alloc_decompressor()};
    std::vector<uint8_t> differences_;
};

exr_result_t unpackChunk(exr_decode_pipeline_t* chunk) {
    if (chunk->unpacked_buffer == chunk->packed_buffer) return EXR_ERR_SUCCESS;  // packing did not pay
    auto& unpacker = *static_cast<Unpacker*>(chunk->decoding_user_data);
    return unpacker.unpack(chunk->packed_buffer, chunk->chunk.packed_size,
                           static_cast<uint8_t*>(chunk->unpacked_buffer), chunk->chunk.unpacked_size)
               ? EXR_ERR_SUCCESS
               : EXR_ERR_CORRUPT_CHUNK;
}

bool isPacked(exr_compression_t compression) {
    return compression == EXR_COMPRESSION_ZIP || compression == EXR_COMPRESSION_ZIPS;
}

// B44 and DWA are for pictures: they move numbers by as much as an eye does not see, which is pixels of a
// map.
bool isForPictures(exr_compression_t compression) {
    return compression == EXR_COMPRESSION_B44 || compression == EXR_COMPRESSION_B44A ||
           compression == EXR_COMPRESSION_DWAA || compression == EXR_COMPRESSION_DWAB;
}

struct Layout {
    NumberMap map;                // without its values
    std::vector<size_t> placeOf;  // of the file's channels, which are in the order of the alphabet
    glm::ivec2 firstPx{0};
    glm::ivec2 chunkPx{0};
    bool isTiled = false;
    exr_compression_t compression = EXR_COMPRESSION_NONE;
};

// Red, green and blue first and alpha last, as pictures have them; the others in between as they are.
size_t rankOf(std::string_view channel) {
    constexpr std::string_view kColours = "RGB";
    constexpr size_t kOther = kColours.size(), kAlpha = kOther + 1;
    if (channel == "A") return kAlpha;
    const size_t colour = channel.size() == 1 ? kColours.find(channel) : std::string_view::npos;
    return colour == std::string_view::npos ? kOther : colour;
}

std::vector<size_t> placesOf(const exr_attr_chlist_t& channels, const std::string& path) {
    std::vector<size_t> ranks, inOrder(static_cast<size_t>(channels.num_channels)), places(inOrder.size());
    for (int i = 0; i < channels.num_channels; ++i) {
        const exr_attr_chlist_entry_t& channel = channels.entries[i];
        const std::string name(channel.name.str, static_cast<size_t>(channel.name.length));
        if (channel.x_sampling != 1 || channel.y_sampling != 1)
            throw InputError(path, "", "channels of full resolution", "\"" + name + "\" of less");
        if (channel.pixel_type != EXR_PIXEL_FLOAT && channel.pixel_type != EXR_PIXEL_HALF)
            throw InputError(path, "", "channels of half or float numbers", "\"" + name + "\" of integers");
        ranks.push_back(rankOf(name));
    }
    std::iota(inOrder.begin(), inOrder.end(), size_t{0});
    std::ranges::stable_sort(inOrder, {}, [&](size_t i) { return ranks[i]; });
    for (size_t place = 0; place < inOrder.size(); ++place) places[inOrder[place]] = place;
    return places;
}

glm::ivec2 chunkSizePx(exr_context_t file, const Layout& layout, const std::string& path) {
    int rows = 0;
    uint32_t width = 0, height = 0;
    exr_tile_level_mode_t levels{};
    exr_tile_round_mode_t round{};
    if (!layout.isTiled) {
        require(exr_get_scanlines_per_chunk(file, kPart, &rows), path);
        return {layout.map.sizePx.x, std::max(rows, 1)};
    }
    require(exr_get_tile_descriptor(file, kPart, &width, &height, &levels, &round), path);
    constexpr uint32_t kMost = 1 << 20;
    return {std::clamp(width, 1u, kMost), std::clamp(height, 1u, kMost)};
}

Layout layoutOf(exr_context_t file, const std::string& path) {
    exr_storage_t storage{};
    Layout layout;
    exr_attr_box2i_t window{};
    const exr_attr_chlist_t* channels = nullptr;
    require(exr_get_storage(file, kPart, &storage), path);
    if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED)
        throw InputError(path, "", "an EXR of scan lines or tiles", "one of deep pixels");
    require(exr_get_compression(file, kPart, &layout.compression), path);
    if (isForPictures(layout.compression))
        throw InputError(path, "", "an EXR that keeps its numbers, such as ZIP",
                         "the compression B44 or DWA");
    require(exr_get_data_window(file, kPart, &window), path);
    require(exr_get_channels(file, kPart, &channels), path);
    const int64_t width = int64_t{window.max.x} - window.min.x + 1,
                  height = int64_t{window.max.y} - window.min.y + 1;
    layout.map.sizePx = mapSizePx(path, width, height, channels->num_channels);
    layout.map.channels = channels->num_channels;
    layout.placeOf = placesOf(*channels, path);
    layout.firstPx = {window.min.x, window.min.y};
    layout.isTiled = storage == EXR_STORAGE_TILED;
    layout.chunkPx = chunkSizePx(file, layout, path);
    return layout;
}

// Decodes chunks one after another; OpenEXR keeps its buffers from one to the next.
class ChunkReader {
public:
    ChunkReader(exr_context_t file, const Layout& layout) : file_(file), layout_(layout) {}
    ~ChunkReader() {
        if (isReady_) exr_decoding_destroy(file_, &pipeline_);
    }
    ChunkReader(const ChunkReader&) = delete;
    ChunkReader& operator=(const ChunkReader&) = delete;

    // The chunk that begins at `px`, counted from the first pixel.
    exr_result_t read(glm::ivec2 px, NumberMap& map) {
        exr_chunk_info_t chunk{};
        if (const exr_result_t result = find(px, chunk); result != EXR_ERR_SUCCESS) return result;
        if (chunk.width > map.sizePx.x - px.x || chunk.height > map.sizePx.y - px.y)
            return EXR_ERR_BAD_CHUNK_LEADER;
        const bool isFirst = !isReady_;
        const exr_result_t result = isFirst ? exr_decoding_initialize(file_, kPart, &chunk, &pipeline_)
                                            : exr_decoding_update(file_, kPart, &chunk, &pipeline_);
        if (result != EXR_ERR_SUCCESS) return result;
        isReady_ = true;
        setTargets(px, map);
        if (isFirst) {
            const exr_result_t chosen = exr_decoding_choose_default_routines(file_, kPart, &pipeline_);
            if (chosen != EXR_ERR_SUCCESS) return chosen;
            pipeline_.decoding_user_data = &unpacker_;
            if (isPacked(layout_.compression)) pipeline_.decompress_fn = unpackChunk;
        }
        return exr_decoding_run(file_, kPart, &pipeline_);
    }

private:
    exr_result_t find(glm::ivec2 px, exr_chunk_info_t& chunk) const {
        if (layout_.isTiled)
            return exr_read_tile_chunk_info(file_, kPart, px.x / layout_.chunkPx.x, px.y / layout_.chunkPx.y,
                                            0, 0, &chunk);
        const int row = layout_.firstPx.y + px.y;
        const exr_result_t result = exr_read_scanline_chunk_info(file_, kPart, row, &chunk);
        return result == EXR_ERR_SUCCESS && chunk.start_y != row ? EXR_ERR_BAD_CHUNK_LEADER : result;
    }

    void setTargets(glm::ivec2 px, NumberMap& map) {
        constexpr int kNumber = sizeof(float);
        float* const begin = &map.values[(static_cast<size_t>(px.y) * static_cast<size_t>(map.sizePx.x) +
                                          static_cast<size_t>(px.x)) *
                                         static_cast<size_t>(map.channels)];
        for (int i = 0; i < map.channels; ++i) {
            exr_coding_channel_info_t& channel = pipeline_.channels[i];
            channel.decode_to_ptr =
                reinterpret_cast<uint8_t*>(begin + layout_.placeOf[static_cast<size_t>(i)]);
            channel.user_pixel_stride = map.channels * kNumber;
            channel.user_line_stride = map.sizePx.x * map.channels * kNumber;
            channel.user_bytes_per_element = kNumber;
            channel.user_data_type = EXR_PIXEL_FLOAT;
        }
    }

    exr_context_t file_;
    const Layout& layout_;
    Unpacker unpacker_;
    exr_decode_pipeline_t pipeline_{};
    bool isReady_ = false;
};

NumberMap read(const ExrFile& file, const std::string& path, uint64_t fileBytes, const AllowSize& allow) {
    const Layout layout = layoutOf(file.get(), path);
    NumberMap map = layout.map;
    requirePlausibleSize(path, fileBytes, map);
    if (allow) allow(map.sizePx);
    map.values.resize(static_cast<size_t>(map.sizePx.x) * static_cast<size_t>(map.sizePx.y) *
                      static_cast<size_t>(map.channels));
    ChunkReader reader(file.get(), layout);
    for (int y = 0; y < map.sizePx.y; y += layout.chunkPx.y)
        for (int x = 0; x < map.sizePx.x; x += layout.chunkPx.x) require(reader.read({x, y}, map), path);
    return map;
}

}  // namespace

NumberMap readExr(const std::string& path) {
    std::error_code error;
    const uint64_t bytes = std::filesystem::file_size(path, error);
    return read(ExrFile(path), path, error ? 0 : bytes, {});
}

NumberMap readExr(const FileBytes& file, const AllowSize& allow) {
    return read(ExrFile(file), file.path, file.bytes.size(), allow);
}

}  // namespace curvewall
