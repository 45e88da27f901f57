// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

/// A read-only column of values, wherever the caller keeps them: in an array, in a member of an array of
/// structs, or in either of these cut into pages, like the pools of ECS libraries.
///
///     auto array = strided(std::span(poses));
///     auto member = strided(std::span(worms), &Worm::pose);                      // of each struct
///     auto pages = paged(pool.raw(), page_size, n, &Worm::pose);  // the same, in the pages of an ECS

namespace goffer {

/// `count` elements of type T, `stride` bytes apart. Some columns have further values after each element,
/// like the poses of a body's regions after that of the first. A plain value that owns nothing: the memory,
/// and the array of page addresses, must outlive it. A default-constructed view is empty: the column is not
/// given.
template <class T>
struct StridedView {
    static_assert(std::is_trivially_copyable_v<T>);
    static constexpr std::uint32_t unpaged = 63;  ///< page_shift of a view without pages

    const void* data = nullptr;  ///< the array, or an array of the pages' addresses
    std::size_t count = 0;
    /// 0: all elements are the same one; `count` is still their number: of instances or, with indices, more
    /// than the largest index.
    std::uint32_t stride = sizeof(T);
    std::uint32_t offset = 0;  ///< bytes from the beginning of the array, or of a page, to its first element
    std::uint32_t page_shift = unpaged;  ///< a page holds 2^page_shift elements
    /// How many values of type T each element has, one after the other; 0: as many as the stride has room
    /// for. A view of a member knows that what follows the member is something else.
    std::uint32_t values = 0;

    [[nodiscard]] bool empty() const noexcept { return data == nullptr; }

    /// Address of element `index` < count.
    [[nodiscard]] const T* at(std::size_t index) const noexcept {
        assert(index < count);
        const void* page = data;
        if (page_shift != unpaged) {
            // Copied, since reading a T* through a const void* lvalue would break the aliasing rules.
            const auto* const pages = static_cast<const std::byte*>(data);
            std::memcpy(&page, pages + (index >> page_shift) * sizeof page, sizeof page);
            index &= (std::size_t{1} << page_shift) - 1;
        }
        const void* const element = static_cast<const std::byte*>(page) + offset + index * stride;
        return static_cast<const T*>(element);
    }
    [[nodiscard]] const T& operator[](std::size_t index) const noexcept { return *at(index); }
};

namespace detail {

/// The type of a member, or of its elements where it is an array. A bool that is no array is read as the byte
/// that it is.
template <class M>
struct Element {
    static_assert(sizeof(bool) == 1);
    using Type = std::conditional_t<std::is_same_v<std::remove_const_t<M>, bool>, std::uint8_t,
                                    std::remove_const_t<M>>;
    static constexpr std::uint32_t count = 1;
};
template <class M, std::size_t N>
struct Element<M[N]> {
    using Type = std::remove_const_t<M>;
    static constexpr std::uint32_t count = N;
};
template <class M, std::size_t N>
struct Element<std::array<M, N>> {
    using Type = std::remove_const_t<M>;
    static constexpr std::uint32_t count = N;
};
template <class M, std::size_t N>
struct Element<const std::array<M, N>> {
    using Type = std::remove_const_t<M>;
    static constexpr std::uint32_t count = N;
};

/// Whether `Class` is `Object` or a base of it.
template <class Class, class Object>
inline constexpr bool has_members_of = std::is_base_of_v<Class, std::remove_const_t<Object>>;

/// The address of `object`, whatever its own operator& says.
template <class T>
[[nodiscard]] const std::byte* address_of(const T& object) noexcept {
    return &reinterpret_cast<const std::byte&>(object);
}

/// Bytes from the beginning of `object`, whose value is not read, to its member.
template <class Object, class Class, class M>
[[nodiscard]] std::uint32_t offset_of(const Object& object, M Class::*member) noexcept {
    return static_cast<std::uint32_t>(address_of(object.*member) - address_of(object));
}

/// log2 of `page_size`, a power of two.
[[nodiscard]] constexpr std::uint32_t shift_of(std::size_t page_size) noexcept {
    assert(std::has_single_bit(page_size));
    return static_cast<std::uint32_t>(std::countr_zero(page_size));
}

}  // namespace detail

/// The elements of a contiguous range. An empty range gives an empty view.
template <class T, std::size_t N>
[[nodiscard]] StridedView<std::remove_const_t<T>> strided(std::span<T, N> values) noexcept {
    if (values.empty()) return {};
    return {.data = values.data(), .count = values.size()};
}

/// A member of each struct in a contiguous range. Where the member is an array (T[N] or std::array), element
/// i of the view is the first value of struct i's array, and the others follow it.
template <class Object, std::size_t N, class Class, class M>
[[nodiscard]] auto strided(std::span<Object, N> objects, M Class::*member) noexcept {
    static_assert(detail::has_members_of<Class, Object>);
    using T = typename detail::Element<M>::Type;
    if (objects.empty()) return StridedView<T>{};
    return StridedView<T>{.data = objects.data(),
                          .count = objects.size(),
                          .stride = sizeof(Object),
                          .offset = detail::offset_of(objects.front(), member),
                          .values = detail::Element<M>::count};
}

/// `count` elements in pages of `page_size` elements, a power of two. pages[p] is the address of page p.
/// Pages after that of element count - 1 are never read, nor are their addresses.
template <class T>
[[nodiscard]] StridedView<std::remove_const_t<T>> paged(T* const* pages, std::size_t page_size,
                                                        std::size_t count) noexcept {
    if (count == 0) return {};
    return {.data = pages, .count = count, .page_shift = detail::shift_of(page_size)};
}

/// A member of each struct in pages.
template <class Object, class Class, class M>
[[nodiscard]] auto paged(Object* const* pages, std::size_t page_size, std::size_t count,
                         M Class::*member) noexcept {
    static_assert(detail::has_members_of<Class, Object>);
    using T = typename detail::Element<M>::Type;
    if (count == 0) return StridedView<T>{};
    return StridedView<T>{.data = pages,
                          .count = count,
                          .stride = sizeof(Object),
                          .offset = detail::offset_of(*pages[0], member),
                          .page_shift = detail::shift_of(page_size),
                          .values = detail::Element<M>::count};
}

}  // namespace goffer
