// SPDX-License-Identifier: MIT
#include "convert.hpp"

#include <goffer/fit/cylinder.hpp>
#include <goffer/fit/refine.hpp>
#include <goffer/fit/suitability.hpp>

#include <memory>
#include <stdexcept>

using namespace goffer;
using namespace goffer::c;

static_assert(GOFFER_MAX_REGIONS == bend::max_regions);
// The arrays of C are read as those of GLM.
static_assert(sizeof(glm::vec3) == 3 * sizeof(float) && sizeof(glm::vec4) == 4 * sizeof(float));

namespace {

fit::Profile profile_of(const goffer_bind_options& options) {
    constexpr paper::Profile::Kind kinds[] = {paper::Profile::Kind::even, paper::Profile::Kind::damped,
                                              paper::Profile::Kind::smooth};
    if (options.profile < GOFFER_PROFILE_EVEN || options.profile > GOFFER_PROFILE_SMOOTH)
        throw std::invalid_argument(
            "profile: there is no such profile; use GOFFER_PROFILE_EVEN, GOFFER_PROFILE_DAMPED or "
            "GOFFER_PROFILE_SMOOTH");
    return {kinds[options.profile], options.roundness};
}

fit::Amplitude amplitude_of(const goffer_bind_options& options) {
    constexpr fit::Amplitude amplitudes[] = {fit::Amplitude::none, fit::Amplitude::paper,
                                             fit::Amplitude::area, fit::Amplitude::mesh};
    if (options.amplitude < GOFFER_AMPLITUDE_NONE || options.amplitude > GOFFER_AMPLITUDE_MESH)
        throw std::invalid_argument("amplitude: there is no such amplitude; use one of GOFFER_AMPLITUDE_..");
    return amplitudes[options.amplitude];
}

/// Whether the body may be bent along a chain of arcs at rest.
bool may_be_chain(const goffer_bind_options& given) {
    return given.arcs < 0 || given.arcs > 1;
}

fit::BindOptions options_of(const goffer_bind_options& given) {
    fit::BindOptions options;
    options.profile = profile_of(given);
    options.amplitude = amplitude_of(given);
    if (given.folds >= 0) options.folds = given.folds;
    if (given.fold_length != 0) options.fold_length = given.fold_length;
    if (given.one_radius != 0) options.shape = fit::ShapeMode::cylinder;
    options.folds_over_joints = given.folds_apart == 0;
    if (!(given.onset < 0)) options.onset = given.onset;
    options.wrinkle_range = {given.wrinkle_first, given.wrinkle_last};
    if (may_be_chain(given) && (given.straight != 0 || given.region_count > 0))
        throw std::invalid_argument("arcs: each arc is a region of its own; leave out shares and straight");
    if (given.region_count > 0 && given.shares == nullptr)
        throw std::invalid_argument("shares: null; give one for each region");
    if (given.region_count > bend::max_regions)  // before any is read
        throw std::invalid_argument("regions: there are more than GOFFER_MAX_REGIONS; give 32 at most");
    for (std::size_t i = 0; i < given.region_count; ++i)
        options.regions.push_back({given.shares[i], std::nullopt});
    return options;
}

fit::Binding bind(const goffer_mesh& mesh, const goffer_bind_options& given,
                  const fit::BindOptions& options) {
    const fit::Geometry geometry = geometry_of(mesh);
    fit::check(geometry);
    std::optional<glm::dvec3> axis;
    if (given.axis != nullptr) axis = glm::dvec3(given.axis[0], given.axis[1], given.axis[2]);
    const auto rest = may_be_chain(given)   ? fit::RestPose::chain
                      : given.straight != 0 ? fit::RestPose::straight
                                            : fit::RestPose::automatic;
    const std::size_t arcs = given.arcs > 1 ? static_cast<std::size_t>(given.arcs) : 0;
    return fit::bind(geometry, fit::fit_cylinder(geometry, axis, rest, arcs), options);
}

static_assert(GOFFER_SHORTAGE_LENGTH == static_cast<int>(fit::FoldShortage::length));

std::vector<goffer_folds> folds_of(const fit::Binding& binding, const fit::BindOptions& options) {
    const std::vector<int> suitable = fit::suitable_folds(binding.cylinder, options);
    const std::vector<fit::FoldShortage> shortages = fit::fold_shortages(binding, options);
    std::vector<goffer_folds> folds;
    for (std::size_t r = 0; r < suitable.size(); ++r) {
        folds.push_back(
            {binding.folds(r), binding.folds_capacity(r), suitable[r], static_cast<int>(shortages[r])});
    }
    return folds;
}

}  // namespace

