// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/body_file.hpp>
#include <goffer/bend/crowd.hpp>
#include <goffer/bend/sockets.hpp>
#include <goffer/fit/bind.hpp>

#include <goffer.h>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// C's structs as C++ has them, and what stands behind its handles.

/// A body of its own, or one of a file.
struct goffer_body {
    std::optional<goffer::fit::Binding> binding;  ///< where it was bound here
    std::vector<int> suitable_folds = {};         ///< of each region, then
    const goffer::bend::Body* body = nullptr;     ///< the binding's, or the file's
};

struct goffer_crowd {
    std::vector<goffer::bend::Batch> batches;
    std::uint32_t frame = 0;
    goffer::bend::Stores stores = goffer::bend::Stores::automatic;
    goffer::Isa isa = goffer::Isa::automatic;

    [[nodiscard]] goffer::bend::CrowdJob job() const noexcept {
        goffer::bend::CrowdJob job;
        job.batches = batches;
        job.frame = frame;
        job.stores = stores;
        job.isa = isa;
        return job;
    }
};

namespace goffer::c {

inline void say(goffer_error* error, const char* text) noexcept {
    if (error != nullptr) std::snprintf(error->text, sizeof error->text, "%s", text);
}

/// What `work` returns, or nothing where it throws; *error says which.
template <class Work>
auto guarded(goffer_error* error, Work&& work) noexcept -> decltype(work()) {
    say(error, "");
    try {
        return work();
    } catch (const std::bad_alloc&) {
        say(error, "not enough memory");
    } catch (const std::exception& thrown) {
        say(error, thrown.what());
    } catch (...) {
        say(error, "an unknown error");
    }
    return {};
}

[[nodiscard]] inline const bend::Body* body_of(const goffer_body* body) noexcept {
    return body != nullptr ? body->body : nullptr;
}

/// One that does not run here where the number means nothing.
[[nodiscard]] inline Isa isa_of(int isa) noexcept {
    return static_cast<Isa>(isa >= GOFFER_ISA_AUTOMATIC && isa <= GOFFER_ISA_NEON ? isa : 255);
}

[[nodiscard]] bend::DeformJob job_of(const goffer_job& job) noexcept;
[[nodiscard]] Stream3 stream3(const goffer_stream& stream) noexcept;
[[nodiscard]] Stream4 stream4(const goffer_stream& stream) noexcept;
[[nodiscard]] bend::PackedStream packed_of(const goffer_packed_stream& stream) noexcept;
[[nodiscard]] goffer_bounds bounds_of(const bend::Bounds& bounds) noexcept;
[[nodiscard]] fit::Geometry geometry_of(const goffer_mesh& mesh);
/// Throws where `body` cannot have them.
[[nodiscard]] goffer_sockets* make_sockets(const bend::Body& body, std::span<const bend::Socket> sockets);

}  // namespace goffer::c
