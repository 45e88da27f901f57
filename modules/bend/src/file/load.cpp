// SPDX-License-Identifier: MIT
#include "body/check.hpp"
#include "file/format.hpp"
#include "file/load_held.hpp"
#include "file/sections.hpp"

#include <goffer/bend/body_input.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>

namespace goffer::bend {
namespace {

BodyFileFault check_header(std::span<const std::byte> bytes) {
    FileHeader header = {};
    if (bytes.size() >= sizeof header) std::memcpy(&header, bytes.data(), sizeof header);
    if (const BodyFileFault fault = check_start(header, bytes.size()); !fault.none()) return fault;
    const bool aligned_there = reinterpret_cast<std::uintptr_t>(bytes.data()) % column_alignment == 0;
    return {aligned_there ? FileReason::none : FileReason::alignment};
}

BodyFileFault check_rest_of_header(const FileHeader& header) {
    if (header.level_count == 0 || header.level_count > max_levels)
        return {FileReason::count, FileSection::level};
    const bool zeros = header.zero_word == 0 &&
                       std::ranges::all_of(header.zero, [](std::uint64_t word) { return word == 0; });
    return zeros ? BodyFileFault{} : BodyFileFault{FileReason::layout, FileSection::header};
}

bool all_finite(std::span<const float> numbers) {
    return std::ranges::all_of(numbers, [](float x) { return std::isfinite(x); });
}

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

class Loader {
public:
    Loader(std::span<const std::byte> bytes, std::size_t levels, Verify verify, FileMemory holdings)
        : sections_(bytes, levels),
          levels_(levels),
          everything_(verify == Verify::everything),
          holdings_(std::move(holdings)),
          file_(holdings_) {}

    /// Loads all, or returns the first fault.
    [[nodiscard]] BodyFileFault load() {
        if (const BodyFileFault fault = sections_.check(); !fault.none()) return fault;
        if (const BodyFileFault fault = load_rig(); !fault.none()) return fault;
        if (const BodyFileFault fault = load_materials(); !fault.none()) return fault;
        if (const BodyFileFault fault = load_sockets(); !fault.none()) return fault;
        const std::span<const char> notes = sections_.get<char>(FileSection::notes);
        file_.notes = {notes.data(), notes.size()};
        for (std::size_t level = 0; level < levels_; ++level) {
            if (BodyFileFault fault = load_level(level); !fault.none()) {
                fault.level = level;
                return fault;
            }
        }
        return {};
    }

    [[nodiscard]] BodyFile file() { return std::move(file_); }

private:
    /// The characters of a name, or nothing where they are not there. Names follow each other in the order in
    /// which they are asked for, so that all of them together are no longer than the file.
    [[nodiscard]] std::optional<std::string_view> name(const NameRecord& name) {
        const std::span<const char> all = sections_.get<char>(FileSection::names);
        if (name.first != named_ || name.count > all.size() - named_) return std::nullopt;
        named_ += name.count;
        return std::string_view(all.data() + name.first, name.count);
    }

    static BodyFileFault number(FileSection section, std::size_t index, const BodyFault& body = {}) {
        return {FileReason::number, section, BodyFileFault::nowhere, index, body};
    }
    static BodyFileFault count(FileSection section) { return {FileReason::count, section}; }
    static BodyFileFault no_such(FileSection section, std::size_t index) {
        return {FileReason::index, section, BodyFileFault::nowhere, index};
    }

    /// The regions, of any version. Too many of them are not looked at.
    [[nodiscard]] std::vector<RegionRecord> region_records() const {
        if (sections_.version() != 1) {
            const auto records = sections_.get<RegionRecord>(FileSection::regions);
            const std::size_t most = std::min(records.size(), max_regions + 1);
            return {records.begin(), records.begin() + static_cast<std::ptrdiff_t>(most)};
        }
        std::vector<RegionRecord> records;
        for (const FirstRegionRecord& record : sections_.get<FirstRegionRecord>(FileSection::regions)) {
            records.push_back({record, 0, 1});
            if (records.size() > max_regions) break;
        }
        return records;
    }

