#pragma once
// Textures sampled on the CPU as OpenGL's LINEAR_MIPMAP_LINEAR does (OpenGL 4.5 core profile, section 8.14).

#include "renderer/scene/scene.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace curvewall {

// log2 of the texels of level 0 that one footprint covers, from how far uv moves along the footprint's sides.
double levelOfDetail(glm::ivec2 sizePx, glm::dvec2 uvAcross, glm::dvec2 uvDown);

// Colour in linear light, straight alpha. Any level of detail will do, infinite ones too: it is clamped to
// the texture's levels.
glm::vec4 sampleTexture(const Texture& texture, glm::dvec2 uv, double levelOfDetail);

}  // namespace curvewall
