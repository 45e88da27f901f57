// SPDX-License-Identifier: MIT
// Decodes goffer's packed vertex, which a shader gets in either of two ways:
//   - as attributes: position as R16G16B16A16_UNORM, whose w means nothing, and `octant` as R16G16_SNORM;
//   - as `words`: three 32-bit words (R32G32B32_UINT), little-endian, from an attribute or a storage buffer.
// `low` and `high` are the instance's bounds. The normal is that of the space that the bounds are in.
// For GLSL 3.30 and ES 3.00 and later, and Vulkan; packed.hlsl is the same for HLSL. A fragment shader in ES must say
// "precision highp float; precision highp int;" first.

vec3 goffer_position(vec3 position, vec3 low, vec3 high) {
    return low + position * (high - low);
}

vec3 goffer_normal(vec2 octant) {
    vec3 normal = vec3(octant, 1.0f - abs(octant.x) - abs(octant.y));
    float fold = max(-normal.z, 0.0f);
    normal.x += normal.x >= 0.0f ? -fold : fold;
    normal.y += normal.y >= 0.0f ? -fold : fold;
    return normalize(normal);
}

vec3 goffer_position(uvec3 words, vec3 low, vec3 high) {
    vec3 steps = vec3(float(words.x & 0xffffu), float(words.x >> 16), float(words.y & 0xffffu));
    return goffer_position(steps / 65535.0f, low, high);
}

vec3 goffer_normal(uvec3 words) {
    vec2 steps = vec2(float(int(words.z << 16) >> 16), float(int(words.z) >> 16));
    return goffer_normal(max(steps / 32767.0f, vec2(-1.0f, -1.0f)));
}
