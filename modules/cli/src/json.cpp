// SPDX-License-Identifier: MIT
#include "json.hpp"

#include "arguments.hpp"

#include <goffer/io/error.hpp>

#include <set>
#include <vector>

namespace goffer::cli {
namespace {

using nlohmann::json;

constexpr std::size_t deepest = 32;

/// Refuses what nothing that goffer reads is like. A pass of its own: the library's parser with a callback
/// takes quadratic time for long lists of objects.
class Strict final : public nlohmann::json_sax<json> {
public:
    explicit Strict(const std::filesystem::path& file) : file_(file) {}

    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool string(string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool start_object(std::size_t) override { return open(); }
    bool start_array(std::size_t) override { return open(); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    /// The other pass says what is wrong.
    bool parse_error(std::size_t, const std::string&, const json::exception&) override { return false; }

    bool key(string_t& name) override {
        if (!names_.back().insert(name).second)
            throw InputError(
                io::about(file_, "has '" + io::escaped(name) + "' twice in one object; keep one of them"));
        return true;
    }

private:
    bool open() {
        if (names_.size() == deepest)
            throw InputError(io::about(file_, "is nested more than " + std::to_string(deepest) +
                                                  " deep; nothing that goffer reads is so deep"));
        names_.emplace_back();
        return true;
    }
    bool close() {
        names_.pop_back();
        return true;
    }

    const std::filesystem::path& file_;
    std::vector<std::set<std::string>> names_;  // of what is open; of lists none
};

}  // namespace

std::string reason(const json::exception& error) {
    const std::string text = error.what();
    const std::size_t end = text.find("] ");
    return end == text.npos ? text : text.substr(end + 2);
}

json parse_json(const std::filesystem::path& file, const std::string& text) {
    Strict strict(file);
    (void)json::sax_parse(text, &strict);
    try {
        return json::parse(text);
    } catch (const json::exception& error) {
        throw InputError(io::about(file, "is not JSON: " + io::escaped(reason(error))));
    }
}

}  // namespace goffer::cli
