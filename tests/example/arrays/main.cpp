// SPDX-License-Identifier: MIT
// A program that has an OpenCL context, a queue and triangles of its own: the tree is built and traced there, and hits
// stay in a buffer that the program's own kernels can read.
#include <iostream>
#include <limits>
#include <vector>

#include <CL/cl.h>

#include <boxwood/build.hpp>
#include <boxwood/trace.hpp>

int main() {
    cl_platform_id platform = nullptr;
    cl_device_id own_device = nullptr;
    cl_int status = clGetPlatformIDs(1, &platform, nullptr);
    status |= clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &own_device, nullptr);
    if (status != CL_SUCCESS) return 1;
    cl_context context = clCreateContext(nullptr, 1, &own_device, nullptr, nullptr, &status);
    cl_command_queue queue = clCreateCommandQueueWithProperties(context, own_device, nullptr, &status);
    cl_mem answers = clCreateBuffer(context, CL_MEM_READ_WRITE, sizeof(boxwood::Hit), nullptr, &status);
    bool good = false;
    {
        boxwood::Device device(context, queue);
        const std::vector<glm::vec3> positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
        const std::vector<glm::uvec3> triangles = {{0, 1, 2}};
        const boxwood::Tree tree = boxwood::build(device, positions, triangles);

        const std::vector<boxwood::Ray> rays = {{{0, 0, 2}, 0, {0, 0, -1}, std::numeric_limits<float>::infinity()}};
        const auto queries = boxwood::upload(device, rays, "rays");
        const boxwood::BufferView<boxwood::Hit> hits(answers, 1);
        boxwood::closest_hit(device, tree, queries, hits);

        const boxwood::Hit hit = boxwood::download(device, hits)[0];
        std::cout << "triangle " << hit.primitive << " at t = " << hit.t << '\n';
        good = hit.primitive == 0 && hit.t == 2.0f;
    }
    clReleaseMemObject(answers);
    clReleaseCommandQueue(queue);
    clReleaseContext(context);
    return good ? 0 : 1;
}
