#include <doctest/doctest.h>

#include <new>
#include <optional>
#include <string>

#include "base/memory.h"

using namespace fairing;

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
#endif
