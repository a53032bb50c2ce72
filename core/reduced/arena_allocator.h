// Memory whose addresses grow in the order of allocation, for containers that sort by address.
#pragma once

#include <cstddef>
#include <new>
#include <stdexcept>

namespace massprops {

/// While it lives, every single node that an `ArenaAllocator` of this thread hands out comes from
/// one block of memory: from the last freed node of the same size, else from the next free address.
/// The order of addresses depends on the order of calls alone. Scopes do not nest; all nodes must
/// be freed before the scope ends.
class ArenaScope {
public:
  /// `bytes`: size of the block beyond a small constant; untouched memory costs nothing.
  /// \throw std::bad_alloc when the system does not give so much
  explicit ArenaScope(std::size_t bytes);
  ~ArenaScope();
  ArenaScope(const ArenaScope&) = delete;
  ArenaScope& operator=(const ArenaScope&) = delete;
};

/// The block of a scope is used up, while the system has memory still.
class ArenaUsedUp : public std::runtime_error {
public:
  ArenaUsedUp() : std::runtime_error("a block of memory of limited size is used up") {}
};

/// \throw ArenaUsedUp
/// \throw std::logic_error when there is no scope
void* arenaAllocate(std::size_t bytes);
void arenaDeallocate(void* node, std::size_t bytes) noexcept;

template <class T>
class ArenaAllocator {
public:
  using value_type = T;

  ArenaAllocator() = default;
  template <class U>
  ArenaAllocator(const ArenaAllocator<U>& /*other*/) {} // NOLINT: allocators convert implicitly

  T* allocate(std::size_t n) {
    return static_cast<T*>(n == 1 ? arenaAllocate(sizeof(T)) : ::operator new(n * sizeof(T)));
  }
  void deallocate(T* p, std::size_t n) noexcept {
    n == 1 ? arenaDeallocate(p, sizeof(T)) : ::operator delete(p);
  }
  template <class U>
  bool operator==(const ArenaAllocator<U>& /*other*/) const {
    return true;
  }
  template <class U>
  bool operator!=(const ArenaAllocator<U>& /*other*/) const {
    return false;
  }
};

} // namespace massprops
