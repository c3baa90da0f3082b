#include "renderer/scene/gltf_accessor.h"

#include "calibration/errors.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace curvewall {
namespace {

// Far above any real file, and low enough that a forged count cannot exhaust the memory: an accessor without
// a buffer view is all zeros, so no buffer bounds it.
constexpr size_t kMaxElements = 100'000'000;

template <class Element>
const Element& at(const GltfFile& file, const std::vector<Element>& elements, int index, const char* what,
                  const std::string& field) {
    if (index < 0 || static_cast<size_t>(index) >= elements.size())
        throw InputError(file.path, field,
                         std::string(what) + " number below " + std::to_string(elements.size()),
                         std::to_string(index));
    return elements[static_cast<size_t>(index)];
}

template <class Component>
double decodeAs(const uint8_t* bytes, bool normalized) {
    Component value;
    std::memcpy(&value, bytes, sizeof(value));
    if constexpr (std::numeric_limits<Component>::is_integer) {
        if (normalized)
            return std::max(
                static_cast<double>(value) / static_cast<double>(std::numeric_limits<Component>::max()),
                -1.0);
    }
    return static_cast<double>(value);
}

double decode(const uint8_t* bytes, int componentType, bool normalized) {
    switch (componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return decodeAs<int8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return decodeAs<uint8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return decodeAs<int16_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return decodeAs<uint16_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return decodeAs<uint32_t>(bytes, normalized);
        default:
            return decodeAs<float>(bytes, normalized);
    }
}

size_t componentBytes(const GltfFile& file, int componentType, const std::string& field) {
    switch (componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            throw InputError(file.path, field, "a componentType of glTF 2.0 (5120 to 5123, 5125, 5126)",
                             std::to_string(componentType));
    }
}

bool isUnsignedInteger(int componentType) {
    return componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

// Equally spaced elements inside a buffer view.
struct Elements {
    const uint8_t* first = nullptr;
    size_t strideBytes = 0;

    const uint8_t* at(size_t index) const { return first + index * strideBytes; }
};

Elements elementsIn(const GltfFile& file, int bufferView, size_t byteOffset, size_t elementBytes,
                    size_t count, const std::string& field) {
    const std::span<const uint8_t> bytes = bufferViewBytes(file, bufferView, field);
    const size_t declared = file.model.bufferViews[static_cast<size_t>(bufferView)].byteStride;
    const size_t stride = declared == 0 ? elementBytes : declared;
    // Written so that nothing overflows, whatever numbers the file holds; count is at least 1.
    const bool fits = byteOffset <= bytes.size() && elementBytes <= bytes.size() - byteOffset &&
                      count - 1 <= (bytes.size() - byteOffset - elementBytes) / stride;
    if (!fits)
        throw InputError(file.path, field,
                         std::to_string(count) + " elements of " + std::to_string(elementBytes) +
                             " bytes, one every " + std::to_string(stride) + " bytes from byte " +
                             std::to_string(byteOffset),
                         "a buffer view of " + std::to_string(bytes.size()) + " bytes");
    return {bytes.data() + byteOffset, stride};
}

void replaceSparse(const GltfFile& file, const tinygltf::Accessor& accessor, size_t components,
                   size_t bytesPerComponent, std::vector<double>& numbers, const std::string& field) {
    const auto& sparse = accessor.sparse;
    const int indexType = sparse.indices.componentType;
    if (sparse.count < 1 || static_cast<size_t>(sparse.count) > accessor.count ||
        !isUnsignedInteger(indexType) || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        throw InputError(
            file.path, field + ".sparse", "a count, offsets and index type within the accessor",
            "count " + std::to_string(sparse.count) + ", index type " + std::to_string(indexType));
    const auto count = static_cast<size_t>(sparse.count);
    const Elements indices =
        elementsIn(file, sparse.indices.bufferView, static_cast<size_t>(sparse.indices.byteOffset),
                   componentBytes(file, indexType, field), count, field + ".sparse.indices");
    const Elements values =
        elementsIn(file, sparse.values.bufferView, static_cast<size_t>(sparse.values.byteOffset),
                   components * bytesPerComponent, count, field + ".sparse.values");
    for (size_t i = 0; i < count; ++i) {
        const auto element = static_cast<size_t>(decode(indices.at(i), indexType, false));
        if (element >= accessor.count)
            throw InputError(file.path, field + ".sparse.indices",
                             "an index below " + std::to_string(accessor.count), std::to_string(element));
        for (size_t c = 0; c < components; ++c)
            numbers[element * components + c] =
                decode(values.at(i) + c * bytesPerComponent, accessor.componentType, accessor.normalized);
    }
}

}  // namespace

std::span<const uint8_t> bufferViewBytes(const GltfFile& file, int bufferView, const std::string& field) {
    const auto& view = at(file, file.model.bufferViews, bufferView, "a buffer view", field);
    const std::string viewField = "bufferViews[" + std::to_string(bufferView) + "]";
    const auto& buffer = at(file, file.model.buffers, view.buffer, "a buffer", viewField + ".buffer").data;
    if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset)
        throw InputError(
            file.path, viewField,
            std::to_string(view.byteLength) + " bytes from byte " + std::to_string(view.byteOffset),
            "a buffer of " + std::to_string(buffer.size()) + " bytes");
    return std::span(buffer).subspan(view.byteOffset, view.byteLength);
}

std::vector<double> readNumbers(const GltfFile& file, int accessorIndex, int tinygltfType,
                                const std::string& field) {
    const auto& accessor = at(file, file.model.accessors, accessorIndex, "an accessor", field);
    if (accessor.type != tinygltfType)
        throw InputError(
            file.path, field,
            "an accessor with " +
                std::to_string(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(tinygltfType))) +
                " components",
            "another type");
    if (accessor.count < 1 || accessor.count > kMaxElements)
        throw InputError(file.path, field, "1 to " + std::to_string(kMaxElements) + " elements",
                         std::to_string(accessor.count));
    const auto components =
        static_cast<size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(tinygltfType)));
    const size_t bytesPerComponent = componentBytes(file, accessor.componentType, field);

    std::vector<double> numbers;
    if (accessor.bufferView < 0) {
        numbers.resize(accessor.count * components);
    } else {
        const Elements elements = elementsIn(file, accessor.bufferView, accessor.byteOffset,
                                             components * bytesPerComponent, accessor.count, field);
        numbers.reserve(accessor.count * components);
        for (size_t i = 0; i < accessor.count; ++i)
            for (size_t c = 0; c < components; ++c)
                numbers.push_back(decode(elements.at(i) + c * bytesPerComponent, accessor.componentType,
                                         accessor.normalized));
    }
    if (accessor.sparse.isSparse)
        replaceSparse(file, accessor, components, bytesPerComponent, numbers, field);
    return numbers;
}

std::vector<uint32_t> readIndices(const GltfFile& file, int accessorIndex, size_t vertexCount,
                                  const std::string& field) {
    const auto& accessor = at(file, file.model.accessors, accessorIndex, "an accessor", field);
    if (!isUnsignedInteger(accessor.componentType))
        throw InputError(file.path, field, "unsigned integers (componentType 5121, 5123 or 5125)",
                         "componentType " + std::to_string(accessor.componentType));
    std::vector<uint32_t> indices;
    for (const double index : readNumbers(file, accessorIndex, TINYGLTF_TYPE_SCALAR, field)) {
        if (!(index >= 0 && index < static_cast<double>(vertexCount)))
            throw InputError(file.path, field,
                             "indices below the number of vertices, " + std::to_string(vertexCount),
                             std::to_string(static_cast<int64_t>(index)));
        indices.push_back(static_cast<uint32_t>(index));
    }
    return indices;
}

}  // namespace curvewall
