// SPDX-License-Identifier: MIT

// The game over EnTT's registry. An owning group keeps its pools in the same order, so that goffer reads them
// where they lie.

#include "game.hpp"

#include <entt/entity/registry.hpp>

namespace {

using namespace ecs;

class Registry final : public World {
public:
    Registry() { static_cast<void>(group()); }

    [[nodiscard]] Pools pools() override {
        return {group().size(), pool<Creature>(), pool<Bend>(), pool<Place>(), pool<Detail>()};
    }
    void add(const Creature& creature, const Place& place) override {
        const entt::entity entity = registry_.create();
        registry_.emplace<Creature>(entity, creature);
        registry_.emplace<Bend>(entity);
        registry_.emplace<Place>(entity, place);
        registry_.emplace<Detail>(entity);
    }
    void remove(std::size_t index) override {
        registry_.destroy(registry_.storage<Creature>().data()[index]);
    }

private:
    [[nodiscard]] auto group()
        -> decltype(std::declval<entt::registry&>().group<Creature, Bend, Place, Detail>()) {
        return registry_.group<Creature, Bend, Place, Detail>();
    }
    template <class T>
    [[nodiscard]] Pool<T> pool() {
        return {registry_.storage<T>().raw(), entt::component_traits<T>::page_size};
    }

    entt::registry registry_;
};

}  // namespace

int main(int argc, char** argv) {
    Registry world;
    return play(world, argc, argv);
}
