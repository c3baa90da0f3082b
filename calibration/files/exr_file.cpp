#include "calibration/files/exr_file.h"

#include <OpenEXR/openexr.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <libdeflate.h>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace curvewall {
namespace {

class ExrFile {
public:
    explicit ExrFile(const std::string& path) {
        exr_context_initializer_t options = EXR_DEFAULT_CONTEXT_INITIALIZER;
        options.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};  // not to stderr
        isOpen_ = exr_start_read(&file_, path.c_str(), &options) == EXR_ERR_SUCCESS;
    }
    ~ExrFile() {
        if (isOpen_) exr_finish(&file_);
    }
    ExrFile(const ExrFile&) = delete;
    ExrFile& operator=(const ExrFile&) = delete;

    bool isOpen() const { return isOpen_; }
    exr_context_t get() const { return file_; }

private:
    exr_context_t file_{};
    bool isOpen_ = false;
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

struct Layout {
    NumberMap map;                // without its values
    std::vector<size_t> placeOf;  // of the file's channels, which are in the order of the alphabet
    int firstRow = 0;
    int rowsPerChunk = 0;
    exr_compression_t compression = EXR_COMPRESSION_NONE;
};

// The order that pictures have their channels in.
std::optional<std::vector<size_t>> placesOf(const exr_attr_chlist_t& channels) {
    constexpr std::string_view kOrder = "YRGBA";
    std::vector<size_t> ranks;
    for (int i = 0; i < channels.num_channels; ++i) {
        const exr_attr_chlist_entry_t& channel = channels.entries[i];
        const std::string_view name(channel.name.str, static_cast<size_t>(channel.name.length));
        const size_t rank = name.size() == 1 ? kOrder.find(name) : std::string_view::npos;
        if (rank == std::string_view::npos || channel.x_sampling != 1 || channel.y_sampling != 1 ||
            (channel.pixel_type != EXR_PIXEL_FLOAT && channel.pixel_type != EXR_PIXEL_HALF))
            return std::nullopt;
        ranks.push_back(rank);
    }
    std::vector<size_t> places;
    places.reserve(ranks.size());
    for (const size_t rank : ranks)
        places.push_back(
            static_cast<size_t>(std::ranges::count_if(ranks, [&](size_t r) { return r < rank; })));
    return places;
}

std::optional<Layout> layoutOf(exr_context_t file) {
    int parts = 0;
    exr_storage_t storage{};
    Layout layout;
    exr_attr_box2i_t window{};
    const exr_attr_chlist_t* channels = nullptr;
    if (exr_get_count(file, &parts) != EXR_ERR_SUCCESS || parts != 1 ||
        exr_get_storage(file, 0, &storage) != EXR_ERR_SUCCESS || storage != EXR_STORAGE_SCANLINE ||
        exr_get_compression(file, 0, &layout.compression) != EXR_ERR_SUCCESS ||
        !(layout.compression == EXR_COMPRESSION_NONE || isPacked(layout.compression)) ||
        exr_get_data_window(file, 0, &window) != EXR_ERR_SUCCESS ||
        exr_get_scanlines_per_chunk(file, 0, &layout.rowsPerChunk) != EXR_ERR_SUCCESS ||
        exr_get_channels(file, 0, &channels) != EXR_ERR_SUCCESS || channels->num_channels < 1 ||
        channels->num_channels > 4)
        return std::nullopt;
    auto places = placesOf(*channels);
    const int64_t width = int64_t{window.max.x} - window.min.x + 1,
                  height = int64_t{window.max.y} - window.min.y + 1;
    if (!places || width < 1 || height < 1 || width > kMaxMapTexels || height > kMaxMapTexels ||
        width * height > kMaxMapTexels)
        return std::nullopt;
    layout.placeOf = std::move(*places);
    layout.firstRow = window.min.y;
    layout.map.sizePx = {static_cast<int>(width), static_cast<int>(height)};
    layout.map.channels = channels->num_channels;
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

    // The chunk that begins with `row`, counted from the first one.
    bool read(int row, NumberMap& map) {
        exr_chunk_info_t chunk{};
        if (exr_read_scanline_chunk_info(file_, 0, layout_.firstRow + row, &chunk) != EXR_ERR_SUCCESS ||
            chunk.start_y != layout_.firstRow + row || chunk.height > map.sizePx.y - row)
            return false;
        const bool isFirst = !isReady_;
        if ((isFirst ? exr_decoding_initialize(file_, 0, &chunk, &pipeline_)
                     : exr_decoding_update(file_, 0, &chunk, &pipeline_)) != EXR_ERR_SUCCESS)
            return false;
        isReady_ = true;
        setTargets(row, map);
        if (isFirst) {
            if (exr_decoding_choose_default_routines(file_, 0, &pipeline_) != EXR_ERR_SUCCESS) return false;
            pipeline_.decoding_user_data = &unpacker_;
            if (isPacked(layout_.compression)) pipeline_.decompress_fn = unpackChunk;
        }
        return exr_decoding_run(file_, 0, &pipeline_) == EXR_ERR_SUCCESS;
    }

private:
    void setTargets(int row, NumberMap& map) {
        constexpr int kNumber = sizeof(float);
        float* const begin = &map.values[static_cast<size_t>(row) * static_cast<size_t>(map.sizePx.x) *
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

}  // namespace

std::optional<NumberMap> readPlainExr(const std::string& path) {
    const ExrFile file(path);
    if (!file.isOpen()) return std::nullopt;
    auto layout = layoutOf(file.get());
    if (!layout) return std::nullopt;
    NumberMap map = std::move(layout->map);
    std::error_code error;
    const uint64_t bytes = std::filesystem::file_size(path, error);
    requirePlausibleSize(path, error ? 0 : bytes, map);
    map.values.resize(static_cast<size_t>(map.sizePx.x) * static_cast<size_t>(map.sizePx.y) *
                      static_cast<size_t>(map.channels));
    ChunkReader reader(file.get(), *layout);
    for (int row = 0; row < map.sizePx.y; row += layout->rowsPerChunk)
        if (!reader.read(row, map)) return std::nullopt;
    return map;
}

}  // namespace curvewall
