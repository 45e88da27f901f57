// SPDX-License-Identifier: MIT
#include "file/load_level.hpp"

#include "body/check.hpp"

#include <memory>
#include <utility>
#include <vector>

namespace goffer::bend {
namespace {

/// Whether two records differ by no more than rounding, and numbers that a processor may take for 0.
bool agree(const FirstBandsRecord& a, const FirstBandsRecord& b) {
    const auto near = [](float x, float y) {
        return std::fabs(x - y) <= 1e-5f * std::max(std::fabs(x), std::fabs(y)) + 1e-30f;
    };
    const auto all_near = [&](const auto& x, const auto& y) { return std::ranges::equal(x, y, near); };
    return a.vertex_count == b.vertex_count && a.shaped == b.shaped && near(a.lowest, b.lowest) &&
           near(a.highest, b.highest) && near(a.drift_error, b.drift_error) &&
           near(a.max_drift_step, b.max_drift_step) && near(a.max_scale, b.max_scale) &&
           all_near(a.rho, b.rho) && all_near(a.outward, b.outward) && all_near(a.inward, b.inward) &&
           all_near(a.drift, b.drift);
}

class LevelLoader {
public:
    LevelLoader(const LevelContext& context, std::size_t index) : context_(context), index_(index) {}

    [[nodiscard]] BodyFileFault load(BodyFileLevel& level) {
        const auto records = context_.sections.get<LevelRecord>(FileSection::level, index_);
        if (records.size() != 1) return bad_count(FileSection::level);
        const LevelRecord& record = records[0];
        auto data = std::make_unique<BodyData>();
        if (const BodyFileFault fault = place_columns(*data, record); !fault.none()) return fault;
        if (const BodyFileFault fault = load_regions(*data); !fault.none()) return fault;
        if (context_.everything) {
            if (const BodyFileFault fault = check_numbers(*data); !fault.none()) return fault;
        }
        const float *low = record.low, *high = record.high;
        const bool box = all_finite({low, 3}) && all_finite({high, 3}) && low[0] <= high[0] &&
                         low[1] <= high[1] && low[2] <= high[2];
        if (!box) return bad_number(FileSection::level, 0);
        level.rest_bounds = {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
        const std::size_t vertices = data->vertex_count;
        level.body = Body(data.release());
        return load_mesh(level.mesh, vertices);
    }

private:
    [[nodiscard]] BodyFileFault place_columns(BodyData& data, const LevelRecord& record) {
        if (record.vertex_count == 0) return bad_count(FileSection::level);
        if (record.tangents > 1 || record.shape > 1 || record.rest > 1 || record.zero != 0)
            return {FileReason::layout, FileSection::level};
        const auto columns = context_.sections.get<float>(FileSection::columns, index_);
        data.layout = {record.tangents == 1, record.shape == 1, record.rest == 1};
        constexpr std::uint64_t line = column_alignment / sizeof(float);
        const bool padded = record.stride >= widest_batch && record.stride % line == 0 &&
                            record.vertex_count <= record.stride - widest_batch;
        if (!padded) return {FileReason::layout, FileSection::level};
        if (columns.size() % data.layout.columns() != 0 ||
            columns.size() / data.layout.columns() != record.stride)
            return bad_count(FileSection::columns);
        data.stride = static_cast<std::size_t>(record.stride);
        data.vertex_count = static_cast<std::size_t>(record.vertex_count);
        data.columns = columns_at(columns.data(), data.stride, data.layout);
        data.memory = context_.holdings;
        return {};
    }

    /// The bands, of any version. In version 1 wrinkles pass no joint: its vertices are near none.
    [[nodiscard]] std::vector<BandsRecord> bands_records(const BodyData& data) const {
        if (context_.sections.version() != 1) {
            const auto records = context_.sections.get<BandsRecord>(FileSection::bands, index_);
            return {records.begin(), records.end()};
        }
        const float no_scale = data.layout.shape ? 0.0f : 1.0f;
        std::vector<BandsRecord> records;
        for (const FirstBandsRecord& record :
             context_.sections.get<FirstBandsRecord>(FileSection::bands, index_))
            records.push_back({record, 0, record.vertex_count, no_scale, no_scale});
        return records;
    }

    [[nodiscard]] BodyFileFault load_regions(BodyData& data) {
        const std::vector<BandsRecord> records = bands_records(data);
        if (records.size() != context_.rig.regions.size()) return bad_count(FileSection::bands);
        data.inputs.assign(context_.rig.regions.begin(), context_.rig.regions.end());
        const bool compares = std::ranges::any_of(context_.rig.regions, compares_with_rest);
        if (compares && !data.layout.rest) return {FileReason::layout, FileSection::level};
        std::size_t left = data.vertex_count;
        for (std::size_t r = 0; r < records.size(); ++r) {
            if (records[r].first.vertex_count > left) return bad_count(FileSection::bands);
            data.inputs[r].vertex_count = static_cast<std::size_t>(records[r].first.vertex_count);
            left -= data.inputs[r].vertex_count;
        }
        if (left != 0) return bad_count(FileSection::bands);
        set_frame(data, context_.rig.origin, context_.rig.axes, context_.rig.radius);
        for (std::size_t r = 0; r < records.size(); ++r) {
            const std::optional<Bands> bands = bands_from(records[r].first);
            if (!bands) return bad_number(FileSection::bands, r);
            add_region(data, data.inputs[r], *bands);
            if (!set_joints(data, records[r])) return bad_number(FileSection::bands, r);
        }
        return {};
    }

    /// Sets which vertices of the last region are near its joints, or returns false: they cannot be.
    static bool set_joints(BodyData& data, const BandsRecord& record) {
        auto& [below, above] = data.details.back().joints;
        const auto [first, last] = std::pair(data.regions.back().first, data.regions.back().last);
        const bool apart = record.below_last <= record.above_first && record.above_first <= last - first;
        const auto scales = [](float scale) { return scale >= 0 && scale <= WorkingRange::max_scale; };
        if (!apart || !scales(record.below_scale) || !scales(record.above_scale)) return false;
        below.first = first;
        below.last = first + static_cast<std::size_t>(record.below_last);
        above.first = first + static_cast<std::size_t>(record.above_first);
        above.last = last;
        below.max_scale = record.below_scale;
        above.max_scale = record.above_scale;
        return (below.blends() || below.first == below.last) && (above.blends() || above.first == above.last);
    }

    static std::optional<Bands> bands_from(const FirstBandsRecord& record) {
        const float numbers[] = {record.lowest, record.highest, record.drift_error, record.max_drift_step,
                                 record.max_scale};
        const bool finite = all_finite(numbers) && all_finite(record.rho) && all_finite(record.outward) &&
                            all_finite(record.inward) && all_finite(record.drift);
        constexpr float end = 0.5f + 2e-3f;  // of v, with what WorkingRange lets lie beyond it
        const bool along = -end <= record.lowest && record.lowest <= record.highest && record.highest <= end;
        if (!finite || !along || record.shaped > 1) return std::nullopt;
        Bands bands;
        bands.lowest = record.lowest;
        bands.highest = record.highest;
        bands.drift_error = record.drift_error;
        bands.max_drift_step = record.max_drift_step;
        bands.max_scale = record.max_scale;
        bands.shaped = record.shaped == 1;
        std::ranges::copy(record.rho, bands.rho.begin());
        std::ranges::copy(record.outward, bands.outward.begin());
        std::ranges::copy(record.inward, bands.inward.begin());
        std::ranges::copy(record.drift, bands.drift.begin());
        return bands;
    }

    /// The columns, what lies between them, and what was derived from them.
    [[nodiscard]] BodyFileFault check_numbers(BodyData& data) const {
        const float* column = data.columns.cos_half_beta;
        for (std::size_t c = 0; c < data.layout.columns(); ++c, column += data.stride) {
            const auto padding = std::as_bytes(std::span(column + data.vertex_count, column + data.stride));
            if (!std::ranges::all_of(padding, [](std::byte byte) { return byte == std::byte{0}; }))
                return {FileReason::layout, FileSection::columns};
        }
        if (const BodyFault fault = check_columns(data); !fault.none())
            return bad_number(FileSection::columns, fault.index, fault);
        const std::vector<BandsRecord> records = bands_records(data);
        for (std::size_t r = 0; r < records.size(); ++r) {
            const Region& region = data.regions[r];
            const FirstBandsRecord made =
                record_of(bands_of(data.columns, region.first, region.last), data.inputs[r].vertex_count);
            if (!agree(made, records[r].first)) return bad_number(FileSection::bands, r);
        }
        return {};
    }

    [[nodiscard]] BodyFileFault load_mesh(DrawMesh& mesh, std::size_t vertices) {
        mesh.triangles = context_.sections.get<std::uint32_t>(FileSection::triangles, index_);
        mesh.uvs = context_.sections.get<glm::vec2>(FileSection::uvs, index_);
        mesh.source = context_.sections.get<std::uint32_t>(FileSection::source, index_);
        if (mesh.triangles.size() % 3 != 0) return bad_count(FileSection::triangles);
        if (!mesh.uvs.empty() && mesh.uvs.size() != vertices) return bad_count(FileSection::uvs);
        if (!mesh.source.empty() && mesh.source.size() != vertices) return bad_count(FileSection::source);
        if (context_.everything) {
            if (!all_below(vertices, mesh.triangles)) {
                const auto bad = std::ranges::find_if(mesh.triangles, [&](auto i) { return i >= vertices; });
                return no_such(FileSection::triangles,
                               static_cast<std::size_t>(bad - mesh.triangles.begin()) / 3);
            }
            for (std::size_t i = 0; i < mesh.uvs.size(); ++i) {
                if (!all_finite({&mesh.uvs[i].x, 2})) return bad_number(FileSection::uvs, i);
            }
        }
        return load_parts(mesh);
    }

    [[nodiscard]] BodyFileFault load_parts(DrawMesh& mesh) {
        const auto records = context_.sections.get<PartRecord>(FileSection::parts, index_);
        if (records.empty()) return {};
        std::vector<DrawPart>& parts = context_.holdings->parts.emplace_back();
        parts.reserve(records.size());
        std::uint64_t next = 0;
        const auto materials = static_cast<std::int64_t>(context_.materials);
        for (std::size_t i = 0; i < records.size(); ++i) {
            const auto name = context_.names.read(records[i].name);
            const std::int32_t material = records[i].material;
            if (!name) return no_such(FileSection::parts, i);
            if (material < -1 || material >= materials) return no_such(FileSection::parts, i);
            if (records[i].first_triangle != next)
                return {FileReason::layout, FileSection::parts, BodyFileFault::nowhere, i};
            next += records[i].triangle_count;
            parts.push_back({*name, records[i].first_triangle, records[i].triangle_count, material});
        }
        if (next != mesh.triangles.size() / 3) return bad_count(FileSection::parts);
        mesh.parts = parts;
        return {};
    }

    const LevelContext& context_;
    std::size_t index_;  ///< of the level
};

}  // namespace

BodyFileFault load_level(const LevelContext& context, std::size_t level, std::vector<BodyFileLevel>& levels) {
    return LevelLoader(context, level).load(levels.emplace_back());
}

}  // namespace goffer::bend
