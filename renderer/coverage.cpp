#include "renderer/coverage.h"

#include "calibration/errors.h"
#include "renderer/meshlets.h"
#include "renderer/pair_drawing.h"
#include "renderer/part_splitting.h"
#include "renderer/piece_coverage.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace curvewall {
namespace {

constexpr uint32_t kGroupSize = 64;
static_assert(kGroupSize == kMeshletTriangles, "a meshlet is one group of coverage.comp");
// OpenGL promises that many groups along one axis.
constexpr uint32_t kMostPartMeshlets = 65'535;

uint32_t groupsFor(uint32_t items) { return (items + kGroupSize - 1) / kGroupSize; }

GlProgram computeProgram(std::string_view file, std::vector<std::string> defines) {
    defines.push_back("GROUP_SIZE " + std::to_string(kGroupSize));
    defines.push_back("PAIRS_PER_INSTANCE " + std::to_string(kPairsPerInstance) + "u");
    return makeProgram({{GL_COMPUTE_SHADER, file}}, defines);
}

constexpr size_t kPartBytes = 3 * sizeof(glm::vec2);

std::vector<std::string> withWarp(std::vector<std::string> screenMap) {
    screenMap.emplace_back("WARP");
    return screenMap;
}

// In the words of warp_parts.glsl.
const char* refusalOfParts(uint32_t refusal) {
    constexpr uint32_t kTooManyParts = 1;
    if (refusal == kTooManyParts)
        return "a triangle is seen so large that it has too many parts for so short a tessellation length; a "
               "longer one has fewer";
    return "single precision has no parts as fine as a triangle needs, and more than a pixel would stay "
           "open: it goes too far to all sides for how near the eye is, or the display magnifies some "
           "directions too much; reference may draw it";
}

constexpr GLbitfield kResults = GL_SHADER_STORAGE_BARRIER_BIT;

void dispatch(const GlProgram& program, uint32_t groups, GLbitfield barrier = kResults) {
    glUseProgram(program.id());
    glDispatchCompute(groups, 1, 1);
    glMemoryBarrier(barrier);
}

void dispatchIndirect(const GlProgram& program) {
    glUseProgram(program.id());
    glDispatchComputeIndirect(0);
    glMemoryBarrier(kResults);
}

}  // namespace

ScenePart::ScenePart(const SceneChunk& source, uint32_t first, uint32_t most)
    : chunk(&source), firstMeshlet(first), mostMeshlets(most) {
    const size_t mostRanges = std::min<size_t>(source.changes ? most : source.ranges.size(), most);
    rangeBuffer = makeBuffer(nullptr, sizeof(glm::uvec2) * mostRanges, GL_DYNAMIC_STORAGE_BIT);
    ranges.reserve(mostRanges);
    update();
}

void ScenePart::update() {
    meshletCount = std::min(mostMeshlets, chunk->meshletCount - std::min(firstMeshlet, chunk->meshletCount));
    ranges.clear();
    for (const ChunkRange& range : chunk->ranges) {
        const uint32_t begin = std::max(range.firstMeshlet, firstMeshlet);
        const uint32_t end = std::min(range.firstMeshlet + range.meshletCount, firstMeshlet + meshletCount);
        if (begin >= end) continue;
        const glm::uvec2 span(begin - firstMeshlet, end - begin);
        glNamedBufferSubData(rangeBuffer.id(), static_cast<GLintptr>(sizeof span * ranges.size()),
                             sizeof span, &span);
        ChunkRange& within = ranges.emplace_back(range);
        within.firstMeshlet = span.x;
        within.meshletCount = span.y;
    }
}

std::pair<ScenePart, ScenePart> ScenePart::halves() const {
    const uint32_t half = meshletCount / 2;
    return {ScenePart(*chunk, firstMeshlet, half),
            ScenePart(*chunk, firstMeshlet + half, mostMeshlets - half)};
}

