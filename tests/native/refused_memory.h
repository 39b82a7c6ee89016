// Requests for memory that fail: of operator new, and of malloc as Eigen calls it. For one executable of its own, which
// links with --wrap.
#pragma once

#include <cstdint>

namespace fairing::test {

enum class Refused { one, all_later };

// While it lives, the k-th request of any thread (1, 2, …) is refused, or it and all later ones.
class RefusedMemory {
public:
    RefusedMemory(std::int64_t k, Refused refused);
    ~RefusedMemory();
    RefusedMemory(const RefusedMemory&) = delete;
    RefusedMemory& operator=(const RefusedMemory&) = delete;

    // Whether there were so many.
    [[nodiscard]] bool has_refused() const;
};

// Blocks that were asked for and not given back.
[[nodiscard]] std::int64_t held_blocks();

}  // namespace fairing::test
