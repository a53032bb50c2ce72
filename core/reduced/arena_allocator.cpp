#include "core/reduced/arena_allocator.h"

#include <cstdlib>
#include <limits>
#include <unordered_map>

namespace massprops {
namespace {

struct Arena {
  char* begin = nullptr;
  char* next = nullptr;
  char* end = nullptr;
  /// Last freed node of each size; a freed node's first word points to the one freed before.
  std::unordered_map<std::size_t, void*> freed;
};

thread_local Arena arena;

std::size_t rounded(std::size_t bytes) {
  constexpr std::size_t kAlignment = alignof(std::max_align_t);
  return (bytes + kAlignment - 1) / kAlignment * kAlignment;
}

} // namespace

ArenaScope::ArenaScope(std::size_t bytes) {
  constexpr std::size_t kLeast = std::size_t{1} << 20U;
  constexpr std::size_t kMost = std::numeric_limits<std::ptrdiff_t>::max();
  if (bytes > kMost - kLeast) throw std::bad_alloc();
  bytes += kLeast;
  arena.begin = static_cast<char*>(std::malloc(bytes));
  if (arena.begin == nullptr) throw std::bad_alloc();
  arena.next = arena.begin;
  arena.end = arena.begin + bytes;
}

ArenaScope::~ArenaScope() {
  std::free(arena.begin);
  arena = Arena{};
}

void* arenaAllocate(std::size_t bytes) {
  if (arena.begin == nullptr) throw std::logic_error("nodes come from an arena that has no scope");
  void*& last = arena.freed[bytes];
  if (last != nullptr) {
    void* node = last;
    last = *static_cast<void**>(node);
    return node;
  }
  const std::size_t size = rounded(bytes);
  if (static_cast<std::size_t>(arena.end - arena.next) < size) throw ArenaUsedUp();
  void* node = arena.next;
  arena.next += size;
  return node;
}

void arenaDeallocate(void* node, std::size_t bytes) noexcept {
  void*& last = arena.freed[bytes];
  *static_cast<void**>(node) = last;
  last = node;
}

} // namespace massprops