Coverage::Coverage(std::span<const SceneChunk> chunks, const Shaders& shaders, uint32_t mostPairs)
    : scanMeshlets_(computeProgram("scan.comp", {"MESHLETS"})),
      gather_(computeProgram("meshlets.comp", {"GATHER"})),
      scanPairs_(computeProgram("scan.comp", {"PAIRS"})),
      commandsProgram_(computeProgram("draw_commands.comp", {"MESHLETS"})),
      mostPairs_(std::min(mostPairs, mostPairsInBuffer())) {
    const auto with = [](std::vector<std::string> defines, const char* step) {
        defines.emplace_back(step);
        return defines;
    };
    mark_ = computeProgram("meshlets.comp", with(shaders.forMeshlets, "MARK"));
    count_ = computeProgram("coverage.comp", with(shaders.forTriangles, "COUNT"));
    emit_ = computeProgram("coverage.comp", with(shaders.forTriangles, "EMIT"));
    for (const SceneChunk& chunk : chunks) {
        const uint32_t mostMeshlets = chunk.changes ? chunk.triangleCount : chunk.meshletCount;
        for (uint32_t first = 0; first < mostMeshlets; first += kMostPartMeshlets)
            parts_.emplace_back(chunk, first, std::min(kMostPartMeshlets, mostMeshlets - first));
        capacity_ = std::max(capacity_, 2 * chunk.triangleCount);
    }
    capacity_ = std::min(std::max(capacity_, 1u << 16), mostPairs_);
}

Coverage::Coverage(std::span<const SceneChunk> chunks, uint32_t mostPairs, MeshletLookup lookup)
    : Coverage(chunks, Shaders{{lookup == MeshletLookup::grid ? "GRID" : "TREE"}, {}}, mostPairs) {
    lookup_ = lookup;
    allocate();
}

Coverage::Coverage(std::span<const SceneChunk> chunks, const std::vector<std::string>& screenMap,
                   uint32_t mostPairs)
    : Coverage(chunks, Shaders{{"WARP"}, withWarp(screenMap)},
               std::min(mostPairs, mostPairsInBuffer() / static_cast<uint32_t>(kPartBytes / kPairBytes))) {
    findsParts_ = true;
    allocate();
}

void Coverage::beginFrame() {
    bool hasRoom = true;
    for (ScenePart& part : parts_) {
        if (!part.chunk->changes) continue;
        part.update();
        hasRoom = hasRoom && part.meshletCount <= meshletCapacity_ && part.ranges.size() <= rangeCapacity_;
    }
    if (!hasRoom) allocate();
}

void Coverage::allocate() {
    uint32_t meshlets = 1;
    size_t ranges = 1;
    for (const ScenePart& part : parts_) {
        // Room for a chunk that changes to grow into.
        const uint32_t slack = part.chunk->changes ? 2 : 1;
        meshlets = std::max(meshlets, std::min(slack * part.meshletCount, part.mostMeshlets));
        ranges = std::max(ranges, slack * part.ranges.size());
    }
    meshletCapacity_ = meshlets;
    rangeCapacity_ = ranges;
    groupSeen_ = makeBuffer(nullptr, sizeof(uint32_t) * (groupsFor(meshlets) + 1));
    meshletNodes_ = makeBuffer(nullptr, sizeof(glm::uvec2) * meshlets);
    seen_ = makeBuffer(nullptr, sizeof(uint32_t) * meshlets);
    placeOf_ = makeBuffer(nullptr, sizeof(uint32_t) * (meshlets + 1));
    dispatch_ = makeBuffer(nullptr, sizeof(glm::uvec3));
    groupPairs_ = makeBuffer(nullptr, sizeof(uint32_t) * (meshlets + 1));
    found_ = makeBuffer(nullptr, sizeof(glm::uvec4) * kGroupSize * meshlets);
    pairs_ = makeBuffer(nullptr, kPairBytes * capacity_);
    if (findsParts_) triangleParts_ = makeBuffer(nullptr, kPartBytes * capacity_);
    commands_ = makeBuffer(nullptr, kDrawCommandBytes * ranges);
    constexpr GLbitfield kMapping =
        GL_MAP_READ_BIT | GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    const size_t totalBytes = sizeof(Totals) * std::max<size_t>(parts_.size(), 1);
    totalsBuffer_ = makeBuffer(nullptr, totalBytes, kMapping);
    totals_ = static_cast<volatile Totals*>(
        glMapNamedBufferRange(totalsBuffer_.id(), 0, static_cast<GLsizeiptr>(totalBytes), kMapping));
    if (!totals_) throw std::runtime_error("OpenGL could not map a buffer");
    for (size_t i = 0; i < parts_.size(); ++i) takeTotals(i);
}

void Coverage::findPairs(size_t index, const GpuPieces& pieces, const SceneView& view, glm::vec4 sampleGrid,
                         StageTimer* timer) {
    const ScenePart& part = parts_[index];
    const bool byGrid = lookup_ == MeshletLookup::grid;
    bindForCoverage(*part.chunk, pieces);
    if (byGrid) bindStorage(2, pieces.nodeGrid);
    bindForPart(part);
    setForPart(index, view);
    if (!byGrid) glProgramUniform1ui(mark_.id(), 4, pieces.nodeCount);
    for (const GlProgram* program : {&count_, &emit_}) setForCoverage(program->id(), pieces, sampleGrid);
    run(
        part, [&] { bindStorage(2, pieces.nodes); }, timer);
}

