#pragma once
// Textures with their mip chain, and the image files they come from.

#include "renderer/scene/scene.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace curvewall {

// Larger images are refused, not scaled: every OpenGL 4.5 driver can hold this size.
inline constexpr int kMaxTextureSizePx = 8192;

// Builds the full mip chain by box filtering in linear light; sizes need not be powers of two.
// `texels` holds sizePx.x * sizePx.y entries, rows from v = 0.
Texture makeTexture(std::string name, glm::ivec2 sizePx, std::vector<glm::u8vec4> texels,
                    Wrap wrapS = Wrap::repeat, Wrap wrapT = Wrap::repeat);

// Decodes a PNG or JPEG file held in memory, 8 bits a channel. Throws InputError that names `file` and
// `field`.
MipLevel decodeImage(const std::string& file, const std::string& field, std::span<const uint8_t> bytes);

}  // namespace curvewall
