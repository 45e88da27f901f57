// SPDX-License-Identifier: MIT
#pragma once

#include "bytes.hpp"
#include "require.hpp"

#include <goffer/bend/job.hpp>

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Output memory of a random layout between pages that nobody may touch: a write past the ends of an array
/// ends the program, with any compiler and at full speed.

namespace goffer::test {

/// Pages for one array, kept for the next one.
class GuardedPages {
public:
    static constexpr std::size_t pages = 64;

    GuardedPages() {
        void* const memory =
            mmap(nullptr, (pages + 2) * page(), PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        require(memory != MAP_FAILED, "there is memory");
        first_ = static_cast<std::byte*>(memory) + page();
        require(mprotect(first_, pages * page(), PROT_READ | PROT_WRITE) == 0, "pages can be opened");
    }

    /// So many floats that end, or else begin, where the next page is closed.
    [[nodiscard]] std::span<float> floats(std::size_t count, bool at_end) const {
        const std::size_t offset = at_end ? pages * page() - count * sizeof(float) : 0;
        require(count * sizeof(float) <= pages * page(), "an array fits");
        return {reinterpret_cast<float*>(first_ + offset), count};
    }

private:
    static std::size_t page() { return static_cast<std::size_t>(sysconf(_SC_PAGESIZE)); }

    std::byte* first_;  // never given back: there are 16 of them, as long as the program runs
};

/// The streams of a job, with a letter for every float as in OutputBuffer: each stream is left out, planes,
/// or a part of records that it may share with others.
class GuardedBuffer {
public:
    static constexpr float guard = -12345.0f;

    GuardedBuffer(Bytes& bytes, std::size_t count, bool with_tangents) : count_(count) {
        std::array<std::vector<std::string>, 2> records;  // the parts of shared records
        for (const std::string_view letters : {"xyz", "uvw", "abcd", "pqr", "123"}) {
            const std::size_t way = bytes.below(5);
            const bool whole = letters == "123";
            if (way == 0 || (letters == "abcd" && !with_tangents)) continue;
            if (way == 1 && !whole) {
                for (const char letter : letters) add(bytes, std::string(1, letter));
            } else if (way <= 2) {
                add(bytes, shuffled(bytes, letters, whole));
            } else {
                records[way - 3].push_back(shuffled(bytes, letters, whole));
            }
        }
        for (const std::vector<std::string>& parts : records) add_record(bytes, parts);
    }

    /// Whether there is a stream at all.
    [[nodiscard]] bool empty() const { return arrays_.empty(); }

    void attach(bend::DeformJob& job) const {
        job.positions = stream<3>("xyz");
        job.normals = stream<3>("uvw");
        job.tangents = stream<4>("abcd");
        job.previous_positions = stream<3>("pqr");
        if (const Place place = place_of('1'); place.first != nullptr)
            job.packed = {reinterpret_cast<bend::PackedVertex*>(place.first), place.stride, count_};
    }

    void clear() const {
        for (const Array& array : arrays_) std::ranges::fill(array.memory, guard);
    }

    /// Whether all gaps are as they were.
    [[nodiscard]] bool gaps_kept() const {
        for (const Array& array : arrays_) {
            for (std::size_t i = 0; i < array.memory.size(); ++i) {
                if (array.record[i % array.record.size()] == '.' && array.memory[i] != guard) return false;
            }
        }
        return true;
    }

    /// Whether all floats of these letters fit `holds`.
    template <class Holds>
    [[nodiscard]] bool all(std::string_view letters, Holds holds) const {
        for (const Array& array : arrays_) {
            for (std::size_t i = 0; i < array.memory.size(); ++i) {
                if (letters.find(array.record[i % array.record.size()]) != letters.npos &&
                    !holds(array.memory[i]))
                    return false;
            }
        }
        return true;
    }

private:
    struct Array {
        std::string record;
        std::span<float> memory;
    };
    struct Place {
        float* first = nullptr;
        std::size_t stride = 0;  // bytes
    };

    /// The letters in some order, with gaps between them; packed ones stay together.
    static std::string shuffled(Bytes& bytes, std::string_view letters, bool whole) {
        std::string record(letters);
        for (std::size_t i = record.size(); i > 1 && !whole; --i)
            std::swap(record[i - 1], record[bytes.below(i)]);
        for (std::size_t gaps = bytes.below(4); gaps > 0 && !whole; --gaps)
            record.insert(bytes.below(record.size() + 1), ".");
        return std::string(bytes.below(3), '.') + record;
    }

    void add_record(Bytes& bytes, const std::vector<std::string>& parts) {
        std::string record;
        for (const std::string& part : parts) record += part;
        if (!record.empty()) add(bytes, record + std::string(bytes.below(6), '.'));
    }

    /// The last record ends with its last letter: what is behind that belongs to nobody.
    void add(Bytes& bytes, const std::string& record) {
        static const std::array<GuardedPages, 16> pages;
        const std::size_t last = record.find_last_not_of('.') + 1;
        const std::size_t floats = (count_ - 1) * record.size() + last;
        arrays_.push_back({record, pages[arrays_.size()].floats(floats, bytes.below(4) != 0)});
    }

    [[nodiscard]] Place place_of(char letter) const {
        for (const Array& array : arrays_) {
            if (const std::size_t at = array.record.find(letter); at != array.record.npos)
                return {array.memory.data() + at, array.record.size() * sizeof(float)};
        }
        return {};
    }

    template <std::size_t N>
    [[nodiscard]] Stream<N> stream(std::string_view letters) const {
        Stream<N> result;
        for (std::size_t c = 0; c < N; ++c) {
            const Place place = place_of(letters[c]);
            if (place.first == nullptr) return {};
            result.component[c] = place.first;
            result.stride = place.stride;
        }
        result.count = count_;
        return result;
    }

    std::size_t count_;
    std::vector<Array> arrays_;
};

}  // namespace goffer::test
