// SPDX-License-Identifier: MIT

// The game over plain arrays of components.

#include "game.hpp"

#include <bit>
#include <vector>

namespace {

using namespace ecs;

/// One type's components, one behind the other.
template <class T>
class Array {
public:
    void add(const T& component) { values_.push_back(component); }
    void remove(std::size_t index) {
        values_[index] = values_.back();
        values_.pop_back();
    }
    [[nodiscard]] std::size_t size() const { return values_.size(); }
    [[nodiscard]] Pool<T> pool() {
        page_ = values_.data();
        return {&page_, std::bit_ceil(values_.size())};
    }

private:
    std::vector<T> values_;
    T* page_ = nullptr;
};

class Arrays final : public World {
public:
    [[nodiscard]] Pools pools() override {
        return {creatures_.size(), creatures_.pool(), bends_.pool(), places_.pool(), details_.pool()};
    }
    void add(const Creature& creature, const Place& place) override {
        creatures_.add(creature);
        bends_.add({});
        places_.add(place);
        details_.add({});
    }
    void remove(std::size_t index) override {
        creatures_.remove(index);
        bends_.remove(index);
        places_.remove(index);
        details_.remove(index);
    }

private:
    Array<Creature> creatures_;
    Array<Bend> bends_;
    Array<Place> places_;
    Array<Detail> details_;
};

}  // namespace

int main(int argc, char** argv) {
    Arrays world;
    return play(world, argc, argv);
}
