// SPDX-License-Identifier: MIT
// packed.glsl in HLSL (shader model 4 and later): goffer_position and goffer_normal, from attributes or from words.

#define vec2 float2
#define vec3 float3
#define uvec3 uint3
#include "packed.glsl"
#undef vec2
#undef vec3
#undef uvec3
