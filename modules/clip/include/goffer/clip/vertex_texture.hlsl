// SPDX-License-Identifier: MIT
// Plays a vertex-animation texture that goffer wrote: vertex_texture.glsl in HLSL, for images that are loaded as
// R16G16B16A16_UNORM (three channels of 16 bits are no format of Direct3D; the fourth one means nothing).
//   - Load the images as numbers: no sRGB, no compression, no mipmaps. No sampler is needed.
//   - Row 0 is the image's first, its uppermost. Where a loader turns images upside down, give GofferClip their height.
//   - `vertex` is SV_VertexID where NAME.mesh.glb is drawn with its vertices in their order, else
//     goffer_vertex(TEXCOORD1.x).
// For shader model 4 and later. Compiled by glslang's HLSL front end; other compilers have not been tried.

// What NAME.json says under the same names, but for `flipped_height`.
struct GofferClip {
    int width;
    int rows_per_frame;
    float3 low;
    float3 high;
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
    GofferFrames at;
    at.first = min(int(within), max(frames - 2, 0));
    at.second = min(at.first + 1, frames - 1);
    at.share = within - float(at.first);
    return at;
}

// The same of a clip whose last frame is followed by its first one.
GofferFrames goffer_frames_repeated(float frame, int frames) {
    float within = frame - floor(frame / float(frames)) * float(frames);
    GofferFrames at;
    at.first = min(int(within), frames - 1);
    at.second = at.first + 1 < frames ? at.first + 1 : 0;
    at.share = within - float(at.first);
    return at;
}

// The vertex that a TEXCOORD_1.x says, which is a whole number: 0.5 more would round the larger ones away from it.
int goffer_vertex(float number) {
    return int(number);
}

// Where a vertex is in both images; the third is the mipmap, the only one.
int3 goffer_texel(int vertex, int frame, GofferClip clip) {
    int row = frame * clip.rows_per_frame + vertex / clip.width;
    return int3(vertex % clip.width, clip.flipped_height == 0 ? row : clip.flipped_height - 1 - row, 0);
}

// `texel` has channels of 0 to 1.
float3 goffer_decode_position(float3 texel, GofferClip clip) {
    return clip.low + texel * (clip.high - clip.low);
}

// The result is of unit length only after normalize().
float3 goffer_decode_normal(float3 texel) {
    return texel * 2.0f - 1.0f;
}

float3 goffer_position(Texture2D<float4> positions, int vertex, GofferFrames at, GofferClip clip) {
    float3 first = positions.Load(goffer_texel(vertex, at.first, clip)).xyz;
    float3 second = positions.Load(goffer_texel(vertex, at.second, clip)).xyz;
    return goffer_decode_position(lerp(first, second, at.share), clip);
}

float3 goffer_normal(Texture2D<float4> normals, int vertex, GofferFrames at, GofferClip clip) {
    float3 first = normals.Load(goffer_texel(vertex, at.first, clip)).xyz;
    float3 second = normals.Load(goffer_texel(vertex, at.second, clip)).xyz;
    return normalize(goffer_decode_normal(lerp(first, second, at.share)));
}
