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
#include <stdexcept>
#include <string>
#include <vector>

/// C's structs as C++ has them, and what stands behind its handles.

/// A body of its own, or one of a file.
struct goffer_body {
    std::optional<goffer::fit::Binding> binding;  ///< where it was bound here
    std::vector<goffer_folds> folds = {};         ///< of each region, then
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

// Bounds are written as C++ has them.
static_assert(sizeof(goffer_bounds) == sizeof(bend::Bounds));

inline void say(goffer_error* error, int code, const char* text) noexcept {
    if (error == nullptr) return;
    std::snprintf(error->text, sizeof error->text, "%s", text);
    error->code = code;
}

/// Whether there is no fault; *error says which there is.
inline int say_fault(goffer_error* error, const bend::Fault& fault) noexcept {
    if (fault.none()) return say(error, GOFFER_ERROR_NONE, ""), 1;
    return say(error, GOFFER_ERROR_ARGUMENT, bend::describe(fault).c_str()), 0;
}

/// What `work` returns, or nothing where it throws; *error says which. A std::logic_error is the caller's.
template <class Work>
auto guarded(goffer_error* error, Work&& work) noexcept -> decltype(work()) {
    say(error, GOFFER_ERROR_NONE, "");
    try {
        return work();
    } catch (const std::bad_alloc&) {
        say(error, GOFFER_ERROR_MEMORY, "not enough memory");
    } catch (const std::length_error&) {  // of an array that no memory could hold
        say(error, GOFFER_ERROR_MEMORY, "not enough memory");
    } catch (const std::logic_error& thrown) {
        say(error, GOFFER_ERROR_ARGUMENT, thrown.what());
    } catch (const fit::Error& thrown) {
        say(error, GOFFER_ERROR_BIND, thrown.what());
    } catch (const std::exception& thrown) {
        say(error, GOFFER_ERROR_OTHER, thrown.what());
    } catch (...) {
        say(error, GOFFER_ERROR_OTHER, "an unknown error");
    }
    return {};
}

[[nodiscard]] inline const bend::Body* body_of(const goffer_body* body) noexcept {
    return body != nullptr ? body->body : nullptr;
}

/// Batch `index` of a crowd; null where there is none that has a body and `poses`.
[[nodiscard]] inline const bend::Batch* posed_batch(
    const goffer_crowd* crowd, std::size_t index,
    StridedView<bend::Pose> bend::Batch::*poses = &bend::Batch::poses) noexcept {
    if (crowd == nullptr || index >= crowd->batches.size()) return nullptr;
    const bend::Batch& batch = crowd->batches[index];
    return batch.body != nullptr && !(batch.*poses).empty() ? &batch : nullptr;
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
/// Throws where there are none: Sockets::make refused them.
[[nodiscard]] goffer_sockets* handle_of(std::optional<bend::Sockets> made);

}  // namespace goffer::c
