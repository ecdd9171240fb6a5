// SPDX-License-Identifier: MIT OR Apache-2.0
//! Embree (libembree-dev) on the mesh and the rays that benches/rays.rs writes: embree DIRECTORY. Writes the first hits
//! there, and prints nanoseconds a ray, asked one by one on one thread.

#if EMBREE == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

template <class Number> std::vector<Number> numbers(const std::string& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) throw std::runtime_error(path + ": cannot be read");
    std::vector<Number> all(static_cast<std::size_t>(file.tellg()) / sizeof(Number));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(all.data()), static_cast<std::streamsize>(all.size() * sizeof(Number)));
    return all;
}

template <class Number> void write(const std::string& path, const std::vector<Number>& all) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(all.data()), static_cast<std::streamsize>(all.size() * sizeof(Number)));
    if (!file) throw std::runtime_error(path + ": cannot be written");
}

int main(int argc, char** argv) try {
    if (argc != 2) throw std::runtime_error("usage: embree DIRECTORY");
    const std::string directory = argv[1];
    const auto xyz = numbers<double>(directory + "/vertices.f64");
    const auto corners = numbers<std::uint32_t>(directory + "/triangles.u32");
    const auto origin = numbers<double>(directory + "/origin.f64");
    const auto direction = numbers<double>(directory + "/direction.f64");

    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), xyz.size() / 3));
    auto* const triangles = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), corners.size() / 3));
    if (!vertices || !triangles) throw std::runtime_error("no memory");
    for (std::size_t k = 0; k < xyz.size(); ++k) vertices[k] = static_cast<float>(xyz[k]);
    for (std::size_t k = 0; k < corners.size(); ++k) triangles[k] = corners[k];
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene, mesh);
    rtcReleaseGeometry(mesh);
    rtcCommitScene(scene);

    const std::size_t count = origin.size() / 3;
    std::vector<RTCRayHit> rays(count);
    for (std::size_t k = 0; k < count; ++k) {
        RTCRay& ray = rays[k].ray;
        ray.org_x = static_cast<float>(origin[3 * k]);
        ray.org_y = static_cast<float>(origin[3 * k + 1]);
        ray.org_z = static_cast<float>(origin[3 * k + 2]);
        ray.dir_x = static_cast<float>(direction[3 * k]);
        ray.dir_y = static_cast<float>(direction[3 * k + 1]);
        ray.dir_z = static_cast<float>(direction[3 * k + 2]);
        ray.tnear = 0.0f;
        ray.tfar = std::numeric_limits<float>::infinity();
        ray.mask = 0xFFFFFFFFu;
        ray.flags = 0;
        rays[k].hit.geomID = rays[k].hit.primID = RTC_INVALID_GEOMETRY_ID;
    }
    const auto ask = [&](RTCRayHit& ray) {
#if EMBREE == 4
        rtcIntersect1(scene, &ray);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene, &context, &ray);
#endif
    };
    // A tenth before the clock runs.
    for (std::size_t k = 0; k < count; k += 10) {
        RTCRayHit copy = rays[k];
        ask(copy);
    }
    const auto start = std::chrono::steady_clock::now();
    for (RTCRayHit& ray : rays) ask(ray);
    const double time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw std::runtime_error("Embree reports an error");

    std::vector<float> t(count);
    std::vector<std::uint32_t> triangle(count);
    for (std::size_t k = 0; k < count; ++k) {
        t[k] = rays[k].ray.tfar;
        triangle[k] = rays[k].hit.geomID == RTC_INVALID_GEOMETRY_ID ? 0xFFFFFFFFu : rays[k].hit.primID;
    }
    write(directory + "/t.f32", t);
    write(directory + "/triangle.u32", triangle);
    std::printf("%f\n", time * 1e9 / static_cast<double>(count));
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
