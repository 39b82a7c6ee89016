#include "base/kept_memory.h"

#include <mutex>

#ifdef __linux__
#include <malloc.h>  // tells with <features.h> whether it is the GNU C library's
#endif

namespace fairing {

namespace {

#ifdef __GLIBC__

void keep() {
    mallopt(M_MMAP_MAX, 0);         // arrays of any size come from the heap,
    mallopt(M_TRIM_THRESHOLD, -1);  // whose end stays
}

// Settings can't be read. These are the library's own once arrays of 32 MB have come and gone.
void give_back() {
    constexpr int most_mapped = 65536;                 // of the C library's manual: arrays outside the heap
    constexpr int largest_in_heap = 32 * 1024 * 1024;  // bytes
    mallopt(M_MMAP_MAX, most_mapped);
    mallopt(M_MMAP_THRESHOLD, largest_in_heap);
    mallopt(M_TRIM_THRESHOLD, 2 * largest_in_heap);
    malloc_trim(0);
}

#else

void keep() {}
void give_back() {}

#endif

std::mutex mutex;
int living = 0;

}  // namespace

KeptMemory::KeptMemory(bool wanted) : wanted_(wanted) {
    if (!wanted_) return;
    const std::scoped_lock lock(mutex);
    if (living++ == 0) keep();
}

KeptMemory::~KeptMemory() {
    if (!wanted_) return;
    const std::scoped_lock lock(mutex);
    if (--living == 0) give_back();
}

}  // namespace fairing
