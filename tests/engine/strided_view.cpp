// SPDX-License-Identifier: MIT
#include <goffer/engine/strided_view.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

/// Columns in the caller's memory: where each element is, whatever it lies in.

namespace goffer::test {
namespace {

struct Named {
    std::uint16_t name = 0;
};

struct Worm : Named {
    double weight = 0;
    float angle = 0;
    float bends[3] = {};
    std::array<float, 2> ends = {};
    const int legs = 0;
};

Worm worm(std::size_t i) {
    const auto value = static_cast<float>(i);
    return {{static_cast<std::uint16_t>(1000 + i)},
            100.0 + static_cast<double>(i),
            value,
            {value + 0.25f, value + 0.5f, value + 0.75f},
            {-value, -value - 0.5f},
            static_cast<int>(i) * 2};
}

std::vector<Worm> worms(std::size_t count) {
    std::vector<Worm> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(worm(i));
    return result;
}

/// `worms`, cut into pages of `page_size`; what is behind the last is not there.
class Pages {
public:
    Pages(const std::vector<Worm>& worms, std::size_t page_size) {
        for (std::size_t first = 0; first < worms.size(); first += page_size) {
            const std::size_t last = std::min(first + page_size, worms.size());
            pages_.emplace_back(worms.begin() + static_cast<std::ptrdiff_t>(first),
                                worms.begin() + static_cast<std::ptrdiff_t>(last));
        }
        for (std::vector<Worm>& page : pages_) addresses_.push_back(page.data());
        addresses_.push_back(nullptr);
    }

