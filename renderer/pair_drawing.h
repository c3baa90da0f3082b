#pragma once
// Draws (triangle, piece) pairs, whoever has found them: one indirect draw a material range, corners pulled
// from the scene's buffers.

#include "renderer/material_binder.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace curvewall {

// Pairs are drawn in instances of so many; see draw_commands.comp.
inline constexpr uint32_t kPairsPerInstance = 64;
inline constexpr size_t kDrawCommandBytes = 5 * sizeof(uint32_t);
inline constexpr uint64_t kPairBytes = 8;

// How many pairs a buffer may hold that shaders read and draw commands count the vertices of.
uint32_t mostPairsInBuffer();

// `commands` has one for each of the ranges. A vertex array without attributes has to be bound, and what the
// programs read of that which triangles are paired with. `primitive` is GL_TRIANGLES, or GL_PATCHES of three.
void drawPairs(const SceneChunk& chunk, std::span<const ChunkRange> ranges, const GlBuffer& pairs,
               const GlBuffer& commands, const MaterialBinder& materials, GLenum primitive = GL_TRIANGLES);

}  // namespace curvewall
