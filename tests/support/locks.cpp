// SPDX-License-Identifier: MIT
#include "support/locks.hpp"

#include <atomic>

#if defined(__GLIBC__) && !defined(GOFFER_SANITIZED)

#include <dlfcn.h>
#include <pthread.h>
#include <semaphore.h>

namespace {

constinit std::atomic<std::uint64_t> calls = 0;

/// glibc's function of that name, behind the one in this file. Not kept in a local static: its guard may
/// lock.
template <class Function>
class Next {
public:
    explicit constexpr Next(const char* name) : name_(name) {}

    template <class... Arguments>
    int operator()(Arguments... arguments) noexcept {
        calls.fetch_add(1, std::memory_order_relaxed);
        Function* function = function_.load(std::memory_order_relaxed);
        if (function == nullptr) {
            function = reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name_));
            function_.store(function, std::memory_order_relaxed);
        }
        return function(arguments...);
    }

private:
    const char* name_;
    std::atomic<Function*> function_ = nullptr;
};

constinit Next<int(pthread_mutex_t*)> mutex_lock{"pthread_mutex_lock"};
constinit Next<int(pthread_mutex_t*)> mutex_trylock{"pthread_mutex_trylock"};
constinit Next<int(pthread_rwlock_t*)> rwlock_rdlock{"pthread_rwlock_rdlock"};
constinit Next<int(pthread_rwlock_t*)> rwlock_wrlock{"pthread_rwlock_wrlock"};
constinit Next<int(pthread_spinlock_t*)> spin_lock{"pthread_spin_lock"};
constinit Next<int(sem_t*)> semaphore_wait{"sem_wait"};

}  // namespace

extern "C" {

int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
    return mutex_lock(mutex);
}

int pthread_mutex_trylock(pthread_mutex_t* mutex) noexcept {
    return mutex_trylock(mutex);
}

int pthread_rwlock_rdlock(pthread_rwlock_t* lock) noexcept {
    return rwlock_rdlock(lock);
}

int pthread_rwlock_wrlock(pthread_rwlock_t* lock) noexcept {
    return rwlock_wrlock(lock);
}

int pthread_spin_lock(pthread_spinlock_t* lock) noexcept {
    return spin_lock(lock);
}

int sem_wait(sem_t* semaphore) {
    return semaphore_wait(semaphore);
}

}  // extern "C"

namespace goffer::test {

std::optional<std::uint64_t> locks() noexcept {
    return calls.load(std::memory_order_relaxed);
}

}  // namespace goffer::test

#else

namespace goffer::test {

std::optional<std::uint64_t> locks() noexcept {
    return std::nullopt;
}

}  // namespace goffer::test

#endif
