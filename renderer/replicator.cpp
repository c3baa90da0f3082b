#include "renderer/replicator.h"

#include "renderer/geometry_replicator.h"
#include "renderer/loop_replicator.h"
#include "renderer/pair_replicator.h"
#include "renderer/tessellation_replicator.h"

namespace curvewall {

FrameOutcome& FrameOutcome::operator+=(const FrameOutcome& other) {
    pairCount += other.pairCount;
    meshletCount += other.meshletCount;
    overflowed = overflowed || other.overflowed;
    if (!refusal) refusal = other.refusal;
    return *this;
}

std::unique_ptr<Replicator> makeReplicator(Engine engine, std::span<const SceneChunk> chunks) {
    switch (engine) {
        case Engine::compute:
            return std::make_unique<PairReplicator>(chunks);
        case Engine::geometry:
            return std::make_unique<GeometryReplicator>(chunks);
        case Engine::tessellation:
            return std::make_unique<TessellationReplicator>(chunks);
        case Engine::loop:
            return std::make_unique<LoopReplicator>(chunks);
    }
    return nullptr;
}

}  // namespace curvewall
