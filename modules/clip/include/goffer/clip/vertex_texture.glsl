// SPDX-License-Identifier: MIT
// Plays a vertex-animation texture that goffer wrote: NAME.positions.png and NAME.normals.png, which NAME.json describes.
//   - Load the images with 16 bits a channel, as numbers: no sRGB, no compression, no mipmaps, no filter. They are
//     RGB16 for a sampler2D or, as in ES 3.00 and WebGL 2, which have no RGB16, RGB16UI for a usampler2D.
//   - Row 0 is the image's first, its uppermost. Where a loader turns images upside down, give GofferClip their height.
//   - `vertex` is gl_VertexID, in Vulkan gl_VertexIndex, where NAME.mesh.glb is drawn with its vertices in their order,
//     else goffer_vertex(TEXCOORD_1.x).
// For GLSL 3.30 and ES 3.00 and later, and Vulkan; vertex_texture.hlsl is the same for HLSL. A fragment shader in ES must say
// "precision highp float; precision highp int;" first.

// What NAME.json says under the same names, but for `flipped_height`.
struct GofferClip {
    int width;
    int rows_per_frame;
    vec3 low;
    vec3 high;
    int flipped_height; // 0, or the height of NAME.json where the loader turned the images upside down
};

// Two frames, and how far between them a moment is: 0 at the first one, 1 at the second.
struct GofferFrames {
    int first;
    int second;
    float share;
};

// The moment `frame` = seconds * frames_per_second of a clip that stands still before it begins and after it ends.
GofferFrames goffer_frames(float frame, int frames) {
    float within = clamp(frame, 0.0f, float(frames - 1));
    int first = min(int(within), max(frames - 2, 0));
    return GofferFrames(first, min(first + 1, frames - 1), within - float(first));
}

// The same of a clip whose last frame is followed by its first one.
GofferFrames goffer_frames_repeated(float frame, int frames) {
    float within = frame - floor(frame / float(frames)) * float(frames);
    int first = min(int(within), frames - 1);
    return GofferFrames(first, first + 1 < frames ? first + 1 : 0, within - float(first));
}

// The vertex that a TEXCOORD_1.x says, which is a whole number: 0.5 more would round the larger ones away from it.
int goffer_vertex(float number) {
    return int(number);
}

// Where a vertex is in both images.
ivec2 goffer_texel(int vertex, int frame, GofferClip clip) {
    int row = frame * clip.rows_per_frame + vertex / clip.width;
    return ivec2(vertex % clip.width, clip.flipped_height == 0 ? row : clip.flipped_height - 1 - row);
}

// `texel` has channels of 0 to 1.
vec3 goffer_decode_position(vec3 texel, GofferClip clip) {
    return clip.low + texel * (clip.high - clip.low);
}

// The result is of unit length only after normalize().
vec3 goffer_decode_normal(vec3 texel) {
    return texel * 2.0f - 1.0f;
}

vec3 goffer_position(highp sampler2D positions, int vertex, GofferFrames at, GofferClip clip) {
    vec3 first = texelFetch(positions, goffer_texel(vertex, at.first, clip), 0).xyz;
    vec3 second = texelFetch(positions, goffer_texel(vertex, at.second, clip), 0).xyz;
    return goffer_decode_position(mix(first, second, at.share), clip);
}

vec3 goffer_normal(highp sampler2D normals, int vertex, GofferFrames at, GofferClip clip) {
    vec3 first = texelFetch(normals, goffer_texel(vertex, at.first, clip), 0).xyz;
    vec3 second = texelFetch(normals, goffer_texel(vertex, at.second, clip), 0).xyz;
    return normalize(goffer_decode_normal(mix(first, second, at.share)));
}

vec3 goffer_position(highp usampler2D positions, int vertex, GofferFrames at, GofferClip clip) {
    vec3 first = vec3(texelFetch(positions, goffer_texel(vertex, at.first, clip), 0).xyz);
    vec3 second = vec3(texelFetch(positions, goffer_texel(vertex, at.second, clip), 0).xyz);
    return goffer_decode_position(mix(first, second, at.share) / 65535.0f, clip);
}

vec3 goffer_normal(highp usampler2D normals, int vertex, GofferFrames at, GofferClip clip) {
    vec3 first = vec3(texelFetch(normals, goffer_texel(vertex, at.first, clip), 0).xyz);
    vec3 second = vec3(texelFetch(normals, goffer_texel(vertex, at.second, clip), 0).xyz);
    return normalize(goffer_decode_normal(mix(first, second, at.share) / 65535.0f));
}
