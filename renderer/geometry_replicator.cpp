#include "renderer/geometry_replicator.h"

#include "renderer/pair_drawing.h"
#include "renderer/part_splitting.h"
#include "renderer/piece_coverage.h"

#include <algorithm>
#include <string>
#include <utility>

namespace curvewall {
namespace {

// What a geometry shader makes of one record; 24 bytes each are well below what every driver lets it emit.
constexpr uint32_t kMostParts = 64;
constexpr size_t kRecordBytes = 24;
constexpr uint32_t kMostPartTriangles = 1u << 20;

GlProgram feedbackProgram(std::string_view geometry, const std::string& start) {
    return makeProgram({{GL_VERTEX_SHADER, "replications.vert"}, {GL_GEOMETRY_SHADER, geometry}},
                       {start, "MOST_PARTS " + std::to_string(kMostParts) + "u"});
}

GlTransformFeedback feedbackInto(const GlBuffer& buffer) {
    GLuint id = 0;
    glCreateTransformFeedbacks(1, &id);
    glTransformFeedbackBufferBase(id, 0, buffer.id());
    return GlTransformFeedback(id);
}

// As attributes rather than storage: Mesa's software renderers find out how many there are by the stride of
// the vertex buffer.
GlVertexArray vertexArrayOverRecords(const GlBuffer& records) {
    GlVertexArray array = makeVertexArray();
    glVertexArrayVertexBuffer(array.id(), 0, records.id(), 0, kRecordBytes);
    for (GLuint i = 0; i < 2; ++i) {
        glVertexArrayAttribIFormat(array.id(), i, 3, GL_UNSIGNED_INT, 12 * i);
        glVertexArrayAttribBinding(array.id(), i, 0);
        glEnableVertexArrayAttrib(array.id(), i);
    }
    return array;
}

// Runs `record` with what it emits going to `target` and nowhere else.
template <class Record>
void capture(const GlTransformFeedback& target, const GlProgram& program, Record record) {
    glUseProgram(program.id());
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, target.id());
    glBeginTransformFeedback(GL_POINTS);
    record();
    glEndTransformFeedback();
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
}

}  // namespace

GeometryReplicator::Part::Part(const SceneChunk& source, uint32_t first, uint32_t count)
    : chunk(&source), firstTriangle(first), triangleCount(count) {
    const size_t mostRanges = std::min<size_t>(source.changes ? count : source.ranges.size(), count);
    rangeBuffer = makeBuffer(nullptr, sizeof(glm::uvec2) * mostRanges, GL_DYNAMIC_STORAGE_BIT);
    ranges.reserve(mostRanges);
    update();
}

void GeometryReplicator::Part::update() {
    ranges.clear();
    for (const ChunkRange& range : chunk->ranges) {
        const uint32_t begin = std::max(range.firstTriangle, firstTriangle);
        const uint32_t end =
            std::min(range.firstTriangle + range.triangleCount, firstTriangle + triangleCount);
        if (begin >= end) continue;
        const glm::uvec2 span(begin, end - begin);
        glNamedBufferSubData(rangeBuffer.id(), static_cast<GLintptr>(sizeof span * ranges.size()),
                             sizeof span, &span);
        ChunkRange& within = ranges.emplace_back(range);
        within.firstTriangle = span.x;
        within.triangleCount = span.y;
    }
}

std::pair<GeometryReplicator::Part, GeometryReplicator::Part> GeometryReplicator::Part::halves() const {
    const uint32_t half = triangleCount / 2;
    return {Part(*chunk, firstTriangle, half), Part(*chunk, firstTriangle + half, triangleCount - half)};
}

GeometryReplicator::GeometryReplicator(std::span<const SceneChunk> chunks, uint32_t mostPairs)
    : count_(feedbackProgram("split.geom", "COUNT")),
      split_(feedbackProgram("split.geom", "READ")),
      pairsProgram_(feedbackProgram("pairs.geom", "READ")),
      commandsProgram_(
          makeProgram({{GL_COMPUTE_SHADER, "draw_commands.comp"}},
                      {"TRIANGLES", "PAIRS_PER_INSTANCE " + std::to_string(kPairsPerInstance) + "u"})),
      mostPairs_(std::min(mostPairs, mostPairsInBuffer())),
      emptyVertexArray_(makeVertexArray()) {
    for (const SceneChunk& chunk : chunks) {
        for (uint32_t first = 0; first < chunk.triangleCount; first += kMostPartTriangles)
            parts_.emplace_back(chunk, first, std::min(kMostPartTriangles, chunk.triangleCount - first));
    }
    for (const Part& part : parts_) capacity_ = std::max(capacity_, 2 * part.triangleCount);
    capacity_ = std::min(std::max(capacity_, 1u << 16), mostPairs_);
    allocate();
}

