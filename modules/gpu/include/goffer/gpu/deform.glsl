// SPDX-License-Identifier: MIT
// goffer's deformation as a shader function: what a vertex becomes is what the kernels on the processor make of it, up
// to rounding. modules/gpu/README.md shows a whole shader.
//   - A GofferVertex is filled from the attributes that goffer::gpu::write_vertices() writes.
//   - Coefficients are rows of four floats, as goffer::bend::set_up() writes them: 17 for each region of an instance,
//     those of its regions one after the other. The shader defines goffer_row, which reads row `row` of them, before
//     it calls anything here: from a uniform block, a texture or a storage buffer.
//   - What is not used of the result costs nothing.
// For GLSL 3.30 and ES 3.00 and later, and Vulkan; in vertex and compute shaders. deform.hlsl is the same for HLSL.

struct GofferVertex {
    vec4 column;   // sqrt(2) cos(beta / 2), sqrt(2) sin(beta / 2); rho; height
    vec4 wrinkle;  // radial offset; wrinkle; slope; the region's number
    vec3 normal;
    vec4 shape;    // drift; taper; s / S_0; scale s: 0, 0, 0, 1 for a body that has none
    vec4 tangent;  // w: the sign
    vec4 joint;    // share of the neighbor in the wrinkle, negative: of the region before; its slope; gain; radius ratio
};

struct GofferBent {
    vec3 position;
    vec3 normal;
    vec4 tangent;  // w: the sign
};

vec4 goffer_row(int row);

vec3 goffer_row3(int row) {
    vec4 four = goffer_row(row);
    return vec3(four.x, four.y, four.z);
}

// The sum of eight terms c[n] x^n.
float goffer_series(vec4 low, vec4 high, float x) {
    float sum = ((high.w * x + high.z) * x + high.y) * x + high.x;
    return (((sum * x + low.w) * x + low.z) * x + low.y) * x + low.x;
}

float goffer_series(vec4 terms, float x) {
    return ((terms.w * x + terms.z) * x + terms.y) * x + terms.x;
}

// The amplitude of a wrinkle, its slope by beta, and minus its derivative by the logarithm of the scale.
struct GofferWrinkle {
    float amplitude;
    float slope;
    float less_by_scale;
};

// kappa_0 and rest_curl of the region whose rows begin at `row`.
vec3 goffer_rest_squeeze(int row) {
    vec4 rest = goffer_row(row + 15);
    return vec3(1.0f - goffer_row(row).z - goffer_row(row + 16).w, rest.z, rest.w);
}

// The scale of the vertex's column at rest in the region whose rows begin at `row`, over that in its own one.
float goffer_rest_ratio(GofferVertex vertex, int own_row, int row, float radius_ratio) {
    vec3 change = goffer_rest_squeeze(own_row) - radius_ratio * goffer_rest_squeeze(row);
    float cosine = vertex.column.x * vertex.column.x - 1.0f;
    float sine = vertex.column.x * vertex.column.y;
    return 1.0f + vertex.shape.z * (change.x + change.y * cosine + change.z * sine);
}

// The wrinkle of the vertex in the region whose rows begin at `row`, if the vertex is `radius_ratio` times as far from
// the axis. `rest_ratio`: 1 in the vertex's own region.
GofferWrinkle goffer_wrinkle(GofferVertex vertex, int row, float radius_ratio, float rest_ratio) {
    GofferWrinkle wrinkle;
    vec4 change = goffer_row(row + 16);
    if (change.z > 0.0f) {  // relative to the rest arc
        vec4 rest = goffer_row(row + 15);
        float per_rest_scale = vertex.shape.z / rest_ratio;
        float rest_cosine = per_rest_scale * (vertex.column.x * vertex.column.x - 1.0f);
        float rest_sine = per_rest_scale * vertex.column.x * vertex.column.y;
        float q = radius_ratio * max(change.x * rest_cosine + change.y * rest_sine + change.w * per_rest_scale, 0.0f);
        float per_root = inversesqrt(q + change.z);
        float root = q * per_root;
        float x = root * root;
        wrinkle.amplitude = root * goffer_series(goffer_row(row + 11), goffer_row(row + 12), x);
        float rest_slope = radius_ratio * (rest.z * rest_sine - rest.w * rest_cosine);
        float turned = radius_ratio * (change.y * rest_cosine - change.x * rest_sine);
        float per_q = per_root * (1.0f - 0.5f * root * per_root) *
                      goffer_series(goffer_row(row + 13), goffer_row(row + 14), x);
        wrinkle.slope = wrinkle.amplitude * rest_slope + (q > 0.0f ? per_q * (turned - q * rest_slope) : 0.0f);
        wrinkle.less_by_scale = per_q * q + (rest_ratio - 1.0f) * wrinkle.amplitude;
        wrinkle.amplitude *= rest_ratio;
        wrinkle.slope *= rest_ratio;
    } else {
        vec4 pose = goffer_row(row);
        float h_prime = vertex.column.y * pose.x - vertex.column.x * pose.y;
        float h = vertex.column.x * pose.x + vertex.column.y * pose.y;
        float x = h * h * vertex.shape.w * radius_ratio;
        wrinkle.amplitude = abs(h) * goffer_series(goffer_row(row + 11), goffer_row(row + 12), x);
        // A has a corner on the outer line, where h changes sign; the two slopes are blended across it.
        float per_turn = goffer_series(goffer_row(row + 13), goffer_row(row + 14), x);
        wrinkle.slope = clamp(h * 707.10678f, -1.0f, 1.0f) * h_prime * per_turn;
        wrinkle.less_by_scale = abs(h) * per_turn;
    }
    return wrinkle;
}

