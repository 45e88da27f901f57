// SPDX-License-Identifier: MIT
#pragma once

#include "stage.hpp"

/// The groups of cases. Each function registers its group with Google Benchmark; `stage` must outlive the
/// run. README.md says what the cases are called.

namespace goffer::bench {

/// deform/<streams>/<cache|crowd|crowd10000x200>/<isa>/<threads>
void register_deform(Stage& stage);

/// sweep/<streams>/<instances>x<vertices>/<isa>/<threads>, for the widest instruction set
void register_sweep(Stage& stage);

/// setup/<instance|batch|bounds|bounds_batch|path>
void register_setup(Stage& stage);

/// bind/<vertices>
void register_bind();

/// floor/<fill|fill_nt|copy|copy_nt|fill_cache>/<threads>
void register_floor(Stage& stage);

/// naive/<streams>
void register_naive();

}  // namespace goffer::bench
