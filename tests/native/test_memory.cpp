#include <doctest/doctest.h>

#include <new>
#include <optional>
#include <string>

#include "base/memory.h"

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

#ifdef __linux__
TEST_CASE("Linux says what is available") {
    const auto available = available_memory();
    REQUIRE(available);
    CHECK(*available > 1e6);
    CHECK(*available < 1e15);
}
#endif