    [[nodiscard]] BodyFileFault load_rig() {
        const auto rigs = sections_.get<RigRecord>(FileSection::rig);
        const std::vector<RegionRecord> regions = region_records();
        auto rows = sections_.get<WrinkleRow>(FileSection::wrinkle_rows);
        auto factors = sections_.get<std::array<float, FactorTable::directions>>(FileSection::factor_rows);
        if (rigs.size() != 1) return count(FileSection::rig);
        if (regions.empty() || regions.size() > max_regions) return count(FileSection::regions);
        for (int i = 0; i < 3; ++i) {
            rig_.origin[i] = rigs[0].origin[i];
            for (int c = 0; c < 3; ++c) rig_.axes[i][c] = rigs[0].axes[3 * i + c];
        }
        rig_.radius = rigs[0].radius;
        for (const auto& [record, blend, blend_gain] : regions) {
            if (record.wrinkle_rows > std::min(rows.size(), most_rows))
                return count(FileSection::wrinkle_rows);
            if (record.factor_rows > std::min(factors.size(), most_rows))
                return count(FileSection::factor_rows);
            RegionInput region;
            region.length = record.length;
            region.max_angle = record.max_angle;
            region.rest_angle = record.rest_angle;
            region.rest_direction = record.rest_direction;
            region.onset = record.onset;
            region.radius = record.radius;
            region.max_scale = record.max_scale;
            region.blend = blend;
            region.blend_gain = blend_gain;
            region.table.max_angle = record.table_max_angle;
            region.table.rows.assign(rows.begin(), rows.begin() + record.wrinkle_rows);
            region.factors.max_angle = record.factors_max_angle;
            region.factors.rows.assign(factors.begin(), factors.begin() + record.factor_rows);
            rows = rows.subspan(record.wrinkle_rows);
            factors = factors.subspan(record.factor_rows);
            regions_.push_back(std::move(region));
        }
        if (!rows.empty()) return count(FileSection::wrinkle_rows);
        if (!factors.empty()) return count(FileSection::factor_rows);
        rig_.regions = regions_;
        const BodyFault fault = check_rig(rig_);
        return fault.none() ? BodyFileFault{} : number(FileSection::rig, BodyFileFault::nowhere, fault);
    }

    [[nodiscard]] BodyFileFault load_materials() {
        const auto records = sections_.get<MaterialRecord>(FileSection::materials);
        file_.materials.reserve(records.size());
        for (std::size_t i = 0; i < records.size(); ++i) {
            const auto name = this->name(records[i].name);
            if (!name) return no_such(FileSection::materials, i);
            const float* c = records[i].base_color;
            if (!all_finite({c, 4})) return number(FileSection::materials, i);
            file_.materials.push_back({*name, {c[0], c[1], c[2], c[3]}});
        }
        return {};
    }

    [[nodiscard]] BodyFileFault load_sockets() {
        const auto records = sections_.get<SocketRecord>(FileSection::sockets);
        file_.sockets.reserve(records.size());
        std::vector<double> depths;  // of the regions' wrinkles
        for (std::size_t r = 0; r < regions_.size() && !records.empty(); ++r)
            depths.push_back(deepest_wrinkle(regions_, r, rig_.radius));
        for (std::size_t i = 0; i < records.size(); ++i) {
            const auto name = this->name(records[i].name);
            if (!name) return no_such(FileSection::sockets, i);
            if (records[i].region >= regions_.size()) return no_such(FileSection::sockets, i);
            const double* v = records[i].vertex;
            const double *n = records[i].normal, *t = records[i].tangent;
            const Socket socket{static_cast<std::size_t>(records[i].region),
                                {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]},
                                {n[0], n[1], n[2]},
                                {t[0], t[1], t[2]}};
            if (const BodyFault fault = check_socket(socket, i, depths[socket.region]); !fault.none())
                return number(FileSection::sockets, i, fault);
            file_.sockets.push_back({*name, socket});
        }
        return {};
    }

    /// As Body::check would find it in what Sockets::make makes.
    [[nodiscard]] BodyFault check_socket(const Socket& socket, std::size_t index, double depth) const {
        const RegionInput& region = regions_[socket.region];
        BodyFault fault = check_vertex(socket.vertex, index, region, radius_of(region, rig_.radius), depth);
        if (fault.none()) fault = check_unit(BodyField::normals, socket.normal, index);
        if (fault.none()) fault = check_unit(BodyField::tangents, socket.tangent, index);
        if (!fault.none()) return fault;
        const Joints joints = joints_of(regions_, socket.region, rig_.radius);
        return check_near_joints(socket.vertex, index, region.length, depth, joints, regions_);
    }