void Coverage::findParts(size_t index, const SceneView& view, StageTimer* timer) {
    const ScenePart& part = parts_[index];
    bindStorage(0, part.chunk->positions);
    bindStorage(1, part.chunk->corners);
    bindStorage(8, triangleParts_);
    bindForPart(part);
    setForPart(index, view);
    run(
        part, [] {}, timer);
}

void Coverage::bindForPart(const ScenePart& part) {
    bindStorage(3, part.chunk->meshlets);
    bindStorage(5, meshletNodes_);
    bindStorage(6, pairs_);
    bindStorage(7, found_);
    bindStorage(10, seen_);
    bindStorage(11, placeOf_);
    bindStorage(12, dispatch_);
    bindStorage(13, totalsBuffer_);
    bindStorage(14, commands_);
    bindStorage(15, part.rangeBuffer);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, dispatch_.id());
}

void Coverage::setForPart(size_t index, const SceneView& view) {
    const ScenePart& part = parts_[index];
    for (const GlProgram* program : {&mark_, &gather_, &count_, &emit_})
        glProgramUniform1ui(program->id(), 3, part.firstMeshlet);
    for (const GlProgram* program : {&mark_, &gather_})
        glProgramUniform1ui(program->id(), 5, part.meshletCount);
    glProgramUniform1ui(scanMeshlets_.id(), 6, groupsFor(part.meshletCount));
    for (const GlProgram* program : {&mark_, &count_, &emit_}) setView(program->id(), view);
    for (const GlProgram* program : {&scanMeshlets_, &scanPairs_})
        glProgramUniform1ui(program->id(), 7, static_cast<GLuint>(index));
    if (findsParts_) glProgramUniform1ui(count_.id(), 7, static_cast<GLuint>(index));
    for (const GlProgram* program : {&emit_, &commandsProgram_})
        glProgramUniform1ui(program->id(), 5, capacity_);
    glProgramUniform1ui(commandsProgram_.id(), 8, static_cast<uint32_t>(part.ranges.size()));
}

void Coverage::run(const ScenePart& part, const BindForTriangles& bindForTriangles, StageTimer* timer) {
    const uint32_t meshletGroups = groupsFor(part.meshletCount);
    if (timer) timer->begin("meshlets");
    bindStorage(4, groupSeen_);
    dispatch(mark_, meshletGroups);
    dispatch(scanMeshlets_, 1, kResults | GL_COMMAND_BARRIER_BIT);
    dispatch(gather_, meshletGroups);
    if (timer) timer->begin("triangles");
    bindForTriangles();
    bindStorage(4, groupPairs_);
    dispatchIndirect(count_);
    dispatch(scanPairs_, 1);
    dispatchIndirect(emit_);
    dispatch(commandsProgram_, groupsFor(static_cast<uint32_t>(part.ranges.size())),
             kResults | GL_COMMAND_BARRIER_BIT | GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
}

Coverage::Totals Coverage::takeTotals(size_t part) {
    volatile Totals& of = totals_[part];
    return {std::exchange(of.pairs, 0), std::exchange(of.meshlets, 0), std::exchange(of.refusal, 0)};
}

FrameOutcome Coverage::finishFrame() {
    FrameOutcome outcome;
    std::vector<uint32_t> needed(parts_.size());
    uint32_t refusal = 0;
    for (size_t i = 0; i < parts_.size(); ++i) {
        const Totals totals = takeTotals(i);
        refusal = std::max(refusal, totals.refusal);
        needed[i] = totals.pairs;
        outcome.pairCount += totals.pairs;
        outcome.meshletCount += totals.meshlets;
    }
    if (refusal != 0) {
        outcome.refusal = refusalOfParts(refusal);
    } else if (const auto room = roomFor(parts_, needed, capacity_, mostPairs_)) {
        outcome.overflowed = true;
        capacity_ = *room;
        allocate();
    }
    return outcome;
}

size_t Coverage::memoryBytes() const {
    size_t bytes = 0;
    for (const GlBuffer* buffer : {&groupSeen_, &meshletNodes_, &seen_, &placeOf_, &dispatch_, &groupPairs_,
                                   &found_, &pairs_, &triangleParts_, &commands_, &totalsBuffer_})
        bytes += sizeOf(*buffer);
    for (const ScenePart& part : parts_) bytes += sizeOf(part.rangeBuffer);
    return bytes;
}

}  // namespace curvewall
