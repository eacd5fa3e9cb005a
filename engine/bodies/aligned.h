// Vectors that start at a cache line, as the kernels' rows and blocks should, and that keep their
// memory.
#pragma once

#include <cstdint>
#include <new>
#include <vector>

namespace talus::engine {

template <class T>
struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}
  T* allocate(std::size_t n) {
    return static_cast<T*>(::operator new(n * sizeof(T), std::align_val_t(64)));
  }
  void deallocate(T* p, std::size_t) { ::operator delete(p, std::align_val_t(64)); }
  bool operator==(const CacheLineAllocator&) const = default;
};

// Lengthens `list` to `count` elements with copies of `value`. Takes half as much again when it
// must grow, so that counts that wander a little do not allocate again and again.
template <class List>
void ExtendWithRoom(List& list, std::int64_t count, const typename List::value_type& value) {
  const auto size = static_cast<std::size_t>(count);
  if (size > list.capacity()) list.reserve(size + size / 2);
  list.resize(size, value);
}

// Makes `list` count copies of `value`, with room as above.
template <class List>
void AssignWithRoom(List& list, std::int64_t count, const typename List::value_type& value) {
  list.clear();
  ExtendWithRoom(list, count, value);
}

template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

}  // namespace talus::engine
