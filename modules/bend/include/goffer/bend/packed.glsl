// SPDX-License-Identifier: MIT
// Decodes goffer's packed vertex. `words` is the vertex as three 32-bit words (R32G32B32_UINT), little-endian.
// `low` and `high` are the instance's bounds. For GLSL 4.20 and ES 3.00 and later; a fragment shader in ES must say
// "precision highp int;" first.

vec3 goffer_position(uvec3 words, vec3 low, vec3 high) {
    return low + vec3(unpackUnorm2x16(words.x), unpackUnorm2x16(words.y).x) * (high - low);
}

vec3 goffer_normal(uvec3 words) {
    vec2 octant = unpackSnorm2x16(words.z);
    vec3 normal = vec3(octant, 1.0f - abs(octant.x) - abs(octant.y));
    float fold = max(-normal.z, 0.0f);
    normal.x += normal.x >= 0.0f ? -fold : fold;
    normal.y += normal.y >= 0.0f ? -fold : fold;
    return normalize(normal);
}
