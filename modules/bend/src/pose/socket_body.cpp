// SPDX-License-Identifier: MIT
#include <goffer/bend/body_input.hpp>
#include <goffer/bend/sockets.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace goffer::bend {

std::optional<Sockets> Sockets::make(const Body& body, std::span<const Socket> sockets) {
    std::vector<std::size_t> place(sockets.size());
    std::iota(place.begin(), place.end(), std::size_t{0});
    std::ranges::stable_sort(place, {}, [&](std::size_t i) {  // by height too, as blends ask for
        const double z = sockets[i].vertex.z;
        return std::pair(sockets[i].region, std::isnan(z) ? 0 : z);
    });
    std::vector<std::size_t> counts(body.region_count());
    std::vector<RestVertex> vertices;
    std::vector<RestVector> normals, tangents;
    for (const std::size_t i : place) {
        if (sockets[i].region >= counts.size()) return std::nullopt;
        ++counts[sockets[i].region];
        vertices.push_back(sockets[i].vertex);
        normals.push_back(sockets[i].normal);
        tangents.push_back(sockets[i].tangent);
    }
    const std::span<const RegionInput> own = body.region_inputs();
    std::vector<RegionInput> regions(own.begin(), own.end());
    for (std::size_t r = 0; r < counts.size(); ++r) regions[r].vertex_count = counts[r];
    const std::vector<float> signs(sockets.size(), 1.0f);
    BodyInput input;
    input.origin = body.origin();
    input.axes = body.axes();
    input.radius = body.radius();
    input.regions = regions;
    input.vertices = vertices;
    input.normals = normals;
    input.tangents = tangents;
    input.tangent_signs = signs;
    std::optional<Body> made = Body::make(input);
    if (!made) return std::nullopt;
    Sockets result(std::move(*made));
    result.place_ = std::move(place);
    return result;
}

std::optional<Sockets> Sockets::make(const Body& body, std::span<const NamedSocket> sockets) {
    std::vector<Socket> places;
    for (const NamedSocket& socket : sockets) places.push_back(socket.socket);
    return make(body, places);
}

}  // namespace goffer::bend
