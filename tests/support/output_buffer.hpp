// SPDX-License-Identifier: MIT
#pragma once

#include <goffer/bend/job.hpp>
#include <goffer/engine/columns.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Output memory of any layout, with guard values wherever nothing may be written.

namespace goffer::test {

/// Streams of a job or of a batch as a picture tells: a word for every array of records, a letter for every
/// float of its record.
///
///     xyz position   uvw normal   abcd tangent   pqr previous position   123 packed   . a gap
///
/// "xyzuvw" is records of 24 bytes, "xyz uvw" two arrays of records, "x y z" planes, "zyx." components in
/// another order, with a gap.
class OutputBuffer {
public:
    /// Vertices [first, last) of `planes`, which are expected from vertex `to` of a layout on.
    struct Part {
        const OutputBuffer* planes = nullptr;
        std::size_t first = 0, last = 0;
        std::size_t to = 0;
        bool ends = true;  ///< if not, the gap behind its last vertex is between outputs of one instance, too
        std::size_t padding =
            0;  ///< vertices behind it, of which some may hold anything where gaps are scratch
    };

    /// What may become of the gaps between a part's first output and its last one.
    enum class Gaps : std::uint8_t { kept, scratch };

    static constexpr std::string_view letters = "xyzuvwabcdpqr123";
    /// A plane for every stream.
    static constexpr std::string_view all_planes = "x y z u v w a b c d p q r 123";
    static constexpr float guard = -12345.0f;

    /// Memory for `count` vertices. Arrays begin `shift` floats behind a cache line, each of them `skew`
    /// further than the one before; without skew at places that differ modulo a page as those of separate
    /// allocations might, so that planes can be written past the cache.
    OutputBuffer(std::string_view picture, std::size_t count, std::size_t shift = 0, std::size_t skew = 0)
        : count_(count) {
        constexpr std::size_t line = 16, way = 256, margin = 16;
        const bool one = picture.find(' ') == std::string_view::npos;
        const std::size_t grid = skew != 0 || one ? line : way;
        const std::size_t step = skew != 0 || one ? skew : 2 * line;
        std::size_t size = 0;
        for (; !picture.empty(); ++areas_) {
            const std::string_view word = picture.substr(0, picture.find(' '));
            const std::size_t first = (size + margin + grid - 1) / grid * grid + shift + areas_ * step;
            for (std::size_t i = 0; i < word.size(); ++i) {
                if (word[i] != '.') places_[letters.find(word[i])] = {first + i, word.size(), areas_};
            }
            size = first + count * word.size();
            picture.remove_prefix(std::min(word.size() + 1, picture.size()));
        }
        memory_ = Columns(1, size + margin);
        clear();
    }

    void clear() { std::fill(memory_[0].begin(), memory_[0].end(), guard); }

    /// Sets the streams of `job`, a DeformJob or a Batch: those of the picture are here, the others empty.
    template <class Job>
    void attach(Job& job) {
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

    /// Empty if the memory holds `parts` bit by bit, and nothing else was written; or what is not so.
    [[nodiscard]] std::string fault(std::span<const Part> parts, Gaps gaps = Gaps::kept) const {
        std::vector<float> expected(memory_[0].size(), guard);
        if (gaps == Gaps::scratch) {
            for (const Part& part : parts) take_gaps(part, expected), take_padding(part, expected);
        }
        for (const Part& part : parts) take_outputs(part, expected);
        if (std::memcmp(expected.data(), memory_[0].data(), memory_[0].size_bytes()) == 0) return {};
        return difference(expected);
    }
    /// The same of the vertices [first, last), at their own places.
    [[nodiscard]] std::string fault(const OutputBuffer& planes, std::size_t first, std::size_t last,
                                    Gaps gaps = Gaps::kept) const {
        const Part part{&planes, first, last, first, last == count_};
        return fault({&part, 1}, gaps);
    }
    [[nodiscard]] std::string fault(const OutputBuffer& planes, Gaps gaps = Gaps::kept) const {
        return fault(planes, 0, count_, gaps);
    }

    /// FNV-1a over all of the memory.
    [[nodiscard]] std::uint64_t hash(std::uint64_t sum = 14695981039346656037u) const {
        for (const float& value : memory_[0]) {
            std::uint32_t bits = 0;
            std::memcpy(&bits, &value, sizeof bits);
            sum = (sum ^ bits) * 1099511628211u;
        }
        return sum;
    }

    [[nodiscard]] std::size_t count() const { return count_; }

    [[nodiscard]] float value(char letter, std::size_t i) const {
        const Place& place = places_[letters.find(letter)];
        return memory_[0][place.first + i * place.stride];
    }

private:
    struct Place {
        std::size_t first = 0;   // floats from the beginning of the memory
        std::size_t stride = 0;  // floats; 0: not in the picture
        std::size_t area = 0;    // index of its word
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

    /// The memory of a word of the picture: vertex 0's first and last float, and the floats of a vertex.
    struct Area {
        std::size_t low, high, stride;
    };

    [[nodiscard]] Area area_of(std::size_t area) const {
        Area found{memory_[0].size(), 0, 0};
        for (const Place& place : places_) {
            if (place.stride == 0 || place.area != area) continue;
            found.low = std::min(found.low, place.first);
            found.high = std::max(found.high, place.first);
            found.stride = place.stride;
        }
        return found;
    }

    /// What `part` may have left between its outputs: what was there, or zeros.
    void take_gaps(const Part& part, std::vector<float>& expected) const {
        if (part.first == part.last) return;
        for (std::size_t area = 0; area < areas_; ++area) {
            const auto [low, high, stride] = area_of(area);
            const std::size_t begin = low + part.to * stride;
            const std::size_t next = part.to + part.last - part.first;
            const std::size_t end = part.ends ? high + (next - 1) * stride + 1 : low + next * stride;
            for (std::size_t i = begin; stride != 0 && i < end; ++i)
                if (memory_[0][i] == 0) expected[i] = memory_[0][i];
        }
    }

    /// What `part` may have left behind its last vertex: anything, up to the first vertex that begins a cache
    /// line, if there is room up to that.
    void take_padding(const Part& part, std::vector<float>& expected) const {
        constexpr std::size_t line = 16;
        for (std::size_t area = 0; area < areas_; ++area) {
            const auto [low, high, stride] = area_of(area);
            if (stride == 0) continue;
            const std::size_t next = part.to + part.last - part.first;
            std::size_t more = 0;
            while (more < line && (low + (next + more) * stride) % line != 0) ++more;
            if (more == line || more > part.padding) continue;
            const std::size_t end = more == 0 ? 0 : low + (next + more) * stride;
            for (std::size_t i = high + (next - 1) * stride + 1; i < end; ++i) expected[i] = memory_[0][i];
        }
    }

    void take_outputs(const Part& part, std::vector<float>& expected) const {
        for (std::size_t letter = 0; letter < letters.size(); ++letter) {
            const Place& to = places_[letter];
            const Place& from = part.planes->places_[letter];
            if (to.stride == 0) continue;
            for (std::size_t i = part.first; i < part.last; ++i) {
                std::memcpy(&expected[to.first + (part.to + i - part.first) * to.stride],
                            &part.planes->memory_[0][from.first + i * from.stride], sizeof(float));
            }
        }
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
    std::size_t areas_ = 0;
    std::size_t count_;
};

}  // namespace goffer::test
