#include "refused_memory.h"

#include <atomic>
#include <cerrno>
#include <new>

namespace {

constexpr std::int64_t never = 0;

std::atomic<std::int64_t> requests = 0;
std::atomic<std::int64_t> first_refused = never;
std::atomic<bool> refuses_later = false;
std::atomic<std::int64_t> blocks = 0;

bool is_refused() noexcept {
    if (first_refused == never) return false;
    const std::int64_t request = ++requests;
    return request == first_refused || (refuses_later && request > first_refused);
}

void* counted(void* block) noexcept {
    if (block) ++blocks;
    return block;
}

}  // namespace

namespace fairing::test {

RefusedMemory::RefusedMemory(std::int64_t k, Refused refused) {
    requests = 0;
    refuses_later = refused == Refused::all_later;
    first_refused = k;
}

RefusedMemory::~RefusedMemory() { first_refused = never; }

bool RefusedMemory::has_refused() const { return requests >= first_refused; }

std::int64_t held_blocks() { return blocks; }

}  // namespace fairing::test

extern "C" {

void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* block, std::size_t size);
void __real_free(void* block);

void* __wrap_malloc(std::size_t size) {
    if (!is_refused()) return counted(__real_malloc(size));
    errno = ENOMEM;
    return nullptr;
}

void* __wrap_calloc(std::size_t count, std::size_t size) {
    if (!is_refused()) return counted(__real_calloc(count, size));
    errno = ENOMEM;
    return nullptr;
}

void* __wrap_realloc(void* block, std::size_t size) {
    if (!is_refused()) return block ? __real_realloc(block, size) : counted(__real_realloc(block, size));
    errno = ENOMEM;
    return nullptr;
}

void __wrap_free(void* block) {
    if (block) --blocks;
    __real_free(block);
}

}  // extern "C"

namespace {

void* block_of(std::size_t size) noexcept { return __wrap_malloc(size > 0 ? size : 1); }

void* aligned_block_of(std::size_t size, std::align_val_t alignment) noexcept {
    if (is_refused()) return nullptr;
    const auto step = static_cast<std::size_t>(alignment);
    return counted(std::aligned_alloc(step, (size + step - 1) / step * step));
}

void* or_throw(void* block) {
    if (!block) throw std::bad_alloc();
    return block;
}

}  // namespace

// All of them: those of the sanitizers don't call each other.
void* operator new(std::size_t size) { return or_throw(block_of(size)); }
void* operator new[](std::size_t size) { return or_throw(block_of(size)); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return block_of(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return block_of(size); }
void* operator new(std::size_t size, std::align_val_t alignment) { return or_throw(aligned_block_of(size, alignment)); }
void* operator new[](std::size_t size, std::align_val_t alignment) {
    return or_throw(aligned_block_of(size, alignment));
}
void operator delete(void* block) noexcept { __wrap_free(block); }
void operator delete[](void* block) noexcept { __wrap_free(block); }
void operator delete(void* block, std::size_t) noexcept { __wrap_free(block); }
void operator delete[](void* block, std::size_t) noexcept { __wrap_free(block); }
void operator delete(void* block, const std::nothrow_t&) noexcept { __wrap_free(block); }
void operator delete[](void* block, const std::nothrow_t&) noexcept { __wrap_free(block); }
void operator delete(void* block, std::align_val_t) noexcept { __wrap_free(block); }
void operator delete[](void* block, std::align_val_t) noexcept { __wrap_free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { __wrap_free(block); }
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept { __wrap_free(block); }
