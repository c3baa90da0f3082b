#include "renderer/coverage.h"

#include <glm/vec4.hpp>

#include <algorithm>
#include <string>

namespace curvewall {
namespace {

constexpr uint32_t kGroupSize = 128;
constexpr uint64_t kPairBytes = 8;

uint32_t groupsFor(uint32_t items, uint32_t groupSize) { return (items + groupSize - 1) / groupSize; }

uint32_t largestCapacity() {
    GLint64 bytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    // Draw commands count vertices in 32 bits, three a pair.
    return static_cast<uint32_t>(std::min<uint64_t>(static_cast<uint64_t>(bytes) / kPairBytes, 1u << 30));
}

std::vector<MaterialRange> rangesWithin(const SceneChunk& chunk, uint32_t first, uint32_t count) {
    std::vector<MaterialRange> ranges;
    for (const MaterialRange& range : chunk.ranges) {
        const uint32_t begin = std::max(range.firstTriangle, first);
        const uint32_t end = std::min(range.firstTriangle + range.triangleCount, first + count);
        if (begin < end) ranges.push_back({range.material, begin - first, end - begin});
    }
    return ranges;
}

GlProgram computeProgram(std::string_view file, const std::string& mode) {
    return makeProgram({{GL_COMPUTE_SHADER, file}},
                       {mode, "GROUP_SIZE " + std::to_string(kGroupSize),
                        "PAIRS_PER_INSTANCE " + std::to_string(kPairsPerInstance) + "u"});
}

void setView(const GlProgram& program, const SceneView& view) {
    glProgramUniformMatrix3fv(program.id(), 0, 1, GL_FALSE, &view.wallFromScene[0][0]);
    glProgramUniform3fv(program.id(), 1, 1, &view.originFromEyeM[0]);
}

void bindStorage(GLuint binding, const GlBuffer& buffer) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.id());
}

void dispatch(const GlProgram& program, uint32_t groups) {
    glUseProgram(program.id());
    glDispatchCompute(groups, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace

ScenePart::ScenePart(const SceneChunk& source, uint32_t first, uint32_t count)
    : chunk(&source), firstTriangle(first), triangleCount(count), ranges(rangesWithin(source, first, count)) {
    std::vector<glm::uvec2> spans;
    for (const MaterialRange& range : ranges) spans.emplace_back(range.firstTriangle, range.triangleCount);
    rangeBuffer = makeBuffer(std::span<const glm::uvec2>(spans));
}

Coverage::Coverage(const GpuScene& scene)
    : count_(computeProgram("coverage.comp", "COUNT")),
      scan_(computeProgram("scan.comp", "SCAN")),
      emit_(computeProgram("coverage.comp", "EMIT")),
      commandsProgram_(computeProgram("draw_commands.comp", "COMMANDS")) {
    for (const SceneChunk& chunk : scene.chunks) {
        parts_.emplace_back(chunk, 0, chunk.triangleCount);
        capacity_ = std::max(capacity_, 4 * chunk.triangleCount);
    }
    capacity_ = std::min(std::max(capacity_, 1u << 16), largestCapacity());
    allocate();
}

void Coverage::allocate() {
    uint32_t triangles = 1;
    size_t ranges = 1;
    for (const ScenePart& part : parts_) {
        triangles = std::max(triangles, part.triangleCount);
        ranges = std::max(ranges, part.ranges.size());
    }
    groupPairs_ = makeBuffer(nullptr, sizeof(uint32_t) * groupsFor(triangles, kGroupSize));
    firstPair_ = makeBuffer(nullptr, sizeof(uint32_t) * (triangles + 1));
    found_ = makeBuffer(nullptr, sizeof(glm::uvec4) * triangles);
    pairs_ = makeBuffer(nullptr, kPairBytes * capacity_);
    commands_ = makeBuffer(nullptr, kDrawCommandBytes * ranges);
    constexpr GLbitfield kMapping = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    const size_t totalBytes = sizeof(uint32_t) * std::max<size_t>(parts_.size(), 1);
    totalsBuffer_ = makeBuffer(nullptr, totalBytes, kMapping);
    totals_ = static_cast<const volatile uint32_t*>(
        glMapNamedBufferRange(totalsBuffer_.id(), 0, static_cast<GLsizeiptr>(totalBytes), kMapping));
}

void Coverage::findPairs(size_t index, const GpuPieces& pieces, const SceneView& view) {
    const ScenePart& part = parts_[index];
    const uint32_t groups = groupsFor(part.triangleCount, kGroupSize);
    bindStorage(0, part.chunk->positions);
    bindStorage(1, part.chunk->corners);
    bindStorage(2, pieces.nodes);
    bindStorage(3, part.chunk->singleSided);
    bindStorage(4, groupPairs_);
    bindStorage(5, firstPair_);
    bindStorage(6, pairs_);
    bindStorage(7, found_);
    for (const GlProgram* program : {&count_, &emit_}) {
        setView(*program, view);
        glProgramUniform1ui(program->id(), 2, part.firstTriangle);
        glProgramUniform1ui(program->id(), 3, part.triangleCount);
        glProgramUniform1ui(program->id(), 4, pieces.nodeCount);
    }
    glProgramUniform1ui(emit_.id(), 5, capacity_);
    glProgramUniform1ui(scan_.id(), 3, part.triangleCount);
    glProgramUniform1ui(scan_.id(), 6, groups);
    glProgramUniform1ui(scan_.id(), 7, static_cast<GLuint>(index));
    dispatch(count_, groups);
    bindStorage(3, totalsBuffer_);
    dispatch(scan_, 1);
    dispatch(emit_, groups);

    const auto ranges = static_cast<uint32_t>(part.ranges.size());
    bindStorage(2, part.rangeBuffer);
    bindStorage(3, commands_);
    glProgramUniform1ui(commandsProgram_.id(), 5, capacity_);
    glProgramUniform1ui(commandsProgram_.id(), 8, ranges);
    dispatch(commandsProgram_, groupsFor(ranges, 64));
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
}

Coverage::Outcome Coverage::finishFrame() {
    Outcome outcome;
    uint64_t needed = 0;
    for (size_t i = 0; i < parts_.size(); ++i) {
        outcome.pairCount += totalOf(i);
        needed = std::max<uint64_t>(needed, totalOf(i));
    }
    outcome.overflowed = needed > capacity_;
    if (!outcome.overflowed) return outcome;

    const uint32_t largest = largestCapacity();
    if (needed > largest) {
        std::vector<ScenePart> parts;
        for (size_t i = 0; i < parts_.size(); ++i) {
            ScenePart& part = parts_[i];
            if (totalOf(i) <= largest || part.triangleCount == 1) {
                parts.push_back(std::move(part));
            } else {
                const uint32_t half = part.triangleCount / 2;
                parts.emplace_back(*part.chunk, part.firstTriangle, half);
                parts.emplace_back(*part.chunk, part.firstTriangle + half, part.triangleCount - half);
            }
        }
        parts_ = std::move(parts);
    }
    capacity_ = static_cast<uint32_t>(std::min<uint64_t>(needed + needed / 2, largest));
    allocate();
    return outcome;
}

}  // namespace curvewall
