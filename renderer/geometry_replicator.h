#pragma once
// The three passes of Lorenz and Doellner (2009), section 2.1: count the pieces of each triangle, number its
// replications, draw them. Where they let a triangle's replications grow from frame to frame, pass 2 is
// repeated within the frame until all are there, and no frame depends on the one before.

#include "renderer/gl/program.h"
#include "renderer/primitive_queries.h"
#include "renderer/replicator.h"

#include <array>
#include <span>
#include <utility>
#include <vector>

namespace curvewall {

class GeometryReplicator : public Replicator {
public:
    // `mostPairs` limits the pairs of a part below what the driver allows.
    explicit GeometryReplicator(std::span<const SceneChunk> chunks, uint32_t mostPairs = ~0u);

    void draw(const PieceDraw& draw) override;
    FrameOutcome finishFrame() override;
    size_t memoryBytes() const override;

    // A run of a chunk's triangles that is drawn before the next one.
    struct Part {
        const SceneChunk* chunk = nullptr;
        uint32_t firstTriangle = 0, triangleCount = 0;
        std::vector<ChunkRange> ranges;  // what of the chunk's lies in it
        GlBuffer rangeBuffer;            // the same for draw_commands.comp

        Part(const SceneChunk& chunk, uint32_t firstTriangle, uint32_t triangleCount);

        // Takes over what the chunk holds now.
        void update();

        bool isSplittable() const { return triangleCount > 1; }
        std::pair<Part, Part> halves() const;
    };
    const std::vector<Part>& parts() const { return parts_; }

    // Those of the part drawn last, in the order of its triangles.
    const GlBuffer& pairs() const { return pairs_; }

private:
    void allocate();
    void setPrograms(const PieceDraw& draw) const;
    void findPairs(const Part& part, const PieceDraw& draw);
    void countPieces(const Part& part, const PieceDraw& draw, uint32_t partSize);
    void makeCommands(const Part& part);

    GlProgram count_, split_, pairsProgram_, commandsProgram_;
    std::vector<Part> parts_;
    uint32_t mostPairs_;
    uint32_t capacity_ = 0;  // pairs
    size_t rangeCapacity_ = 0;
    std::array<GlBuffer, 2> records_;  // read one, write the other
    std::array<GlTransformFeedback, 2> toRecords_;
    std::array<GlVertexArray, 2> overRecords_;
    GlBuffer pairs_, total_, commands_;
    GlTransformFeedback toPairs_;
    PrimitiveQueries pairQueries_;
    GlVertexArray emptyVertexArray_;
};

}  // namespace curvewall
