// SPDX-License-Identifier: MIT
#include <goffer/bend/body_file.hpp>
#include <goffer/bend/body_file_fault.hpp>

#include <cstdio>

namespace goffer::bend {
namespace {

const char* words_of(FileReason reason) noexcept {
    switch (reason) {
        case FileReason::none:
        case FileReason::version:  // says more: see describe()
            break;
        case FileReason::not_a_body_file:
            return "not a body file; goffer bake makes one";
        case FileReason::byte_order:
            return "made on a machine of the other byte order; bake it again for this one";
        case FileReason::truncated:
            return "has fewer bytes than it says; copy or bake it again";
        case FileReason::too_long:
            return "has more bytes than it says; copy or bake it again";
        case FileReason::alignment:
            return "does not begin at a multiple of 64 bytes in memory; use load_copy";
        case FileReason::checksum:
            return "was changed since it was written; copy or bake it again";
        case FileReason::layout:
            return "does not lie where it must; bake the file again";
        case FileReason::count:
            return "too few, too many, or not as many as other parts of it say; bake the file again";
        case FileReason::number:
            return "not a number, or out of its range; bake the file again";
        case FileReason::index:
            return "refers to what is not there; bake the file again";
        case FileReason::rig:
            return "does not have the regions, tables and frame of the first level; bind it with bind_level";
        case FileReason::empty:
            return "has no body; give one that is not empty";
        case FileReason::missing:
            return "there is no such file; check its name, and the working folder";
        case FileReason::unreadable:
            return "cannot be opened or read; check its permissions";
    }
    return "unknown";
}

const char* name_of(FileSection section) noexcept {
    constexpr const char* names[] = {"body file",   "directory", "rig",     "regions",   "wrinkle_rows",
                                     "factor_rows", "materials", "sockets", "names",     "notes",
                                     "level",       "bands",     "columns", "triangles", "uvs",
                                     "source",      "parts"};
    const auto number = static_cast<std::size_t>(section);
    return number < std::size(names) ? names[number] : "unknown";
}

}  // namespace

FaultText describe(const BodyFileFault& fault) noexcept {
    FaultText result;
    if (fault.none()) {
        std::snprintf(result.text, sizeof result.text, "no fault");
        return result;
    }
    if (fault.reason == FileReason::version) {
        std::snprintf(result.text, sizeof result.text,
                      "%s: of version %zu, and this library reads 1 to %u; bake it again, or use a newer "
                      "library",
                      name_of(fault.section), fault.index, unsigned{body_file_version});
        return result;
    }
    char level[40] = "", index[24] = "";
    if (fault.level != BodyFileFault::nowhere)
        std::snprintf(level, sizeof level, "levels[%zu].", fault.level);
    if (fault.index != BodyFileFault::nowhere) std::snprintf(index, sizeof index, "[%zu]", fault.index);
    const FaultText number = describe(fault.body);
    const char* what = fault.body.none() ? words_of(fault.reason) : number.c_str();
    std::snprintf(result.text, sizeof result.text, "%s%s%s: %.180s", level, name_of(fault.section), index,
                  what);
    return result;
}

}  // namespace goffer::bend
