// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/job.hpp>
#include <goffer/engine/columns.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

/// Output memory of any layout, with guard values wherever nothing may be written.

namespace goffer::test {

/// Streams of a job as a picture tells: a word for every array of records, a letter for every float of its
/// record.
///
///     xyz position   uvw normal   abcd tangent   pqr previous position   123 packed   . a gap
///
/// "xyzuvw" is records of 24 bytes, "xyz uvw" two arrays of records, "x y z" planes, "zyx." components in
/// another order, with a gap.
class Layout {
public:
    static constexpr std::string_view letters = "xyzuvwabcdpqr123";
    static constexpr float guard = -12345.0f;

    /// Memory for `count` vertices. Arrays begin `shift` floats behind a cache line, each of them `skew`
    /// further than the one before; without skew at places that differ modulo a page as those of separate
    /// allocations might, so that planes can be streamed to.
    Layout(std::string_view picture, std::size_t count, std::size_t shift = 0, std::size_t skew = 0)
        : count_(count) {
        constexpr std::size_t line = 16, way = 256, margin = 16;
        const bool one = picture.find(' ') == std::string_view::npos;
        const std::size_t grid = skew != 0 || one ? line : way;
        const std::size_t step = skew != 0 || one ? skew : 2 * line;
        std::size_t size = 0;
        for (std::size_t area = 0; !picture.empty(); ++area) {
            const std::string_view word = picture.substr(0, picture.find(' '));
            const std::size_t first = (size + margin + grid - 1) / grid * grid + shift + area * step;
            for (std::size_t i = 0; i < word.size(); ++i) {
                if (word[i] != '.') places_[letters.find(word[i])] = {first + i, word.size()};
            }
            size = first + count * word.size();
            picture.remove_prefix(std::min(word.size() + 1, picture.size()));
        }
        memory_ = Columns(1, size + margin);
        clear();
    }

    void clear() { std::fill(memory_[0].begin(), memory_[0].end(), guard); }

    /// Sets the streams of `job`: those of the picture are here, the others empty.
    void attach(bend::DeformJob& job) {
        job.positions = stream<3>('x');
        job.normals = stream<3>('u');
        job.tangents = stream<4>('a');
        job.previous_positions = stream<3>('p');
        job.packed = {};
        if (const Place& place = places_[letters.find('1')]; place.stride != 0) {
            job.packed = {reinterpret_cast<bend::PackedVertex*>(at(place.first)),
                          place.stride * sizeof(float), count_};
        }
    }

    /// Empty if the vertices [first, last) are those of `reference` bit by bit, and nothing else was written;
    /// or what is not so.
    [[nodiscard]] std::string fault(const Layout& reference, std::size_t first, std::size_t last) const {
        std::vector<float> expected(memory_[0].size(), guard);
        for (std::size_t letter = 0; letter < letters.size(); ++letter) {
            const Place& to = places_[letter];
            const Place& from = reference.places_[letter];
            if (to.stride == 0) continue;
            const float* values = reference.memory_[0].data() + from.first;
            for (std::size_t i = first; i < last; ++i) {
                std::memcpy(&expected[to.first + i * to.stride], values + i * from.stride, sizeof(float));
            }
        }
        if (std::memcmp(expected.data(), memory_[0].data(), memory_[0].size_bytes()) == 0) return {};
        return difference(expected);
    }
    [[nodiscard]] std::string fault(const Layout& reference) const { return fault(reference, 0, count_); }

    /// FNV-1a over all of the memory.
    [[nodiscard]] std::uint64_t hash(std::uint64_t sum = 14695981039346656037u) const {
        for (const float& value : memory_[0]) {
            std::uint32_t bits = 0;
            std::memcpy(&bits, &value, sizeof bits);
            sum = (sum ^ bits) * 1099511628211u;
        }
        return sum;
    }

    [[nodiscard]] float value(char letter, std::size_t i) const {
        const Place& place = places_[letters.find(letter)];
        return memory_[0][place.first + i * place.stride];
    }

private:
    struct Place {
        std::size_t first = 0;   // floats from the beginning of the memory
        std::size_t stride = 0;  // floats; 0: not in the picture
    };

    [[nodiscard]] float* at(std::size_t index) { return memory_[0].data() + index; }

    template <std::size_t N>
    [[nodiscard]] Stream<N> stream(char first_letter) {
        Stream<N> result;
        const std::size_t letter = letters.find(first_letter);
        if (places_[letter].stride == 0) return result;
        for (std::size_t c = 0; c < N; ++c) result.component[c] = at(places_[letter + c].first);
        result.stride = places_[letter].stride * sizeof(float);
        result.count = count_;
        return result;
    }

    [[nodiscard]] std::string difference(const std::vector<float>& expected) const {
        for (std::size_t i = 0; i < expected.size(); ++i) {
            if (std::memcmp(&expected[i], &memory_[0][i], sizeof(float)) == 0) continue;
            for (std::size_t letter = 0; letter < letters.size(); ++letter) {
                const Place& place = places_[letter];
                if (place.stride == 0 || i < place.first || (i - place.first) % place.stride != 0) continue;
                if (const std::size_t vertex = (i - place.first) / place.stride; vertex < count_)
                    return std::string(1, letters[letter]) + " of vertex " + std::to_string(vertex);
            }
            return "a guard at float " + std::to_string(i);
        }
        return {};
    }

    Columns memory_;
    std::array<Place, letters.size()> places_;
    std::size_t count_;
};

}  // namespace goffer::test
