#include "renderer/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace curvewall {
namespace {

// Sole owner of one Embree handle.
template <class T, void (*Release)(T)>
class EmbreeHandle {
public:
    explicit EmbreeHandle(T handle) : handle_(handle) {}
    EmbreeHandle(EmbreeHandle&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
    EmbreeHandle& operator=(EmbreeHandle&& other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~EmbreeHandle() {
        if (handle_) Release(handle_);
    }

    T get() const { return handle_; }

private:
    T handle_;
};

using Device = EmbreeHandle<RTCDevice, rtcReleaseDevice>;
using Geometry = EmbreeHandle<RTCGeometry, rtcReleaseGeometry>;
using Tree = EmbreeHandle<RTCScene, rtcReleaseScene>;

// Embree keeps the first error since the last call; a null device asks why there is no device.
void throwOnError(RTCDevice device) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    throw std::runtime_error(error == RTC_ERROR_OUT_OF_MEMORY
                                 ? "not enough memory to trace rays through the scene"
                                 : "Embree failed with error " + std::to_string(static_cast<int>(error)));
}

Device makeDevice() {
    Device device(rtcNewDevice(nullptr));
    if (!device.get()) throwOnError(nullptr);
    return device;
}

// Copies: Embree reads past the end of buffers that it shares.
template <class T>
void fillBuffer(RTCDevice device, RTCGeometry mesh, RTCBufferType type, RTCFormat format,
                const std::vector<T>& values) {
    void* buffer = rtcSetNewGeometryBuffer(mesh, type, 0, format, sizeof(T), values.size());
    throwOnError(device);
    std::copy(values.begin(), values.end(), static_cast<T*>(buffer));
}

Tree buildTree(RTCDevice device, const Scene& scene) {
    Tree tree(rtcNewScene(device));
    rtcSetSceneFlags(tree.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    if (!scene.triangles.empty()) {
        const Geometry mesh(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
        fillBuffer(device, mesh.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, scene.positions);
        fillBuffer(device, mesh.get(), RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, scene.triangles);
        rtcCommitGeometry(mesh.get());
        rtcAttachGeometry(tree.get(), mesh.get());
    }
    rtcCommitScene(tree.get());
    throwOnError(device);
    return tree;
}

RTCRayHit embreeRay(const SceneRay& ray) {
    const glm::vec3 origin(ray.originM), direction(ray.direction);
    RTCRayHit result{};
    result.ray.org_x = origin.x, result.ray.org_y = origin.y, result.ray.org_z = origin.z;
    result.ray.dir_x = direction.x, result.ray.dir_y = direction.y, result.ray.dir_z = direction.z;
    result.ray.tnear = static_cast<float>(ray.nearM);
    result.ray.tfar = std::numeric_limits<float>::infinity();
    result.ray.mask = ~0u;
    result.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    return result;
}

RayHit rayHit(const RTCHit& hit, float distanceM) {
    constexpr float kEdgeWeight = 1e-6f;  // what rounding leaves open
    return {hit.primID, distanceM, std::min({hit.u, hit.v, 1 - hit.u - hit.v}) < kEdgeWeight};
}

// Embree hands its context on to the filter; the context comes first, so that its address is the query's.
struct Query {
    RTCIntersectContext context;
    const RayScene::Accept* accept;
    std::exception_ptr failure;  // exceptions must not unwind through Embree
};

void filterHit(const RTCFilterFunctionNArguments* arguments) {
    auto& query = *reinterpret_cast<Query*>(arguments->context);
    const RTCHit hit = rtcGetHitFromHitN(arguments->hit, arguments->N, 0);
    const float distanceM = rtcGetRayFromRayN(arguments->ray, arguments->N, 0).tfar;
    try {
        if (!query.failure && !(*query.accept)(rayHit(hit, distanceM))) arguments->valid[0] = 0;
    } catch (...) {
        query.failure = std::current_exception();
    }
}

}  // namespace

struct RayScene::Impl {
    Device device;
    Tree tree;

    explicit Impl(const Scene& scene) : device(makeDevice()), tree(buildTree(device.get(), scene)) {}
};

RayScene::RayScene(const Scene& scene) : impl_(std::make_unique<Impl>(scene)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

std::optional<RayHit> RayScene::nearestHit(const SceneRay& ray, const Accept& accept) const {
    Query query{{}, &accept, nullptr};
    rtcInitIntersectContext(&query.context);
    if (accept) query.context.filter = filterHit;
    RTCRayHit cast = embreeRay(ray);
    rtcIntersect1(impl_->tree.get(), &query.context, &cast);
    if (query.failure) std::rethrow_exception(query.failure);
    if (cast.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return rayHit(cast.hit, cast.ray.tfar);
}

std::vector<RayHit> RayScene::allHits(const SceneRay& ray) const {
    std::vector<RayHit> hits;
    // A hit that is refused lets the ray go on.
    nearestHit(ray, [&hits](const RayHit& hit) {
        hits.push_back(hit);
        return false;
    });
    return hits;
}

}  // namespace curvewall
