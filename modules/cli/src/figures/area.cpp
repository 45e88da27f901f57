// SPDX-License-Identifier: MIT
#include "figures/bending.hpp"
#include "figures/figure.hpp"
#include "figures/skin.hpp"
#include "progress.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// The area of a model against the angle that it is bent by.

namespace goffer::cli {
namespace {

constexpr int few_bones = 2, many_bones = 8;

/// The model bound anew, with another amplitude: the same mesh.
BoundModel with_amplitude(const BoundModel& model, fit::Amplitude amplitude) {
    BoundModel other;
    other.rest = model.rest;
    other.wrinkle_mask = model.wrinkle_mask;
    fit::BindOptions options;
    options.amplitude = amplitude;
    if (model.cylinder.radii.empty())
        options.shape = fit::ShapeMode::cylinder;  // that was looked for already
    other.binding =
        in_file(model.file, [&] { return fit::bind(geometry_of(other), model.cylinder, options); });
    return other;
}

/// Changes of the area of one mesh, as a whole and locally.
class Areas {
public:
    explicit Areas(const BoundModel& model)
        : rest_(model.rest),
          before_(of(model.rest.positions)),
          patches_(fit::patches_of(geometry_of(rest_), model.cylinder)) {}

    [[nodiscard]] double change(std::span<const glm::vec3> positions) const {
        return of(positions) / before_ - 1;
    }
    /// The root mean square over patches, as `goffer bend` has them.
    [[nodiscard]] double local_rms(std::span<const glm::vec3> positions) const {
        return fit::patch_change(geometry_of(rest_), positions, patches_).rms;
    }

private:
    [[nodiscard]] double of(std::span<const glm::vec3> positions) const {
        return fit::surface_area(positions, rest_.triangles);
    }

    const mesh::VertexArrays& rest_;
    double before_;
    std::vector<std::uint32_t> patches_;
};

std::string words(const Table& t, const std::string& name, bool by_area) {
    const std::size_t last = t.rows() - 1;
    const auto at_last = [&](const char* column) { return html(t, last, column, Shown::change); };
    return "The change of the area of " + html_text(name) + ", on the mesh that goffer refined, " +
           html(t, 0, "vertices", Shown::whole) + " vertices, which is the same for all. Bent by " +
           html(t, last, "angle_degrees") +
           " degrees, the farthest that it goes, the bare bend changes it by " + at_last("bare") +
           ", linear-blend skinning with " + html(t, 0, "few_bones", Shown::whole) + " bones by " +
           at_last("skin_few_bones") + " and with " + html(t, 0, "many_bones", Shown::whole) + " bones by " +
           at_last("skin_many_bones") +
           " (bones of equal length along the axis, weights linear between their middles). goffer&rsquo;s "
           "even "
           "folds change it by " +
           at_last("amplitude_paper") + " with the amplitude of equation 7 on the base" +
           (by_area ? ", by " + at_last("amplitude_area") +
                          " with one that keeps the area of the base as a whole (on one radius)"
                    : "") +
           ", and by " + at_last("amplitude_mesh") +
           " with one that is solved on the mesh&rsquo;s own triangles, the default. The whole says little "
           "of the parts: over slices along the "
           "body and sides about it, the area with " +
           html(t, last, "many_bones", Shown::whole) + " bones is off by " +
           html(t, last, "skin_many_bones_local_rms", Shown::percent) + ", and by " +
           html(t, last, "amplitude_mesh_local_rms", Shown::percent) +
           " with that default (root mean square)." +
           (by_area ? ""
                    : " There is no amplitude that keeps the area of the base where a body is bent at rest.");
}

constexpr const char* area_script = R"gp(set xlabel "angle, degrees"
set ylabel "change of area, per cent"
set xzeroaxis lw 1 lc rgb "#333333"
set key bottom left Left reverse maxcols 1 samplen 2.5
plot data using "angle_degrees":(100 * column("bare")) with lines lw 2 lc rgb "#777777" title "bare bend", \
     data using "angle_degrees":(100 * column("skin_few_bones")) with lines lw 2 dt 2 lc rgb "#c98a00" title "skinning, 2 bones", \
     data using "angle_degrees":(100 * column("skin_many_bones")) with lines lw 2 dt 3 lc rgb "#c98a00" title "skinning, 8 bones", \
     data using "angle_degrees":(100 * column("amplitude_paper")) with lines lw 2 lc rgb "#d55e00" title "amplitude paper", \
     data using "angle_degrees":(100 * column("amplitude_area")) with lines lw 2 lc rgb "#009e73" title "amplitude area", \
     data using "angle_degrees":(100 * column("amplitude_mesh")) with lines lw 2 lc rgb "#0072b2" title "amplitude mesh"
)gp";

}  // namespace

Figure area_figure(Workshop& workshop, const BoundModel& model) {
    Figure figure{
        .name = "area",
        .title = "Area against angle",
        .table = Table({"angle_degrees", "bare", "skin_few_bones", "skin_many_bones", "amplitude_paper",
                        "amplitude_area", "amplitude_mesh", "skin_many_bones_local_rms",
                        "amplitude_mesh_local_rms", "few_bones", "many_bones", "vertices"})};
    const Progress progress("measuring areas of " + model.file.filename().string());
    const bool by_area = model.cylinder.rest_angle == 0;
    std::vector<BoundModel> others;
    others.push_back(with_amplitude(model, fit::Amplitude::paper));
    if (by_area) others.push_back(with_amplitude(model, fit::Amplitude::area));
    double largest = largest_by(model.binding.body);
    for (const BoundModel& other : others) largest = std::min(largest, largest_by(other.binding.body));

    const Areas areas(model);
    const Skin few(model, few_bones), many(model, many_bones);
    const std::size_t samples = workshop.plan.area_samples;
    for (std::size_t i = 0; i < samples; ++i) {
        const double angle = largest * static_cast<double>(i) / static_cast<double>(samples - 1);
        const auto bent = [&](const BoundModel& one) {
            const std::array poses{pose_by(one.binding.body, angle)};
            return areas.change(bent_positions(one, poses));
        };
        const std::array poses{pose_by(model.binding.body, angle)};
        const std::vector<glm::vec3> skinned = many.positions(radians(angle));
        const std::vector<glm::vec3> wrinkled = bent_positions(model, poses);
        figure.table.add({angle, areas.change(bent_positions(model, poses, 0)),
                          areas.change(few.positions(radians(angle))), areas.change(skinned), bent(others[0]),
                          by_area ? Table::Cell(bent(others[1])) : Table::Cell(), areas.change(wrinkled),
                          areas.local_rms(skinned), areas.local_rms(wrinkled), double{few_bones},
                          double{many_bones}, static_cast<double>(model.rest.positions.size())});
    }
    figure.paragraphs.push_back(words(figure.table, model.file.filename().string(), by_area));
    figure.script = area_script;
    return figure;
}

}  // namespace goffer::cli
