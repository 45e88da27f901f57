// SPDX-License-Identifier: MIT
#include "kernel/kernels.hpp"

#include <cassert>

namespace goffer::bend {

extern const KernelSet kernels_scalar;
extern const KernelSet kernels_sse42;
extern const KernelSet kernels_avx2;
extern const KernelSet kernels_avx512;
extern const KernelSet kernels_neon;

const KernelSet& kernels(Isa isa) noexcept {
    assert(runs_here(isa));
    switch (resolve(isa)) {
#ifdef GOFFER_HAS_SSE42
        case Isa::sse42:
            return kernels_sse42;
#endif
#ifdef GOFFER_HAS_AVX2
        case Isa::avx2:
            return kernels_avx2;
#endif
#ifdef GOFFER_HAS_AVX512
        case Isa::avx512:
            return kernels_avx512;
#endif
#ifdef GOFFER_HAS_NEON
        case Isa::neon:
            return kernels_neon;
#endif
        default:
            return kernels_scalar;
    }
}

}  // namespace goffer::bend
