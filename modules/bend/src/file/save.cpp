// SPDX-License-Identifier: MIT
#include "file/format.hpp"

#include <goffer/bend/job.hpp>
#include <goffer/bend/rest_vertex.hpp>

#include <glm/common.hpp>

#include <algorithm>
#include <cstring>
#include <string>

namespace goffer::bend {
namespace {

/// Whether two regions differ in nothing but how many vertices they have.
bool same(RegionInput a, const RegionInput& b) {
    a.vertex_count = b.vertex_count;
    return a == b;
}

bool same_rig(const Body& a, const Body& b) {
    const auto same_regions = [](const RegionInput& x, const RegionInput& y) { return same(x, y); };
    return a.origin() == b.origin() && a.axes() == b.axes() && a.radius() == b.radius() &&
           std::ranges::equal(a.region_inputs(), b.region_inputs(), same_regions);
}

BodyFileFault check_levels(std::span<const LevelInput> levels) {
    if (levels.empty() || levels.size() > max_levels) return {FileReason::count, FileSection::level};
    for (std::size_t i = 0; i < levels.size(); ++i) {
        if (levels[i].body == nullptr || levels[i].body->empty())
            return {FileReason::empty, FileSection::level, i};
        if (i > 0 && !same_rig(*levels[i].body, *levels[0].body))
            return {FileReason::rig, FileSection::level, i};
    }
    return {};
}

/// The tight box of a body at rest.
Bounds rest_box(const Body& body) {
    const std::vector<Pose> poses = body.rest_poses();
    std::vector<glm::vec3> positions(body.vertex_count());
    DeformJob job{.body = &body, .poses = poses};
    job.isa = Isa::scalar;  // the same bytes on every machine
    job.positions = interleaved<3>(&positions[0].x, positions.size());
    run(job);
    Bounds box{positions[0], positions[0]};
    for (const glm::vec3& position : positions)
        box = {glm::min(box.low, position), glm::max(box.high, position)};
    return box;
}

/// Collects the sections of a file, one after the other.
class Writer {
public:
    explicit Writer(std::size_t levels) : directory_(section_count(levels)) {
        bytes_.resize(aligned(sizeof(FileHeader) + directory_.size() * sizeof(SectionRecord)));
    }

    template <class T>
    void add(std::span<const T> records) {
        directory_[next_++] = {bytes_.size(), records.size()};
        const std::size_t begin = bytes_.size();
        bytes_.resize(aligned(begin + records.size_bytes()));
        if (!records.empty()) std::memcpy(bytes_.data() + begin, records.data(), records.size_bytes());
    }

    template <class T>
    void add(const std::vector<T>& records) {
        add(std::span<const T>(records));
    }

    /// Keeps the characters for the section of names.
    NameRecord name(std::string_view text) {
        const NameRecord record{static_cast<std::uint32_t>(names_.size()),
                                static_cast<std::uint32_t>(text.size())};
        names_ += text;
        return record;
    }
    [[nodiscard]] const std::string& names() const { return names_; }