    [[nodiscard]] BodyFileFault load_level(std::size_t index) {
        const auto records = sections_.get<LevelRecord>(FileSection::level, index);
        if (records.size() != 1) return count(FileSection::level);
        const LevelRecord& record = records[0];
        auto data = std::make_unique<BodyData>();
        if (const BodyFileFault fault = place_columns(*data, record, index); !fault.none()) return fault;
        if (const BodyFileFault fault = load_regions(*data, index); !fault.none()) return fault;
        if (everything_) {
            if (const BodyFileFault fault = check_numbers(*data, index); !fault.none()) return fault;
        }
        const float *low = record.low, *high = record.high;
        const bool box = all_finite({low, 3}) && all_finite({high, 3}) && low[0] <= high[0] &&
                         low[1] <= high[1] && low[2] <= high[2];
        if (!box) return number(FileSection::level, 0);
        file_.levels.push_back({});
        BodyFileLevel& level = file_.levels.back();
        level.rest_bounds = {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
        const std::size_t vertices = data->vertex_count;
        level.body = Body(data.release());
        return load_mesh(level, index, vertices);
    }

    [[nodiscard]] BodyFileFault place_columns(BodyData& data, const LevelRecord& record, std::size_t level) {
        if (record.vertex_count == 0) return count(FileSection::level);
        if (record.tangents > 1 || record.shape > 1 || record.rest > 1 || record.zero != 0)
            return {FileReason::layout, FileSection::level};
        const auto columns = sections_.get<float>(FileSection::columns, level);
        data.layout = {record.tangents == 1, record.shape == 1, record.rest == 1};
        constexpr std::uint64_t line = column_alignment / sizeof(float);
        const bool padded = record.stride >= widest_batch && record.stride % line == 0 &&
                            record.vertex_count <= record.stride - widest_batch;
        if (!padded) return {FileReason::layout, FileSection::level};
        if (columns.size() % data.layout.columns() != 0 ||
            columns.size() / data.layout.columns() != record.stride)
            return count(FileSection::columns);
        data.stride = static_cast<std::size_t>(record.stride);
        data.vertex_count = static_cast<std::size_t>(record.vertex_count);
        data.columns = columns_at(columns.data(), data.stride, data.layout);
        data.memory = holdings_;
        return {};
    }

    /// The bands, of any version. In version 1 wrinkles pass no joint: its vertices are near none.
    [[nodiscard]] std::vector<BandsRecord> bands_records(const BodyData& data, std::size_t level) const {
        if (sections_.version() != 1) {
            const auto records = sections_.get<BandsRecord>(FileSection::bands, level);
            return {records.begin(), records.end()};
        }
        const float no_scale = data.layout.shape ? 0.0f : 1.0f;
        std::vector<BandsRecord> records;
        for (const FirstBandsRecord& record : sections_.get<FirstBandsRecord>(FileSection::bands, level))
            records.push_back({record, 0, record.vertex_count, no_scale, no_scale});
        return records;
    }

    [[nodiscard]] BodyFileFault load_regions(BodyData& data, std::size_t level) {
        const std::vector<BandsRecord> records = bands_records(data, level);
        if (records.size() != regions_.size()) return count(FileSection::bands);
        data.inputs = regions_;
        const bool compares = std::ranges::any_of(regions_, compares_with_rest);
        if (compares && !data.layout.rest) return {FileReason::layout, FileSection::level};
        std::size_t left = data.vertex_count;
        for (std::size_t r = 0; r < records.size(); ++r) {
            if (records[r].first.vertex_count > left) return count(FileSection::bands);
            data.inputs[r].vertex_count = static_cast<std::size_t>(records[r].first.vertex_count);
            left -= data.inputs[r].vertex_count;
        }
        if (left != 0) return count(FileSection::bands);
        set_frame(data, rig_.origin, rig_.axes, rig_.radius);
        for (std::size_t r = 0; r < records.size(); ++r) {
            const std::optional<Bands> bands = bands_from(records[r].first);
            if (!bands) return number(FileSection::bands, r);
            add_region(data, data.inputs[r], *bands);
            if (!set_joints(data, records[r])) return number(FileSection::bands, r);
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
    [[nodiscard]] BodyFileFault check_numbers(BodyData& data, std::size_t level) const {
        const float* column = data.columns.cos_half_beta;
        for (std::size_t c = 0; c < data.layout.columns(); ++c, column += data.stride) {
            const auto padding = std::as_bytes(std::span(column + data.vertex_count, column + data.stride));
            if (!std::ranges::all_of(padding, [](std::byte byte) { return byte == std::byte{0}; }))
                return {FileReason::layout, FileSection::columns};
        }
        if (const BodyFault fault = check_columns(data); !fault.none())
            return number(FileSection::columns, fault.index, fault);
        const std::vector<BandsRecord> records = bands_records(data, level);
        for (std::size_t r = 0; r < records.size(); ++r) {
            const Region& region = data.regions[r];
            const FirstBandsRecord made =
                record_of(bands_of(data.columns, region.first, region.last), data.inputs[r].vertex_count);
            if (!agree(made, records[r].first)) return number(FileSection::bands, r);
        }
        return {};
    }

    [[nodiscard]] BodyFileFault load_mesh(BodyFileLevel& level, std::size_t index, std::size_t vertices) {
        DrawMesh& mesh = level.mesh;
        mesh.triangles = sections_.get<std::uint32_t>(FileSection::triangles, index);
        mesh.uvs = sections_.get<glm::vec2>(FileSection::uvs, index);
        mesh.source = sections_.get<std::uint32_t>(FileSection::source, index);
        if (mesh.triangles.size() % 3 != 0) return count(FileSection::triangles);
        if (!mesh.uvs.empty() && mesh.uvs.size() != vertices) return count(FileSection::uvs);
        if (!mesh.source.empty() && mesh.source.size() != vertices) return count(FileSection::source);
        if (everything_) {
            if (!all_below(vertices, mesh.triangles)) {
                const auto bad = std::ranges::find_if(mesh.triangles, [&](auto i) { return i >= vertices; });
                return no_such(FileSection::triangles,
                               static_cast<std::size_t>(bad - mesh.triangles.begin()) / 3);
            }
            for (std::size_t i = 0; i < mesh.uvs.size(); ++i) {
                if (!all_finite({&mesh.uvs[i].x, 2})) return number(FileSection::uvs, i);
            }
        }
        return load_parts(mesh, index);
    }

    [[nodiscard]] BodyFileFault load_parts(DrawMesh& mesh, std::size_t index) {
        const auto records = sections_.get<PartRecord>(FileSection::parts, index);
        if (records.empty()) return {};
        std::vector<DrawPart>& parts = holdings_->parts.emplace_back();
        parts.reserve(records.size());
        std::uint64_t next = 0;
        const auto materials = static_cast<std::int64_t>(file_.materials.size());
        for (std::size_t i = 0; i < records.size(); ++i) {
            const auto name = this->name(records[i].name);
            const std::int32_t material = records[i].material;
            if (!name) return no_such(FileSection::parts, i);
            if (material < -1 || material >= materials) return no_such(FileSection::parts, i);
            if (records[i].first_triangle != next) return {FileReason::layout, FileSection::parts};
            next += records[i].triangle_count;
            parts.push_back({*name, records[i].first_triangle, records[i].triangle_count, material});
        }
        if (next != mesh.triangles.size() / 3) return count(FileSection::parts);
        mesh.parts = parts;
        return {};
    }

    FileSections sections_;
    std::size_t levels_;
    bool everything_;
    FileMemory holdings_;
    BodyFile file_;
    BodyInput rig_;                     // what all levels share
    std::vector<RegionInput> regions_;  // its regions, without vertices
    std::size_t named_ = 0;             // characters of the names so far
};

}  // namespace

BodyFileFault check_start(const FileHeader& header, std::uint64_t size) noexcept {
    const auto fault = [](FileReason reason) { return BodyFileFault{reason}; };
    if (header.magic != file_magic) return fault(FileReason::not_a_body_file);
    if (header.byte_order != file_byte_order) {
        constexpr std::uint32_t other_order = 0x04030201;
        return fault(header.byte_order == other_order ? FileReason::byte_order : FileReason::not_a_body_file);
    }
    if (header.version == 0 || header.version > body_file_version) return fault(FileReason::version);
    if (header.bytes > size) return fault(FileReason::truncated);
    return fault(header.bytes < size ? FileReason::too_long : FileReason::none);
}

std::optional<BodyFile> load_held(std::span<const std::byte> bytes, BodyFileFault* fault, Verify verify,
                                  FileMemory holdings) {
    std::optional<BodyFile> file;
    BodyFileFault found = check_header(bytes);
    if (found.none()) {
        const auto& header = *reinterpret_cast<const FileHeader*>(bytes.data());
        if (verify != Verify::layout && checksum_of(bytes) != header.checksum) found = {FileReason::checksum};
        if (found.none()) found = check_rest_of_header(header);
        if (found.none()) {
            Loader loader(bytes, header.level_count, verify, std::move(holdings));
            found = loader.load();
            if (found.none()) file = loader.file();
        }
    }
    if (fault != nullptr) *fault = found;
    return file;
}

}  // namespace goffer::bend
