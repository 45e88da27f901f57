// SPDX-License-Identifier: MIT
#pragma once

#include "fixture.hpp"

/// The groups of cases. Each function registers its group with Google Benchmark; `fixture` must outlive the
/// run. README.md says what the cases are called.

namespace goffer::bench {

/// deform/<streams>/<crowd>/<isa>/<threads>
void register_deform(Fixture& fixture);

/// sweep/<streams>/<instances>x<vertices>/<isa>/<threads>, for the widest instruction set
void register_sweep(Fixture& fixture);

/// setup/<what>
void register_setup(Fixture& fixture);

/// bind/<vertices>
void register_bind();

/// load/<everything|checksum|layout>/<vertices>
void register_load();

/// floor/<fill|fill_nt|copy|copy_nt|fill_cache>/<threads>
void register_floor(Fixture& fixture);

/// naive/<streams>
void register_naive();

}  // namespace goffer::bench