// The names are those of modules/bend/src/kernel/deform_batch.hpp, and so is the order.
GofferBent goffer_deform(GofferVertex vertex, int first_row) {
    int row = first_row + 17 * int(vertex.wrinkle.w + 0.5f);
    vec4 pose = goffer_row(row);      // cosine and sine of half the direction; 1 - kappa; curvature
    vec4 size = goffer_row(row + 3);  // first curvature; doublings; half the radius; handedness
    float scale = vertex.shape.w;

    float h_prime = vertex.column.y * pose.x - vertex.column.x * pose.y;
    float h = vertex.column.x * pose.x + vertex.column.y * pose.y;
    float t = h * h;
    float c = t - 1.0f;
    float s = h * h_prime;

    GofferWrinkle wrinkle = goffer_wrinkle(vertex, row, 1.0f, 1.0f);
    float difference = 0.0f;  // to what the region beyond a joint makes of it
    if (vertex.joint.x != 0.0f) {
        int beyond = vertex.joint.x > 0.0f ? row + 17 : row - 17;
        float radius_ratio = vertex.joint.w;
        GofferWrinkle other = goffer_wrinkle(vertex, beyond, radius_ratio,
                                             goffer_rest_ratio(vertex, row, beyond, radius_ratio));
        float share = abs(vertex.joint.x);
        float gain = vertex.joint.z;
        difference = gain * other.amplitude - wrinkle.amplitude;
        wrinkle.amplitude += share * difference;
        wrinkle.slope += share * (gain * other.slope - wrinkle.slope);
        wrinkle.less_by_scale += share * (gain * other.less_by_scale - wrinkle.less_by_scale);
    }
    float amplitude = wrinkle.amplitude;
    float rho = vertex.column.z + amplitude * vertex.wrinkle.x;
    float rho_c = rho * c;
    float rho_s = rho * s;

    float v = vertex.column.w - pose.w * vertex.shape.x;
    float arc_x = v * v * goffer_series(goffer_row(row + 2), v * v);
    float arc_z = v * goffer_series(goffer_row(row + 1), v * v);
    float curvature = size.x;
    for (float n = 0.0f; n < size.y; n += 1.0f) {  // cos 2x = 1 - 2 sin^2 x, sin 2x = 2 sin x cos x
        float cosine_of_half = 1.0f - curvature * arc_x;
        arc_x = curvature * arc_z * arc_z;
        arc_z = arc_z * cosine_of_half;
        curvature += curvature;
    }
    float stretch = pose.z - pose.w * rho_c;

    vec3 frame_n = goffer_row3(row + 4);
    vec3 frame_b = goffer_row3(row + 5);
    vec3 frame_t = goffer_row3(row + 6);
    GofferBent bent;
    bent.position = goffer_row3(row + 7) + frame_n * (arc_x * stretch + rho_c) + frame_b * rho_s +
                    frame_t * (arc_z * stretch);

    // The Jacobian in the bent frame: outward, across and along in its first row, around and stretch on its diagonal.
    float kappa = 1.0f - pose.z;
    stretch = stretch * (1.0f + kappa - kappa * scale);
    float around = 1.0f + amplitude * vertex.wrinkle.y;
    float outward = vertex.column.z < size.z * scale ? around : 1.0f;
    float across = wrinkle.slope * vertex.wrinkle.y;
    float along = amplitude * vertex.wrinkle.z - wrinkle.less_by_scale * vertex.shape.y +
                vertex.joint.y * difference * vertex.wrinkle.x;
    float cosine = 1.0f - pose.w * arc_x;
    float sine = pose.w * arc_z;

    vec3 at_rest = vertex.normal;
    vec3 local = vec3(around * stretch * at_rest.x, stretch * (outward * at_rest.y - across * at_rest.x),
                      around * (outward * at_rest.z - along * at_rest.x));
    float p = c * local.x - s * local.y;
    vec3 turned = goffer_row3(row + 8) * (p * cosine + local.z * sine) +
                  goffer_row3(row + 9) * (s * local.x + c * local.y) +
                  goffer_row3(row + 10) * (local.z * cosine - p * sine);
    bent.normal = turned * inversesqrt(dot(turned, turned) + 1e-37f);

    at_rest = vec3(vertex.tangent.x, vertex.tangent.y, vertex.tangent.z);
    local = vec3(outward * at_rest.x + across * at_rest.y + along * at_rest.z, around * at_rest.y, stretch * at_rest.z);
    p = c * local.x - s * local.y;
    turned = frame_n * (p * cosine + local.z * sine) + frame_b * (s * local.x + c * local.y) +
             frame_t * (local.z * cosine - p * sine);
    bent.tangent = vec4(turned * inversesqrt(dot(turned, turned) + 1e-37f), size.w * vertex.tangent.w);
    return bent;
}
