#include <doctest/doctest.h>

#include <fstream>
#include <string>
#include <vector>

#ifdef __linux__
#include <malloc.h>
#include <unistd.h>
#endif

#include "api/memory.h"
#include "base/kept_memory.h"

using namespace fairing;

TEST_CASE("the estimate grows faster than the mesh") {
    CHECK(memory_estimate(0) == 0.0);
    double last = memory_estimate(1000);
    for (int count = 2000; count < 4000000; count *= 2) {
        CHECK(memory_estimate(count) >= 2.0 * last);
        last = memory_estimate(count);
    }
}

TEST_CASE("a run that needs more memory than there is says how much, before it takes any") {
    const double wanted = memory_estimate(1000000);
    CHECK_NOTHROW(check_memory(1000000, 1.01 * wanted));
    CHECK_NOTHROW(check_memory(1000000, std::nullopt));
    try {
        check_memory(1000000, 1.3e9);
        FAIL("refused");
    } catch (const std::bad_alloc& error) {
        const std::string text = error.what();
        CHECK(text.find("1000000 free vertices") != std::string::npos);
        CHECK(text.find("1.3 GB are available") != std::string::npos);
    }
}

TEST_CASE("small runs are left to the allocations") { CHECK_NOTHROW(check_memory(5000, 0.0)); }

// Sanitizers bring an allocator of their own.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {

constexpr std::size_t large = 64 * 1024 * 1024;

// Bytes that the allocator has free after an array of that size came and went, and the most that it had mapped for it.
struct Heap {
    std::size_t free;
    std::size_t mapped;
};
Heap after_an_array() {
    Heap heap{};
    {
        const std::vector<char> array(large, 1);
        heap.mapped = mallinfo2().hblkhd;
    }
    heap.free = mallinfo2().fordblks;
    return heap;
}

double resident_bytes() {
    std::ifstream report("/proc/self/statm");
    double all = 0.0;
    double pages = 0.0;
    report >> all >> pages;
    return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

TEST_CASE("what a large call frees stays until the last one ends, and goes back then") {
    const double before = resident_bytes();
    {
        const KeptMemory unwanted(false);
        const Heap heap = after_an_array();
        CHECK(heap.mapped >= large);
        CHECK(heap.free < large);
    }
    {
        const KeptMemory memory(true);
        {
            const KeptMemory inner(true);
            CHECK(after_an_array().free >= large);
        }
        const Heap heap = after_an_array();
        CHECK(heap.mapped < large);
        CHECK(heap.free >= large);
        CHECK(resident_bytes() > before + 0.9 * large);
    }
    CHECK(resident_bytes() < before + 0.3 * large);
    const Heap heap = after_an_array();
    CHECK(heap.mapped >= large);
    CHECK(heap.free < large);
}

#endif

#ifdef __linux__
TEST_CASE("Linux says what is available") {
    const auto available = available_memory();
    REQUIRE(available);
    CHECK(*available > 1e6);
    CHECK(*available < 1e15);
}
#endif
