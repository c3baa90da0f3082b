#include "renderer/replicator.h"

#include "renderer/loop_replicator.h"
#include "renderer/pair_replicator.h"

namespace curvewall {

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
