// SPDX-License-Identifier: MIT
#include "cache/columns.hpp"

#include "arguments.hpp"

#include <goffer/io/ending.hpp>
#include <goffer/io/error.hpp>
#include <goffer/io/read_file.hpp>
#include <goffer/io/text.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace goffer::cli {
namespace {

constexpr std::string_view between = ", ;\t\r\n";

std::vector<float> numbers_in(const std::filesystem::path& file) {
    const std::string bytes = io::read_file(file);
    std::vector<float> numbers;
    std::string_view text = io::without_bom(bytes);
    while (true) {
        text.remove_prefix(std::min(text.find_first_not_of(between), text.size()));
        if (text.empty()) return numbers;
        const std::string_view word = text.substr(0, text.find_first_of(between));
        const std::optional<float> number = io::to_float(word);
        const bool too_large = number && std::isinf(*number);
        if (!number || !std::isfinite(*number))
            throw InputError(io::about(
                file, "'" + io::escaped(word.substr(0, 40)) + "', after " + std::to_string(numbers.size()) +
                          " numbers, is " + (too_large ? "more than a 32-bit float holds" : "not a number") +
                          "; correct it"));
        numbers.push_back(*number);
        text.remove_prefix(word.size());
    }
}

}  // namespace

NumberFile::NumberFile(const std::filesystem::path& file, std::uint64_t most) : file_(file) {
    const std::uint64_t size = io::size_of_file(file);
    if (io::ending_of(file) == ".csv") {
        if (size > most / 4)  // the text, and at most two bytes for every byte of it
            throw InputError(io::about(file, "takes more memory than the " + io::size_text(most) +
                                                 " that are allowed; give its numbers as floats, not as "
                                                 "text, or allow more with --max-memory"));
        text_ = numbers_in(file);
        count_ = text_.size();
        return;
    }
    if (size % sizeof(float) != 0)
        throw InputError(
            io::about(file, "has " + std::to_string(size) +
                                " bytes, which is not a whole number of 32-bit floats; a text of "
                                "numbers ends in .csv"));
    binary_ = std::make_unique<InputFile>(file);
    count_ = size / sizeof(float);
}

void NumberFile::read(std::uint64_t first, std::span<float> out) const {
    if (binary_) {
        binary_->read(first * sizeof(float), std::as_writable_bytes(out));
    } else {
        std::ranges::copy(std::span(text_).subspan(static_cast<std::size_t>(first), out.size()), out.begin());
    }
    const auto bad = std::ranges::find_if(out, [](float value) { return !std::isfinite(value); });
    if (bad != out.end())
        throw InputError(io::about(
            file_, "number " + std::to_string(first + static_cast<std::uint64_t>(bad - out.begin())) +
                       ", counted from 0, is not finite; correct it"));
}

}  // namespace goffer::cli
