#pragma once
// The numbers behind a glTF accessor, with every offset, stride and count checked against its buffer.

#include <cstdint>
#include <span>
#include <string>
#include <tiny_gltf.h>
#include <vector>

namespace curvewall {

struct GltfFile {
    std::string path;
    tinygltf::Model model;
};

// The bytes of a buffer view. `field` is what refers to it, for the error message.
std::span<const uint8_t> bufferViewBytes(const GltfFile& file, int bufferView, const std::string& field);

// All components of all elements, one element after the other; normalized integers become 0..1 or -1..1.
// The accessor's type must be `tinygltfType` (TINYGLTF_TYPE_VEC3, ...).
std::vector<double> readNumbers(const GltfFile& file, int accessor, int tinygltfType,
                                const std::string& field);

// An index accessor. Every index is smaller than vertexCount.
std::vector<uint32_t> readIndices(const GltfFile& file, int accessor, size_t vertexCount,
                                  const std::string& field);

}  // namespace curvewall
