// Loops on several threads. Any thread may run any piece, but each piece writes to a fixed place: the results have the
// same bits for any number of threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "base/background_task.h"

namespace fairing {

// The threads behind `Threads`: helpers of one thread, which run its loops and background work with it.
class ThreadTeam {
public:
    // `count`: threads, that of the caller among them. They begin where there is work for them.
    explicit ThreadTeam(int count) : helpers_wanted_(count - 1) {}
    ~ThreadTeam();
    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    // See run_pieces. Doesn't wait for helpers that have not begun by the time the work is done.
    void run(int pieces, const std::function<void(int)>& piece);
    // For the next helper that has nothing to do.
    void send(std::shared_ptr<BackgroundTask::Work> work);

    // This thread's team; null without one, and within a piece or background work.
    static constinit thread_local ThreadTeam* current;

private:
    class Job;

    void start_helpers();
    template <typename Change>
    void post(const Change& change);
    void wait_for_helpers() noexcept;
    void help() noexcept;
    void help_with_job(std::unique_lock<std::mutex>& lock, unsigned& seen);
    void do_work(std::unique_lock<std::mutex>& lock);

    int helpers_wanted_;
    std::vector<std::thread> helpers_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::condition_variable idle_;
    Job* job_ = nullptr;
    std::deque<std::shared_ptr<BackgroundTask::Work>> works_;
    unsigned generation_ = 0;           // of jobs
    std::atomic<unsigned> posted_ = 0;  // jobs, works
    std::atomic<int> working_ = 0;      // helpers within the job
    int asleep_ = 0;
    bool ends_ = false;
};

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
