// SPDX-License-Identifier: MIT
#include "animate/pattern.hpp"

#include "arguments.hpp"

#include <goffer/io/ending.hpp>
#include <goffer/io/error.hpp>

#include <algorithm>
#include <charconv>
#include <system_error>

namespace goffer::cli {

std::optional<Pattern> Pattern::read(const std::filesystem::path& file) {
    const std::string name = file.filename().string();
    const std::size_t sign = name.find('%');
    if (sign == name.npos) return std::nullopt;
    const std::size_t end = std::min(name.find('d', sign), name.size());
    const std::string digits = name.substr(sign + 1, end - sign - 1);
    const bool plain = digits.empty(),
               padded = digits.size() == 2 && digits[0] == '0' && digits[1] >= '1' && digits[1] <= '9';
    if (end == name.size() || !(plain || padded) || name.find('%', end) != name.npos)
        throw UsageError("-o: '" + name + "' is not a pattern; give it one %d, or %04d for four digits");
    Pattern pattern;
    pattern.folder_ = file.parent_path();
    pattern.before_ = name.substr(0, sign);
    pattern.after_ = name.substr(end + 1);
    pattern.digits_ = plain ? 1 : static_cast<std::size_t>(digits[1] - '0');
    return pattern;
}

std::filesystem::path Pattern::file(std::size_t frame) const {
    const std::string number = std::to_string(frame + 1);
    const std::string zeros(digits_ > number.size() ? digits_ - number.size() : 0, '0');
    return folder_ / (before_ + zeros + number + after_);
}

std::optional<std::size_t> Pattern::number_of(const std::string& name) const {
    if (name.size() < before_.size() + after_.size() + digits_ || !name.starts_with(before_) ||
        !name.ends_with(after_))
        return std::nullopt;
    const char* const begin = name.data() + before_.size();
    const char* const end = name.data() + name.size() - after_.size();
    std::size_t number = 0;
    const auto [next, error] = std::from_chars(begin, end, number);
    const bool longer = static_cast<std::size_t>(end - begin) > digits_;
    if (error != std::errc() || next != end || (longer && *begin == '0')) return std::nullopt;
    return number;
}

bool Pattern::holds(const std::filesystem::path& file) const {
    const auto folder_of = [](const std::filesystem::path& folder) {
        return resolved(folder.empty() ? "." : folder);
    };
    const auto is_one = [&](const std::filesystem::path& place) {
        return number_of(place.filename().string()) && folder_of(place.parent_path()) == folder_of(folder_);
    };
    return is_one(file) || is_one(resolved(file));
}

std::optional<Pattern> Pattern::materials() const {
    const std::string ending = io::ending_of(file(0));
    if (ending != ".obj") return std::nullopt;
    Pattern materials = *this;
    materials.after_ = after_.substr(0, after_.size() - ending.size()) + ".mtl";
    return materials;
}

bool Pattern::writes(const std::filesystem::path& file) const {
    const std::optional<Pattern> beside = materials();
    return holds(file) || (beside && beside->holds(file));
}

void Pattern::check_places(std::size_t frames) const {
    const std::optional<Pattern> beside = materials();
    std::error_code error;
    std::filesystem::directory_iterator entry(folder_.empty() ? "." : folder_, error);
    for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        const std::optional<std::size_t> number = number_of(name);
        if (number && (*number < 1 || *number > frames))
            throw InputError(io::about(folder_ / name, "is of another sequence: this one goes from " +
                                                           file(0).filename().string() + " to " +
                                                           file(frames - 1).filename().string() +
                                                           "; remove it, or give -o another name"));
        if (number && entry->is_directory(error))
            throw InputError(io::about(folder_ / name, "is a folder; remove it, or give -o another name"));
        if (entry->is_symlink(error) && (number || (beside && beside->number_of(name))))
            throw InputError(io::about(folder_ / name, "is a link; remove it, or give -o another name"));
    }
}

}  // namespace goffer::cli