// Each triangle has one record that is not full, and the full ones stand for kMostParts pairs or more:
// records never lack room where pairs have enough.
void GeometryReplicator::allocate() {
    uint32_t triangles = 1;
    size_t ranges = 1;
    for (const Part& part : parts_) {
        triangles = std::max(triangles, part.triangleCount);
        // Room for a chunk that changes to grow into.
        ranges = std::max(ranges, (part.chunk->changes ? 2 : 1) * part.ranges.size());
    }
    rangeCapacity_ = ranges;
    for (size_t i = 0; i < records_.size(); ++i) {
        records_[i] = makeBuffer(nullptr, kRecordBytes * (triangles + capacity_ / kMostParts + 1));
        toRecords_[i] = feedbackInto(records_[i]);
        overRecords_[i] = vertexArrayOverRecords(records_[i]);
    }
    pairs_ = makeBuffer(nullptr, kPairBytes * capacity_);
    toPairs_ = feedbackInto(pairs_);
    total_ = makeBuffer(nullptr, sizeof(uint32_t));
    commands_ = makeBuffer(nullptr, kDrawCommandBytes * ranges);
}

void GeometryReplicator::draw(const PieceDraw& draw) {
    bool hasRoom = true;
    for (Part& part : parts_) {
        if (!part.chunk->changes) continue;
        part.update();
        hasRoom = hasRoom && part.ranges.size() <= rangeCapacity_;
    }
    if (!hasRoom) allocate();
    setPrograms(draw);
    for (const Part& part : parts_) {
        draw.timer.begin("triangles");
        findPairs(part, draw);
        makeCommands(part);
        draw.timer.begin("surfaces");
        glBindVertexArray(emptyVertexArray_.id());
        bindStorage(2, draw.pieces.pieces);
        drawPairs(*part.chunk, part.ranges, pairs_, commands_, draw.materials);
    }
}

void GeometryReplicator::setPrograms(const PieceDraw& draw) const {
    for (const GlProgram* program : {&count_, &pairsProgram_}) {
        setView(program->id(), draw.view);
        setForCoverage(program->id(), draw.pieces, sampleGridOf(draw.pieces, draw.pass));
    }
}

void GeometryReplicator::findPairs(const Part& part, const PieceDraw& draw) {
    glEnable(GL_RASTERIZER_DISCARD);
    bindForCoverage(*part.chunk, draw.pieces);
    // A triangle touches every piece at most.
    uint32_t partSize = kMostParts;
    while (uint64_t{partSize} * kMostParts < static_cast<uint64_t>(draw.pieces.pieceCount))
        partSize *= kMostParts;
    countPieces(part, draw, partSize);
    size_t latest = 0;
    const auto fromLatest = [&] {
        glBindVertexArray(overRecords_[latest].id());
        glDrawTransformFeedback(GL_POINTS, toRecords_[latest].id());
    };
    while (partSize > kMostParts) {
        partSize /= kMostParts;
        glProgramUniform1ui(split_.id(), 21, partSize);
        capture(toRecords_[1 - latest], split_, fromLatest);
        latest = 1 - latest;
    }
    pairQueries_.begin();
    capture(toPairs_, pairsProgram_, fromLatest);
    pairQueries_.end();
    glDisable(GL_RASTERIZER_DISCARD);
}

void GeometryReplicator::countPieces(const Part& part, const PieceDraw& draw, uint32_t partSize) {
    glBindVertexArray(emptyVertexArray_.id());
    glProgramUniform1ui(count_.id(), 21, partSize);
    capture(toRecords_[0], count_, [&] {
        for (const ChunkRange& range : part.ranges) {
            const Material& material = draw.materials.scene.scene->materials[range.material];
            glProgramUniform1i(count_.id(), 20, !material.doubleSided);
            glDrawArrays(GL_POINTS, static_cast<GLint>(range.firstTriangle),
                         static_cast<GLsizei>(range.triangleCount));
        }
    });
}

void GeometryReplicator::makeCommands(const Part& part) {
    pairQueries_.writeLast(total_);
    constexpr uint32_t kGroupSize = 64;
    const auto ranges = static_cast<uint32_t>(part.ranges.size());
    bindStorage(4, total_);
    bindStorage(6, pairs_);
    bindStorage(14, commands_);
    bindStorage(15, part.rangeBuffer);
    glProgramUniform1ui(commandsProgram_.id(), 5, capacity_);
    glProgramUniform1ui(commandsProgram_.id(), 8, ranges);
    glUseProgram(commandsProgram_.id());
    glDispatchCompute((ranges + kGroupSize - 1) / kGroupSize, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

FrameOutcome GeometryReplicator::finishFrame() {
    const std::vector<uint64_t> counts = pairQueries_.take();
    // Each pass goes over all parts.
    std::vector<uint64_t> needed(parts_.size());
    for (size_t i = 0; i < counts.size(); ++i) {
        uint64_t& ofPart = needed[i % parts_.size()];
        ofPart = std::max(ofPart, counts[i]);
    }
    FrameOutcome outcome;
    for (uint64_t ofPart : needed) outcome.pairCount += ofPart;
    if (const auto room = roomFor(parts_, needed, capacity_, mostPairs_)) {
        outcome.overflowed = true;
        capacity_ = *room;
        allocate();
    }
    return outcome;
}

size_t GeometryReplicator::memoryBytes() const {
    size_t bytes = sizeOf(records_[0]) + sizeOf(records_[1]);
    for (const GlBuffer* buffer : {&pairs_, &total_, &commands_}) bytes += sizeOf(*buffer);
    for (const Part& part : parts_) bytes += sizeOf(part.rangeBuffer);
    return bytes;
}

}  // namespace curvewall
