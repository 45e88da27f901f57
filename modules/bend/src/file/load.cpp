// SPDX-License-Identifier: MIT
#include "body/check.hpp"
#include "file/format.hpp"
#include "file/load_held.hpp"
#include "file/load_level.hpp"
#include "file/sections.hpp"

#include <goffer/bend/body_input.hpp>

#include <algorithm>
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
        names_ = NameReader(sections_.get<char>(FileSection::names));
        if (const BodyFileFault fault = load_rig(); !fault.none()) return fault;
        if (const BodyFileFault fault = load_materials(); !fault.none()) return fault;
        if (const BodyFileFault fault = load_sockets(); !fault.none()) return fault;
        const std::span<const char> notes = sections_.get<char>(FileSection::notes);
        file_.notes = {notes.data(), notes.size()};
        const LevelContext context{sections_, rig_, names_, file_.materials.size(), everything_, holdings_};
        for (std::size_t level = 0; level < levels_; ++level) {
            if (BodyFileFault fault = load_level(context, level, file_.levels); !fault.none()) {
                fault.level = level;
                return fault;
            }
        }
        return {};
    }

    [[nodiscard]] BodyFile file() { return std::move(file_); }

private:
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
        if (rigs.size() != 1) return bad_count(FileSection::rig);
        if (regions.empty() || regions.size() > max_regions) return bad_count(FileSection::regions);
        for (int i = 0; i < 3; ++i) {
            rig_.origin[i] = rigs[0].origin[i];
            for (int c = 0; c < 3; ++c) rig_.axes[i][c] = rigs[0].axes[3 * i + c];
        }
        rig_.radius = rigs[0].radius;
        for (const auto& [record, blend, blend_gain] : regions) {
            if (record.wrinkle_rows > std::min(rows.size(), most_rows))
                return bad_count(FileSection::wrinkle_rows);
            if (record.factor_rows > std::min(factors.size(), most_rows))
                return bad_count(FileSection::factor_rows);
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
        if (!rows.empty()) return bad_count(FileSection::wrinkle_rows);
        if (!factors.empty()) return bad_count(FileSection::factor_rows);
        rig_.regions = regions_;
        const BodyFault fault = check_rig(rig_);
        return fault.none() ? BodyFileFault{} : bad_number(FileSection::rig, BodyFileFault::nowhere, fault);
    }

    [[nodiscard]] BodyFileFault load_materials() {
        const auto records = sections_.get<MaterialRecord>(FileSection::materials);
        file_.materials.reserve(records.size());
        for (std::size_t i = 0; i < records.size(); ++i) {
            const auto name = names_.read(records[i].name);
            if (!name) return no_such(FileSection::materials, i);
            const float* c = records[i].base_color;
            if (!all_finite({c, 4})) return bad_number(FileSection::materials, i);
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
            const auto name = names_.read(records[i].name);
            if (!name) return no_such(FileSection::sockets, i);
            if (records[i].region >= regions_.size()) return no_such(FileSection::sockets, i);
            const double* v = records[i].vertex;
            const double *n = records[i].normal, *t = records[i].tangent;
            const Socket socket{static_cast<std::size_t>(records[i].region),
                                {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]},
                                {n[0], n[1], n[2]},
                                {t[0], t[1], t[2]}};
            if (const BodyFault fault = check_socket(socket, i, depths[socket.region]); !fault.none())
                return bad_number(FileSection::sockets, i, fault);
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

    FileSections sections_;
    std::size_t levels_;
    bool everything_;
    FileMemory holdings_;
    BodyFile file_;
    BodyInput rig_;                     // what all levels share
    std::vector<RegionInput> regions_;  // its regions, without vertices
    NameReader names_{{}};
};

}  // namespace

BodyFileFault check_start(const FileHeader& header, std::uint64_t size) noexcept {
    const auto fault = [](FileReason reason) { return BodyFileFault{reason}; };
    if (header.magic != file_magic) return fault(FileReason::not_a_body_file);
    if (header.byte_order != file_byte_order) {
        constexpr std::uint32_t other_order = 0x04030201;
        return fault(header.byte_order == other_order ? FileReason::byte_order : FileReason::not_a_body_file);
    }
    if (header.version == 0 || header.version > body_file_version)
        return {.reason = FileReason::version, .index = header.version};
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
