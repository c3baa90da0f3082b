#include "renderer/replicator.h"

#include "renderer/loop_replicator.h"
#include "renderer/pair_replicator.h"

namespace curvewall {

FrameOutcome& FrameOutcome::operator+=(const FrameOutcome& other) {
    pairCount += other.pairCount;
    meshletCount += other.meshletCount;
    overflowed = overflowed || other.overflowed;
    return *this;
}

std::unique_ptr<Replicator> makeReplicator(Engine engine, std::span<const SceneChunk> chunks) {
    switch (engine) {
        case Engine::loop:
            return std::make_unique<LoopReplicator>(chunks);
        case Engine::compute:
        case Engine::geometry:
        case Engine::tessellation:
            return std::make_unique<PairReplicator>(chunks);
    }
    return nullptr;
}

}  // namespace curvewall
