// SPDX-License-Identifier: MIT
// packed.glsl in HLSL: goffer_position and goffer_normal, from attributes or from words. Compiled by glslang's HLSL
// front end; other compilers have not been tried. A GLSL type name that is a macro already is left alone.

#ifndef vec2
#define vec2 float2
#define GOFFER_VEC2
#endif
#ifndef vec3
#define vec3 float3
#define GOFFER_VEC3
#endif
#ifndef uvec3
#define uvec3 uint3
#define GOFFER_UVEC3
#endif
#include "packed.glsl"
#ifdef GOFFER_VEC2
#undef vec2
#undef GOFFER_VEC2
#endif
#ifdef GOFFER_VEC3
#undef vec3
#undef GOFFER_VEC3
#endif
#ifdef GOFFER_UVEC3
#undef uvec3
#undef GOFFER_UVEC3
#endif