    /// The whole file. Nothing else may be asked for afterward.
    [[nodiscard]] std::vector<std::byte> finish(std::size_t levels) {
        FileHeader header = {};
        header.magic = file_magic;
        header.byte_order = file_byte_order;
        header.version = body_file_version;
        header.bytes = bytes_.size();
        header.level_count = static_cast<std::uint32_t>(levels);
        std::memcpy(bytes_.data(), &header, sizeof header);
        std::memcpy(bytes_.data() + sizeof header, directory_.data(),
                    directory_.size() * sizeof(SectionRecord));
        header.checksum = checksum_of(bytes_);
        std::memcpy(bytes_.data(), &header, sizeof header);
        return std::move(bytes_);
    }

private:
    std::vector<SectionRecord> directory_;
    std::size_t next_ = 0;
    std::vector<std::byte> bytes_;
    std::string names_;
};

void add_rig(Writer& out, const Body& body) {
    RigRecord rig = {};
    std::vector<RegionRecord> regions;
    std::vector<WrinkleRow> rows;
    std::vector<std::array<float, FactorTable::directions>> factors;
    for (int i = 0; i < 3; ++i) {
        rig.origin[i] = body.origin()[i];
        for (int c = 0; c < 3; ++c) rig.axes[3 * i + c] = body.axes()[i][c];
    }
    rig.radius = body.radius();
    for (const RegionInput& region : body.region_inputs()) {
        regions.push_back({{region.length, region.max_angle, region.rest_angle, region.rest_direction,
                            region.onset, region.radius, region.max_scale, region.table.max_angle,
                            region.factors.max_angle, static_cast<std::uint32_t>(region.table.rows.size()),
                            static_cast<std::uint32_t>(region.factors.rows.size())},
                           region.blend,
                           region.blend_gain});
        rows.insert(rows.end(), region.table.rows.begin(), region.table.rows.end());
        factors.insert(factors.end(), region.factors.rows.begin(), region.factors.rows.end());
    }
    out.add(std::span<const RigRecord>(&rig, 1));
    out.add(regions);
    out.add(rows);
    out.add(factors);
}

std::vector<MaterialRecord> records_of(Writer& out, std::span<const DrawMaterial> materials) {
    std::vector<MaterialRecord> records;
    for (const DrawMaterial& material : materials) {
        const glm::vec4& c = material.base_color;
        records.push_back({out.name(material.name), {c.r, c.g, c.b, c.a}});
    }
    return records;
}

std::vector<SocketRecord> records_of(Writer& out, std::span<const NamedSocket> sockets) {
    std::vector<SocketRecord> records;
    for (const auto& [name, socket] : sockets) {
        const RestVertex& v = socket.vertex;
        records.push_back({out.name(name),
                           socket.region,
                           {v.beta, v.z, v.rho, v.wrinkle, v.slope, v.scale, v.scale_slope, v.drift},
                           {socket.normal.rho, socket.normal.beta, socket.normal.z},
                           {socket.tangent.rho, socket.tangent.beta, socket.tangent.z}});
    }
    return records;
}

std::vector<PartRecord> records_of(Writer& out, std::span<const DrawPart> parts) {
    std::vector<PartRecord> records;
    for (const DrawPart& part : parts)
        records.push_back({out.name(part.name), part.first_triangle, part.triangle_count, part.material});
    return records;
}

void add_level(Writer& out, const LevelInput& input, const std::vector<PartRecord>& parts) {
    const BodyData& data = *input.body->data();
    const Bounds box = rest_box(*input.body);
    const auto flag = [](bool has) -> std::uint32_t { return has ? 1 : 0; };
    const LevelRecord level = {data.vertex_count,
                               data.stride,
                               flag(data.layout.tangents),
                               flag(data.layout.shape),
                               flag(data.layout.rest),
                               {box.low.x, box.low.y, box.low.z},
                               {box.high.x, box.high.y, box.high.z},
                               0};
    std::vector<BandsRecord> bands;
    for (std::size_t r = 0; r < data.details.size(); ++r) {
        const RegionData& details = data.details[r];
        bands.push_back(
            record_of(details.bands, details.joints, data.regions[r].first, data.inputs[r].vertex_count));
    }
    out.add(std::span<const LevelRecord>(&level, 1));
    out.add(bands);
    out.add(std::span<const float>(data.columns.cos_half_beta, data.layout.columns() * data.stride));
    out.add(input.mesh.triangles);
    out.add(input.mesh.uvs);
    out.add(input.mesh.source);
    out.add(parts);
}

}  // namespace

std::vector<std::byte> save(const BodyFileInput& input, BodyFileFault* fault) {
    BodyFileFault found = check_levels(input.levels);
    std::vector<std::byte> bytes;
    if (found.none()) {
        Writer out(input.levels.size());
        const std::vector<MaterialRecord> materials = records_of(out, input.materials);
        const std::vector<SocketRecord> sockets = records_of(out, input.sockets);
        std::vector<std::vector<PartRecord>> parts;
        for (const LevelInput& level : input.levels) parts.push_back(records_of(out, level.mesh.parts));
        add_rig(out, *input.levels[0].body);
        out.add(materials);
        out.add(sockets);
        out.add(std::span<const char>(out.names()));
        out.add(std::span<const char>(input.notes));
        for (std::size_t i = 0; i < input.levels.size(); ++i) add_level(out, input.levels[i], parts[i]);
        bytes = out.finish(input.levels.size());
        if (!load_copy(bytes, &found)) bytes.clear();
    }
    if (fault != nullptr) *fault = found;
    return bytes;
}

}  // namespace goffer::bend
