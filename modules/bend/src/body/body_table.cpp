// SPDX-License-Identifier: MIT
#include <goffer/bend/body_table.hpp>

#include <cassert>
#include <memory>
#include <utility>

namespace goffer::bend {

BodyTable::BodyTable(BodyTable&& other) noexcept
    : places_(std::exchange(other.places_, {})),
      size_(std::exchange(other.size_, 0)),
      first_free_(std::exchange(other.first_free_, none)) {}

BodyTable& BodyTable::operator=(BodyTable&& other) noexcept {
    BodyTable taken(std::move(other));
    std::swap(places_, taken.places_);
    std::swap(size_, taken.size_);
    std::swap(first_free_, taken.first_free_);
    return *this;
}

BodyTable::~BodyTable() {
    for (const Place* place : places_) delete place;
}

const BodyTable::Place* BodyTable::place_of(BodyHandle handle) const noexcept {
    if (handle.index >= places_.size()) return nullptr;
    const Place& place = *places_[handle.index];
    return place.revision != 0 && place.generation == handle.generation ? &place : nullptr;
}

BodyTable::Place* BodyTable::place_of(BodyHandle handle) noexcept {
    return const_cast<Place*>(std::as_const(*this).place_of(handle));
}

BodyHandle BodyTable::add(Body body) {
    assert(!body.empty());
    std::uint32_t index = first_free_;
    if (index == none) {
        index = static_cast<std::uint32_t>(places_.size());
        auto made = std::make_unique<Place>();
        places_.push_back(made.get());
        static_cast<void>(made.release());
    } else {
        first_free_ = places_[index]->next_free;
    }
    Place& place = *places_[index];
    place.body = std::move(body);
    place.revision = 1;
    ++size_;
    return {index, place.generation};
}

bool BodyTable::replace(BodyHandle handle, Body&& body) {
    assert(!body.empty());
    Place* const place = place_of(handle);
    if (place == nullptr) return false;
    place->body = std::move(body);
    if (++place->revision == 0) place->revision = 1;
    return true;
}

bool BodyTable::remove(BodyHandle handle) {
    Place* const place = place_of(handle);
    if (place == nullptr) return false;
    place->body = Body();
    place->revision = 0;
    --size_;
    // A place whose generations are used up stays empty: its handles must never come back.
    if (++place->generation == 0) return true;
    place->next_free = first_free_;
    first_free_ = handle.index;
    return true;
}

const Body* BodyTable::find(BodyHandle handle) const noexcept {
    const Place* const place = place_of(handle);
    return place != nullptr ? &place->body : nullptr;
}

std::uint32_t BodyTable::revision(BodyHandle handle) const noexcept {
    const Place* const place = place_of(handle);
    return place != nullptr ? place->revision : 0;
}

}  // namespace goffer::bend
