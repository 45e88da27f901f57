// SPDX-License-Identifier: MIT
// deform.glsl in HLSL. Compiled by glslang's HLSL front end; other compilers have not been tried. A GLSL name that is a
// macro already is left alone.

#ifndef vec3
#define vec3 float3
#define GOFFER_VEC3
#endif
#ifndef vec4
#define vec4 float4
#define GOFFER_VEC4
#endif
#ifndef inversesqrt
#define inversesqrt rsqrt
#define GOFFER_INVERSESQRT
#endif
#include "deform.glsl"
#ifdef GOFFER_VEC3
#undef vec3
#undef GOFFER_VEC3
#endif
#ifdef GOFFER_VEC4
#undef vec4
#undef GOFFER_VEC4
#endif
#ifdef GOFFER_INVERSESQRT
#undef inversesqrt
#undef GOFFER_INVERSESQRT
#endif