    [[nodiscard]] Worm* const* addresses() const { return addresses_.data(); }

private:
    std::vector<std::vector<Worm>> pages_;
    std::vector<Worm*> addresses_;
};

static_assert(std::is_trivially_copyable_v<StridedView<float>>);
static_assert(detail::shift_of(1) == 0 && detail::shift_of(1024) == 10);

template <class View, class T>
constexpr bool views = std::is_same_v<View, StridedView<T>>;

/// Each element of `view` is that member of the worm of its index, by value and, of arrays, with its
/// neighbors.
template <class View, class Class, class Member>
void check_member(const View& view, std::size_t count, Member Class::*member) {
    REQUIRE(view.count == count);
    for (std::size_t i = 0; i < count; ++i) {
        const Worm expected = worm(i);
        const auto& wanted = expected.*member;
        if constexpr (requires { wanted[0]; }) {
            for (std::size_t k = 0; k < std::size(wanted); ++k) CHECK(view.at(i)[k] == wanted[k]);
        } else {
            CHECK(view[i] == wanted);
            CHECK(view.at(i) == &view[i]);
        }
    }
}

}  // namespace

TEST_CASE("a view of nothing is empty") {
    CHECK(StridedView<float>().empty());
    CHECK(strided(std::span<float>()).empty());
    CHECK(strided(std::span<const Worm>(), &Worm::angle).empty());
    const Worm* const* none = nullptr;
    CHECK(paged(none, 8, 0).empty());
    CHECK(paged(none, 8, 0, &Worm::angle).empty());
    const float one = 1;
    CHECK_FALSE(strided(std::span(&one, 1)).empty());
}

TEST_CASE("a view of an array finds its elements, constant or not") {
    std::vector<float> values = {1, 2, 3, 4, 5};
    const auto view = strided(std::span(values));
    const auto constant = strided(std::span(std::as_const(values)));
    static_assert(views<std::remove_const_t<decltype(view)>, float>);
    static_assert(std::is_same_v<decltype(view), decltype(constant)>);
    REQUIRE(view.count == values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        CHECK(view.at(i) == &values[i]);
        CHECK(constant.at(i) == &values[i]);
    }
    values[2] = 9;
    CHECK(view[2] == 9);
    std::array<float, 3> fixed = {6, 7, 8};
    CHECK(strided(std::span(fixed))[2] == 8);
    CHECK(strided(std::span(std::as_const(fixed))).count == 3);
}

TEST_CASE("a view of a member finds it in every struct, inherited, constant or an array") {
    std::vector<Worm> own = worms(7);
    const std::span<Worm> all(own);
    const std::span<const Worm> constant(own);
    static_assert(views<decltype(strided(all, &Worm::bends)), float>);
    static_assert(views<decltype(strided(all, &Worm::ends)), float>);
    static_assert(views<decltype(strided(constant, &Worm::legs)), int>);
    static_assert(views<decltype(strided(constant, &Named::name)), std::uint16_t>);
    check_member(strided(all, &Worm::weight), 7, &Worm::weight);
    check_member(strided(all, &Worm::angle), 7, &Worm::angle);
    check_member(strided(all, &Worm::bends), 7, &Worm::bends);
    check_member(strided(all, &Worm::ends), 7, &Worm::ends);
    check_member(strided(all, &Worm::legs), 7, &Worm::legs);
    check_member(strided(constant, &Worm::angle), 7, &Worm::angle);
    check_member(strided(constant, &Worm::name), 7, &Worm::name);
    CHECK(strided(all, &Worm::ends).at(3) == own[3].ends.data());
}

TEST_CASE("a view of members of type bool has bytes") {
    struct Entity {
        float angle;
        bool visible;
    };
    const Entity entities[] = {{0, true}, {1, false}, {2, true}};
    const StridedView<std::uint8_t> visible = strided(std::span(entities), &Entity::visible);
    CHECK(visible[0] == 1);
    CHECK(visible[1] == 0);
    CHECK(visible[2] == 1);
    const Entity* const pages[] = {&entities[0]};
    const StridedView<std::uint8_t> paged_visible = paged(pages, 4, 3, &Entity::visible);
    CHECK(paged_visible[2] == 1);
}

TEST_CASE("a view of pages finds elements on every page, up to a last one that is not full") {
    for (const std::size_t page_size : {1u, 2u, 8u, 1024u}) {
        for (const std::size_t count : {1u, 7u, 8u, 9u, 17u}) {
            CAPTURE(page_size);
            CAPTURE(count);
            const std::vector<Worm> own = worms(count);
            const Pages pages(own, page_size);
            const Worm* const* const constant = pages.addresses();
            const auto whole = paged(pages.addresses(), page_size, count);
            REQUIRE(whole.count == count);
            for (std::size_t i = 0; i < count; ++i) CHECK(whole[i].weight == own[i].weight);
            check_member(paged(pages.addresses(), page_size, count, &Worm::angle), count, &Worm::angle);
            check_member(paged(constant, page_size, count, &Worm::bends), count, &Worm::bends);
            check_member(paged(constant, page_size, count, &Worm::ends), count, &Worm::ends);
            check_member(paged(constant, page_size, count, &Worm::name), count, &Worm::name);
        }
    }
}

TEST_CASE("a view of pages of plain values is as the pools of ECS libraries hand them out") {
    std::array<float, 4> first = {0, 1, 2, 3}, second = {4, 5};
    float* pool[] = {first.data(), second.data()};
    float** raw = pool;
    const auto view = paged(raw, 4, 6);
    static_assert(views<std::remove_const_t<decltype(view)>, float>);
    for (std::size_t i = 0; i < 6; ++i) CHECK(view[i] == static_cast<float>(i));
}

TEST_CASE("a view may be put together by hand: records with a header before and gaps between") {
    alignas(double) std::byte memory[16 + 5 * 24] = {};
    for (std::size_t i = 0; i < 5; ++i) {
        const double value = static_cast<double>(i) + 0.5;
        std::memcpy(memory + 16 + i * 24, &value, sizeof value);
    }
    const StridedView<double> view{.data = memory, .count = 5, .stride = 24, .offset = 16};
    for (std::size_t i = 0; i < 5; ++i) CHECK(view[i] == static_cast<double>(i) + 0.5);
}

}  // namespace goffer::test
