// SPDX-License-Identifier: MIT
#include <goffer/io/text.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

using namespace goffer::io;

TEST_CASE("text: numbers are whole words, and may have a plus sign") {
    CHECK(to_double("0.1") == 0.1);
    CHECK(to_double("+2.5e3") == 2500.0);
    CHECK(to_float("-7") == -7.0f);
    CHECK(to_integer("+12") == 12);
    for (const char* word : {"", "+", "-", "+-1", "++1", "1x", " 1", "1 ", "0x10", "1,5", "e5", "."}) {
        CAPTURE(word);
        CHECK(!to_double(word));
        CHECK(!to_float(word));
        CHECK(!to_integer(word));
    }
    CHECK(!to_integer("1.0"));
    CHECK(!to_integer("9223372036854775808"));
}

TEST_CASE(
    "text: numbers beyond the type become infinite or 0, by their value and not by how they are written") {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const std::string zeros(400, '0');
    CHECK(to_double("1e400") == infinite);
    CHECK(to_double("-10.0e400") == -infinite);
    CHECK(to_double("1" + zeros) == infinite);
    CHECK(to_double("1e-400") == 0.0);
    CHECK(to_double("0." + zeros + "1") == 0.0);
    CHECK(to_double("1e99999999999999999999") == infinite);
    CHECK(to_double("1e-99999999999999999999") == 0.0);
    CHECK(std::signbit(to_double("-1e-400").value()));
    CHECK(to_float("1e39") == std::numeric_limits<float>::infinity());
    CHECK(to_float("1e-60") == 0.0f);
    CHECK(to_float("0.01e60") == std::numeric_limits<float>::infinity());
    CHECK(std::isnan(to_float("nan").value()));
}

TEST_CASE("text: marks and blanks around it go") {
    CHECK(without_bom("\xEF\xBB\xBFv 1") == "v 1");
    CHECK(without_bom("\xEF\xBBv") == "\xEF\xBBv");
    CHECK(trimmed(" \t red paint\r\n") == "red paint");
    CHECK(trimmed(" \v\f").empty());
}
