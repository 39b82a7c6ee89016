// Loops on several threads. Any thread may run any piece, but each piece writes to a fixed place: the results have the
// same bits for any number of threads.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

namespace fairing {

class ThreadTeam;

// While it lives, the loops below that its thread enters run on up to `count` threads (64 at most), 0 for one on each
// core (8 at most). Without it, and within a piece, they run on the calling thread. Threads begin at the first loop
// with work for them and end with this object, so that a fork loses none.
class Threads {
public:
    explicit Threads(int count);
    ~Threads();
    Threads(const Threads&) = delete;
    Threads& operator=(const Threads&) = delete;

private:
    std::unique_ptr<ThreadTeam> team_;
    ThreadTeam* previous_;  // NOLINT(modernize-use-default-member-init): its class is not complete here
};

// Calls piece(k) once for each k = 0 … pieces − 1, in any order. An exception is rethrown once no piece runs any more;
// pieces not begun are dropped. The caller's thread passes a checkpoint after each piece.
void run_pieces(int pieces, const std::function<void(int)>& piece);

// Indices in a piece, for loops with few operations for each index, and for those with hundreds.
inline constexpr int coarse_grain = 1024;
inline constexpr int fine_grain = 128;

// Calls body(begin, end) for pieces of 0 … count − 1.
template <typename Body>
void for_ranges(int count, int grain, const Body& body) {
    const int pieces = (count + grain - 1) / grain;
    if (pieces <= 1) {
        if (count > 0) body(0, count);
        return;
    }
    run_pieces(pieces, [&](int k) { body(k * grain, std::min((k + 1) * grain, count)); });
}

// The sum of body(begin, end) over pieces of 0 … count − 1, added up in order.
template <typename Body>
double sum_over_ranges(int count, int grain, const Body& body) {
    std::vector<double> sums(static_cast<std::size_t>((count + grain - 1) / grain));
    for_ranges(count, grain,
               [&](int begin, int end) { sums[static_cast<std::size_t>(begin / grain)] = body(begin, end); });
    double sum = 0.0;
    for (double s : sums) sum += s;
    return sum;
}

}  // namespace fairing
