// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <type_traits>

/// A read-only column of values that lie in the caller's memory as the caller keeps them: an array, a member
/// of an array of structs, or either of them cut into pages, as the pools of ECS libraries are.
///
///     strided(std::span(poses))                                    // an array
///     strided(std::span(worms), &Worm::pose)                       // a member of each struct
///     paged(registry.storage<Worm>().raw(), 1024, n, &Worm::pose)  // the same in pages of 1024

namespace goffer {

/// `count` values of type T, or groups of consecutive ones, `stride` bytes apart. A plain value that owns
/// nothing; the memory must outlive it. A default-made view is empty: the column is not given.
template <class T>
struct StridedView {
    static_assert(std::is_trivially_copyable_v<T>);
    static constexpr std::uint32_t one_stretch = 63;  ///< page_shift of a view without pages

    const void* data = nullptr;  ///< element 0; of a paged view: an array of the pages' addresses
    std::size_t count = 0;
    std::uint32_t stride = sizeof(T);
    std::uint32_t offset = 0;  ///< bytes from the beginning of a page, or of `data`, to its element 0
    std::uint32_t page_shift = one_stretch;  ///< a page holds 2^page_shift elements

    [[nodiscard]] bool empty() const noexcept { return data == nullptr; }

    /// Where element `index` < count is.
    [[nodiscard]] const T* at(std::size_t index) const noexcept {
        assert(index < count);
        const void* page = data;
        if (page_shift != one_stretch) {
            // A pointer to what the page holds is not read as another pointer, but copied.
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

/// What a member holds: of an array, its elements.
template <class M>
struct Element {
    using Type = std::remove_const_t<M>;
};
template <class M, std::size_t N>
struct Element<M[N]> {
    using Type = std::remove_const_t<M>;
};
template <class M, std::size_t N>
struct Element<std::array<M, N>> {
    using Type = std::remove_const_t<M>;
};
template <class M, std::size_t N>
struct Element<const std::array<M, N>> {
    using Type = std::remove_const_t<M>;
};

/// `Class` is `Object`, or what `Object` is derived from.
template <class Class, class Object>
inline constexpr bool has_members_of = std::is_base_of_v<Class, std::remove_const_t<Object>>;

/// Bytes from the beginning of `object`, which is not read, to its member.
template <class Object, class Class, class M>
[[nodiscard]] std::uint32_t offset_of(const Object& object, M Class::*member) noexcept {
    const void* const begin = std::addressof(object);
    const void* const at = std::addressof(object.*member);
    return static_cast<std::uint32_t>(static_cast<const std::byte*>(at) -
                                      static_cast<const std::byte*>(begin));
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

/// A member of each struct in a contiguous range; of a member that is an array (T[N] or std::array), its
/// elements: element i of the view is then the first of struct i, and the others follow it.
template <class Object, std::size_t N, class Class, class M>
[[nodiscard]] auto strided(std::span<Object, N> objects, M Class::*member) noexcept {
    static_assert(detail::has_members_of<Class, Object>);
    using T = typename detail::Element<M>::Type;
    if (objects.empty()) return StridedView<T>{};
    return StridedView<T>{.data = objects.data(),
                          .count = objects.size(),
                          .stride = sizeof(Object),
                          .offset = detail::offset_of(objects.front(), member)};
}

/// `count` elements in pages of `page_size`, a power of two; `pages` holds the address of each page. Pages
/// without elements below `count` are not touched.
template <class T>
[[nodiscard]] StridedView<std::remove_const_t<T>> paged(T* const* pages, std::size_t page_size,
                                                        std::size_t count) noexcept {
    if (count == 0) return {};
    return {.data = pages, .count = count, .page_shift = detail::shift_of(page_size)};
}

/// A member of each struct in pages, as both above.
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
                          .page_shift = detail::shift_of(page_size)};
}

}  // namespace goffer