fit::Geometry goffer::c::geometry_of(const goffer_mesh& mesh) {
    if (mesh.positions == nullptr)
        throw std::invalid_argument("positions: null; give 3 floats for each vertex");
    if (mesh.triangles == nullptr)
        throw std::invalid_argument("triangles: null; give 3 indices for each triangle");
    const auto vectors = [&](const float* first) {
        return std::span(reinterpret_cast<const glm::vec3*>(first), first != nullptr ? mesh.vertex_count : 0);
    };
    const std::span tangents(reinterpret_cast<const glm::vec4*>(mesh.tangents),
                             mesh.tangents != nullptr ? mesh.vertex_count : 0);
    const std::span mask(mesh.wrinkle_mask, mesh.wrinkle_mask != nullptr ? mesh.vertex_count : 0);
    return {vectors(mesh.positions),
            {mesh.triangles, 3 * mesh.triangle_count},
            vectors(mesh.normals),
            tangents,
            mask};
}

const char* goffer_version(void) {
    return GOFFER_VERSION;
}

goffer_bind_options goffer_bind_defaults(void) {
    goffer_bind_options options = {};
    options.profile = GOFFER_PROFILE_EVEN;
    options.amplitude = GOFFER_AMPLITUDE_PAPER;
    options.roundness = 0.25;
    options.folds = -1;
    options.onset = -1;
    options.wrinkle_last = 1;
    return options;
}

goffer_body* goffer_body_bind(const goffer_mesh* mesh, const goffer_bind_options* options,
                              goffer_error* error) {
    return guarded(error, [&]() -> goffer_body* {
        if (mesh == nullptr) throw std::invalid_argument("mesh: null");
        auto body = std::make_unique<goffer_body>();
        const goffer_bind_options given = options != nullptr ? *options : goffer_bind_defaults();
        const fit::BindOptions wanted = options_of(given);
        body->binding = bind(*mesh, given, wanted);
        body->folds = folds_of(*body->binding, wanted);
        body->body = &body->binding->body;
        return body.release();
    });
}

goffer_body* goffer_body_bind_level(const goffer_mesh* level, const goffer_body* rig, goffer_error* error) {
    return guarded(error, [&]() -> goffer_body* {
        if (level == nullptr) throw std::invalid_argument("level: null");
        if (rig == nullptr) throw std::invalid_argument("rig: null");
        if (!rig->binding)
            throw std::invalid_argument("rig: a body of a file, which has its levels; bind the model's mesh");
        auto body = std::make_unique<goffer_body>();
        body->binding = fit::bind_level(geometry_of(*level), *rig->binding);
        body->folds = rig->folds;
        for (std::size_t r = 0; r < body->folds.size(); ++r)
            body->folds[r].capacity = body->binding->folds_capacity(r);
        body->body = &body->binding->body;
        return body.release();
    });
}

void goffer_body_free(goffer_body* body) {
    if (body != nullptr && body->binding) delete body;
}

size_t goffer_body_vertex_count(const goffer_body* body) {
    return body != nullptr ? body->body->vertex_count() : 0;
}

size_t goffer_body_region_count(const goffer_body* body) {
    return body != nullptr ? body->body->region_count() : 0;
}

int goffer_body_has_tangents(const goffer_body* body) {
    return body != nullptr && body->body->has_tangents() ? 1 : 0;
}

double goffer_body_length(const goffer_body* body) {
    return body != nullptr ? body->body->length() : 0;
}

double goffer_body_radius(const goffer_body* body) {
    return body != nullptr ? body->body->radius() : 0;
}

float goffer_body_max_angle(const goffer_body* body, size_t region) {
    return region < goffer_body_region_count(body) ? body->body->max_angle(region) : 0;
}

goffer_pose goffer_body_rest_pose(const goffer_body* body, size_t region) {
    if (region >= goffer_body_region_count(body)) return {0, 0};
    const bend::Pose rest = body->body->rest_pose(region);
    return {rest.angle, rest.direction};
}

const uint32_t* goffer_body_order(const goffer_body* body) {
    if (body == nullptr || !body->binding || body->binding->order.empty()) return nullptr;
    return body->binding->order.data();
}

goffer_base goffer_body_base(const goffer_body* body) {
    if (body == nullptr || !body->binding) return {};
    const fit::Cylinder& found = body->binding->cylinder;
    goffer_base base = {};
    for (int i = 0; i < 3; ++i) {
        base.origin[i] = found.origin[i];
        base.axis[i] = found.axis[i];
        base.zero[i] = found.zero[i];
    }
    base.length = found.length;
    base.radius = found.radius;
    base.rest_angle = found.rest_angle;
    base.rest_direction = found.rest_direction;
    base.residual = found.residual;
    return base;
}

goffer_folds goffer_body_folds(const goffer_body* body, size_t region) {
    return body != nullptr && region < body->folds.size() ? body->folds[region] : goffer_folds{};
}
